"""What the self-checks of an extraction come to: prediction or compensation, whose error it is, what is next.

The leg alone errs by a, leg and front together by c (model over run, less one). Then the front's part is
(1 + c)/(1 + a) - 1: what the front's forces change of what the run's own forces do to the same leg.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.channel_names import channel_words
from certkit.reporting.coupled_check import check_of
from certkit.reporting.number_format import signed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import SelfCheck
    from certkit.reporting.language import Translate

AGREES = 10.0
"""Per cent within which model and run agree: two meshes of one finite-element run differ by 3 to 7."""


def findings(result: ExtractionResult, t: Translate) -> list[str]:
    """Return sentences in a language, what agrees at the head; none without a coupled run of a leg."""
    coupled, alone = check_of(result, "coupled"), check_of(result, "leg alone")
    said: list[str] = []
    if coupled and alone and coupled.channels and alone.channels:
        said += _channels(coupled, alone, t)
    if coupled:
        said += _wrong_group(coupled, t)
    return [*said, *_front(result, t)]


def _channels(coupled: SelfCheck, alone: SelfCheck, t: Translate) -> Iterator[str]:
    own = {channel.name: channel.error_percent for channel in alone.channels}
    off = {channel.name: channel.error_percent for channel in coupled.channels if channel.name in own}
    front = {name: 100.0 * ((1 + off[name] / 100) / (1 + own[name] / 100) - 1) for name in off}
    agree = [name for name in off if max(abs(off[name]), abs(own[name]), abs(front[name])) <= AGREES]
    if agree:
        yield t(
            "A prediction within {most} %, by the leg, the front and both: {channels}.",
            most=f"{AGREES:.0f}",
            channels=", ".join(channel_words(name, t) for name in sorted(agree)),
        )
    for name in sorted(set(off) - set(agree), key=lambda n: -max(abs(off[n]), abs(own[n]), abs(front[n]))):
        told = {
            "channel": channel_words(name, t),
            "error": signed(off[name], 0),
            "own": signed(own[name], 0),
            "front": signed(front[name], 0),
        }
        if abs(off[name]) < min(abs(own[name]), abs(front[name])):
            yield t(
                "{channel} agrees by compensation ({error} %): the leg alone is {own} % off, the front adds "
                "{front} %.",
                **told,
            )
        elif abs(own[name]) >= abs(front[name]):
            yield t(
                "{channel} is {error} % off by the leg, which is {own} % off under the run's own forces: "
                "calibrate it on its own tests.",
                **told,
            )
        else:
            yield t(
                "{channel} is {error} % off by the front, which adds {front} % to the leg's own {own} %: see "
                "the worst group.",
                **told,
            )


def _wrong_group(coupled: SelfCheck, t: Translate) -> Iterator[str]:
    if coupled.wrong_group_percent is None or coupled.wrong_group_percent <= AGREES:
        return
    surplus = {
        g.name: g.impulse - g.run_impulse
        for g in coupled.groups
        if g.impulse is not None and g.run_impulse is not None
    }
    most, least = max(surplus, key=lambda n: surplus[n]), min(surplus, key=lambda n: surplus[n])
    yield t(
        "{percent} % of the impulse acts on another group than in the run, most of it on {most} "
        "({more} N·s), and {least} lacks {less} N·s.",
        percent=f"{coupled.wrong_group_percent:.0f}",
        most=most,
        more=signed(surplus[most], 0),
        least=least,
        less=f"{-surplus[least]:.0f}",
    )


def _front(result: ExtractionResult, t: Translate) -> Iterator[str]:
    """Name the face that moves worst under the run's own forces, and the law at it that fits worst."""
    alone = check_of(result, "front alone")
    if alone is None or alone.worst_percent is None or alone.worst_percent <= AGREES:
        return
    group = next(g for g in alone.groups if g.rms_percent == alone.worst_percent)
    laws = {
        path.name: law.misfit_percent
        for path in result.paths
        if group.name in {path.source, path.target}
        for law in (path.law, path.sheet)
        if law is not None
    }
    worst = max(laws, key=lambda name: laws[name], default=None)
    yield t(
        "Under the run's own forces {group} moves {percent} % off; of its laws {path} fits worst "
        "({misfit} %).",
        group=group.name,
        percent=f"{group.rms_percent:.0f}",
        path=worst or "–",
        misfit=f"{laws[worst]:.0f}" if worst else "–",
    )
