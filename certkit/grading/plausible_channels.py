"""Channels that cannot have shown the blow: one sensor against the limits of a leg and its neighbours."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.definitions.channels import ELONGATION, MOMENT
from certkit.grading.channels_of_leg import LegChannels
from certkit.grading.odd_channels import patterns, silent, unsteady
from certkit.reasons import Reason
from certkit.signals.clipping import beyond_class, find_clippings
from certkit.signals.plausibility_motion import (
    WINDOW,
    WRONG_WAY,
    activity,
    blow,
    frozen_from,
    is_dead,
    moves_early,
    moves_wrong_way,
    off_by_powers,
    perhaps_frozen,
    surely_agree,
    turned_gauges,
)
from certkit.signals.plausibility_rest import copies
from certkit.signals.plausibility_steps import (
    AWAY,
    LIGAMENT_SPEED,
    drop_out,
    impossible_step,
    largest_step,
    steepest,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from certkit.grading.trace import EvaluationWindow
    from certkit.signals import Filtered

KEPT = ("clipped-kept", "beyond-class-kept", "sign-turned")
"""Notes of a channel that was kept with --lenient though its values are no evidence."""
FREE_LIGAMENT = 3.0
"""Times the elongation that the shortening of a ligament without a known sign has to be to count as turned;
ACL and PCL are shortened by shear too (1.6 times in no shipped run). An estimate."""
SLACK = 0.05
"""Share of its largest size below which a ligament stands still because it is slack, not frozen."""


class ChannelDoubts(Struct, frozen=True):
    """What is wrong with channels, and what is odd about them.

    Parameters
    ----------
    doubts : mapping of str to Reason
        By channel: why its values are no evidence.
    remarks : tuple of Reason
        What no leg should show, but no channel can be named for.
    """

    doubts: Mapping[str, Reason]
    remarks: tuple[Reason, ...] = ()


def doubtful_channels(filtered: Filtered, window: EvaluationWindow, decided: float) -> ChannelDoubts:
    """Find channels of a dynamic test whose values are no evidence.

    Parameters
    ----------
    filtered : Filtered
        The conditioned recording.
    window : EvaluationWindow
        Seconds that are evaluated.
    decided : float
        Seconds at which the last criterion is decided; what a sensor shows later, as when the leg falls to
        the ground, spoils nothing.
    """
    leg = LegChannels(filtered, window, decided)
    doubts: dict[str, Reason] = {}
    for check in CHECKS:
        for name, reason in check(leg):
            doubts.setdefault(name, reason)
    return ChannelDoubts(doubts, (*patterns(leg, doubts), *unsteady(leg, doubts), *silent(leg)))


def _kept(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield what --lenient kept although it is clipped or turned."""
    for name, channel in leg.filtered.recording.channels.items():
        yield from ((name, note) for note in channel.notes if note.code in KEPT)


def _steps(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield drop-outs and overflows."""
    for name, channel in leg.channels.items():
        rate = steepest(leg.classes[name]) if leg.moment(name) else LIGAMENT_SPEED
        if leg.largest_steps[name] <= largest_step(leg.filtered.recording.interval, rate):
            continue  # the quick way out: nearly every channel leaves here
        at = impossible_step(channel.values[: leg.end], leg.filtered.recording.interval, rate)
        if at is not None:
            step = float(channel.values[at] - channel.values[at - 1]) * channel.dimension.scale
            unit = channel.dimension.unit
            limit = largest_step(leg.filtered.recording.interval, rate) * channel.dimension.scale
            yield (
                name,
                Reason.of("impossible-step", step=abs(step), unit=unit, time=leg.at(at), limit=limit),
            )


def _drop_outs(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield channels that jump away and come back at once: lost contacts, lost telegrams, spikes."""
    for name, channel in leg.channels.items():
        swing = leg.swings[name]
        if leg.largest_steps[name] <= AWAY * swing:
            continue  # the quick way out: nearly every channel leaves here
        recorded = channel.values[: leg.end]
        found = drop_out(recorded, leg.filtered.recording.interval, swing)
        if found is not None:
            begin, end = found
            away = float(recorded[begin] - recorded[begin - 1]) * channel.dimension.scale
            yield (
                name,
                Reason.of(
                    "drop-out",
                    step=abs(away),
                    unit=channel.dimension.unit,
                    time=leg.at(begin),
                    back=leg.at(end),
                ),
            )


def _clipped(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield flat tops, as recorded and through the filter, which takes noise off a plateau.

    The solver has no amplifier that could cut one off: a top that is flat there is one.
    """
    if leg.filtered.recording.from_solver:
        return
    clippings = find_clippings(leg.rows[:, : leg.end], [*leg.classes.values()] * 2)
    for number, (name, channel) in enumerate(leg.channels.items()):
        found = clippings[number] or clippings[number + len(leg.channels)]
        if found is not None:
            scale, unit = channel.dimension.scale, channel.dimension.unit
            yield (
                name,
                Reason.of("clipped", level=found.level * scale, unit=unit, time=leg.at(found.index)),
            )


def _beyond_class(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield measured channels that go beyond their amplitude class, where nothing vouches for their chain."""
    if leg.filtered.recording.kind != "measured":
        return
    for name, channel in leg.channels.items():
        limit = leg.classes[name]
        found = beyond_class(channel.values[: leg.end], limit)
        if found is not None:
            scale, unit = channel.dimension.scale, channel.dimension.unit
            yield (
                name,
                Reason.of(
                    "beyond-class",
                    level=found.level * scale,
                    limit=limit * scale,
                    unit=unit,
                    time=leg.at(found.index),
                ),
            )


def _dead(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield channels that do not move though the bones do."""
    for name, channel in leg.channels.items():
        swing = leg.swings[name]
        if is_dead(swing, leg.smooth[name][: leg.rest], leg.classes[name]) and leg.blow_beside(name):
            shown = swing * channel.dimension.scale
            yield name, Reason.of("channel-dead", swing=shown, unit=channel.dimension.unit)


def _early(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield channels that move before contact though the others are at rest: shifted in time, or drifting."""
    if leg.rest < 2:
        return
    before = {name: values[: leg.rest] for name, values in leg.smooth.items() if leg.blow_beside(name)}
    # Bones swing in flight, ligaments do not: gauges are held against gauges.
    bones = {name: values for name, values in before.items() if leg.moment(name)}
    shares = {name: s for name, s in moves_early(before, leg.peaks).items() if name not in bones}
    for name, share in {**moves_early(bones, leg.peaks), **shares}.items():
        yield name, Reason.of("moves-before-contact", share=100.0 * share)


def _frozen(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield channels that stand still for a while in which the others move."""
    interval = leg.filtered.recording.interval
    if not perhaps_frozen(leg.after_rows, interval):
        return
    moving = activity(leg.after_rows, interval)
    recorded = dict(zip(leg.channels, moving[: len(leg.channels)], strict=True))
    smooth = dict(zip(leg.channels, moving[len(leg.channels) :], strict=True))
    step = max(1, max(2, round(WINDOW / interval)) // 4)
    for name, through_filter in smooth.items():
        if not leg.blow_beside(name):
            continue
        own, levels = through_filter, None
        others = [smooth[other] for other in smooth if other != name and leg.moment(other)]
        if leg.moment(name):
            # A sensor that hangs shows one number; through the filter it still settles for a while.
            own = np.minimum(own, recorded[name])
        else:
            levels = np.abs(leg.after[name])[::step][: own.size] > SLACK * leg.peaks[name]
        if len(others) > 1:
            at = frozen_from(own, others, levels)
            if at is not None:
                yield name, Reason.of("channel-frozen", time=leg.at(leg.begin + at * step))


def _turned(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield gauges that move against their neighbours, and ligaments that are shortened by a blow."""
    for names in leg.bones.values():
        loaded = {n: leg.after[n] for n in names if leg.peaks[n] > 0.05 * leg.classes[n]}
        if surely_agree(loaded, leg.products, leg.means, leg.last - leg.begin):
            continue  # the quick way out
        for name in turned_gauges(loaded):
            yield name, Reason.of("gauge-turned", others=[n for n in loaded if n != name])
    for name in leg.channels:
        if leg.moment(name) or not leg.blow_beside(name):
            continue
        sign, least, most = leg.filtered.recording.table.kinds[name].sign, leg.lows[name], leg.highs[name]
        wrong = moves_wrong_way(least, most, WRONG_WAY if sign > 0 else FREE_LIGAMENT)
        if sign >= 0 and wrong and _regulated(leg, name):
            yield name, Reason.of("moves-wrong-way", least=least * 1e3, most=most * 1e3, unit="mm")


def _regulated(leg: LegChannels, name: str) -> bool:
    """Tell whether a ligament is one that the test lengthens: it usually shows an elongation."""
    kind = leg.filtered.recording.table.kinds[name]
    return kind.sign > 0 or (kind.usual or 0.0) > 0


def _copied(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield channels of a measured test that share one noise: one sensor, recorded twice."""
    if leg.filtered.recording.kind == "measured":
        for one, other in copies({name: c.values[: leg.rest] for name, c in leg.channels.items()}):
            yield one, Reason.of("channel-copied", other=other)
            yield other, Reason.of("channel-copied", other=one)


def _units(leg: LegChannels) -> Iterator[tuple[str, Reason]]:
    """Yield channels that are out by a power of ten beside the others."""
    recording = leg.filtered.recording
    kinds = recording.table.kinds
    # The solver knows one unit only, but a bonnet's edge stretches ligaments in other proportions.
    for dimension in () if recording.from_solver else (MOMENT, ELONGATION):
        usual = {
            name: kinds[name].usual or 0.0
            for name, channel in leg.channels.items()
            if channel.dimension == dimension and kinds[name].usual
        }
        if dimension == MOMENT and not blow([leg.peaks[n] / leg.classes[n] for n in usual]):
            continue
        for name, power in off_by_powers(leg.peaks, usual).items():
            shown = leg.peaks[name] * leg.channels[name].dimension.scale
            others = [other for other in usual if other != name]
            unit, factor = leg.channels[name].dimension.unit, 10.0**power
            yield name, Reason.of("unit-out-by-ten", value=shown, unit=unit, factor=factor, others=others)


CHECKS: tuple[Callable[[LegChannels], Iterator[tuple[str, Reason]]], ...] = (
    _kept,
    _steps,
    _drop_outs,
    _clipped,
    _beyond_class,
    _dead,
    _frozen,
    _turned,
    _copied,
    _units,
    _early,
)
"""In the order in which a channel's first fault is told."""
