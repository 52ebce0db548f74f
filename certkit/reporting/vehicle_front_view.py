"""The front of a vehicle, drawn: force on each face and force over shortening of each connection."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.channel_names import is_channel
from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.language import language
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from certkit.documents.result import Front, Histories
    from certkit.reporting.language import Language, Translate
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0


class FrontView(Struct, frozen=True):
    """Drawings of a front, and its energies: (what, J received from the leg or absorbed), largest first."""

    contact: Drawing
    displacement: Drawing
    springs: list[Drawing]
    received: list[tuple[str, float]]
    absorbed: list[tuple[str, float]]


def front_view(front: Front | None, spoken: Language | None = None) -> FrontView | None:
    """Draw what a front did, in a language; None where none was hit."""
    if front is None or front.contact.count < 2:
        return None
    spoken = spoken or language()
    t = spoken.word
    return FrontView(
        contact=_over_time(front.contact, t("Force of the leg on each face"), t),
        displacement=_over_time(front.displacement, t("Displacement of each group"), t),
        springs=[
            lines_chart(
                [("", [x for x, _ in curve.points], [f for _, f in curve.points])],
                name,
                f"{title_in(curve.x_title, spoken)}, {curve.x_unit}",
                curve.y_unit,
                width=WIDTH,
                height=HEIGHT,
            )
            for name, curve in front.springs.items()
        ],
        received=sorted(
            ((_words(name, t), energy) for name, energy in front.received.items()), key=lambda item: -item[1]
        ),
        absorbed=sorted(front.absorbed.items(), key=lambda item: -item[1]),
    )


def _words(name: str, t: Translate) -> str:
    """Return a group's words: a face F1 is not the gauge of that name."""
    return t("face {name}", name=name) if is_channel(name) else name


def _over_time(histories: Histories, title: str, t: Translate) -> Drawing:
    axis = histories.milliseconds
    lines = [(_words(s.title, t), axis, s.values) for s in histories.series.values()]
    unit = next(iter(histories.series.values())).unit
    return lines_chart(lines, title, "ms", unit)
