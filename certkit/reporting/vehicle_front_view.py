"""The front of a vehicle, drawn: force on each face and force over shortening of each connection."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.channel_names import is_channel
from certkit.reporting.charts.lines import lines_chart

if TYPE_CHECKING:
    from certkit.documents.result import Front, Histories
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0


class FrontView(Struct, frozen=True):
    """Drawings of a front, and its energies: (what, J received from the leg or absorbed), largest first."""

    contact: Drawing
    displacement: Drawing
    springs: list[Drawing]
    received: list[tuple[str, float]]
    absorbed: list[tuple[str, float]]


def front_view(front: Front | None) -> FrontView | None:
    """Draw what a front did; None where none was hit."""
    if front is None or front.contact.count < 2:
        return None
    return FrontView(
        contact=_over_time(front.contact, "Force of the leg on each face"),
        displacement=_over_time(front.displacement, "Displacement of each group"),
        springs=[
            lines_chart(
                [("history", [x for x, _ in curve.points], [f for _, f in curve.points])],
                name,
                f"{curve.x_title}, {curve.x_unit}",
                curve.y_unit,
                width=WIDTH,
                height=HEIGHT,
            )
            for name, curve in front.springs.items()
        ],
        received=sorted(
            ((_words(name), energy) for name, energy in front.received.items()), key=lambda item: -item[1]
        ),
        absorbed=sorted(front.absorbed.items(), key=lambda item: -item[1]),
    )


def _words(name: str) -> str:
    """Return a group's words: a face F1 is not the gauge of that name."""
    return f"face {name}" if is_channel(name) else name


def _over_time(histories: Histories, title: str) -> Drawing:
    axis = [(histories.start + k * histories.interval) * 1e3 for k in range(histories.count)]
    lines = [(_words(s.title), axis, s.values) for s in histories.series.values()]
    unit = next(iter(histories.series.values())).unit
    return lines_chart(lines, title, "ms", unit)
