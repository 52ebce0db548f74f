"""The figures of a result's report: drawn when a format first asks for one, and then kept for the others.

A new one is a file in `charts/` and a property here; the page shows it where `templates/parts/report.html.j2`
names it, the PDF where `templates/certificate.html.j2` does.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.channel_order import ordered_channels
from certkit.reporting.criterion_row import figure_of, slug

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Result
    from certkit.reporting.language import Language
    from certkit.reporting.svg import Drawing
    from certkit.reporting.vehicle_front_view import FrontView


class LinkedDrawing(Struct, frozen=True):
    """A figure with the key that links point to."""

    key: str
    name: str
    svg: Drawing
    criterion: str | None = None


class ResultFigures(Struct, frozen=True, dict=True):
    """What the figures are drawn of; each property imports its own drawing code, since text needs none.

    Parameters
    ----------
    result : Result
        With its reasons in the language.
    spoken : Language
        The language of all words.
    key : str
        Part of ids in a page; differs among the results of a suite.
    nearest_criterion : CriterionResult or None
        Nearest to a limit, or furthest beyond it.
    """

    result: Result
    spoken: Language
    key: str
    nearest_criterion: CriterionResult | None

    @cached_property
    def histories(self) -> list[LinkedDrawing]:
        """Each channel over time."""
        from certkit.reporting.charts.channel_history import history_chart  # noqa: PLC0415  # see the class

        curves, t = self.result.curves, self.spoken.word
        shown = ordered_channels(self.result) if curves and drawable(self.result) else {}
        return [self._linked(n, n, history_chart(curves, n, c, t=t), c) for n, c in shown.items() if curves]

    @cached_property
    def planes(self) -> list[LinkedDrawing]:
        """Each criterion that is a curve in a plane."""
        from certkit.reporting.charts.plane import plane_chart  # noqa: PLC0415  # likewise

        return [
            self._linked(figure_of(c), c.id, plane_chart(c.curve, c.title, t=self.spoken.word), c)
            for c in self.result.criteria
            if c.curve
        ]

    def _linked(self, figure: str, name: str, drawn: Drawing, of: CriterionResult | None) -> LinkedDrawing:
        """Return a drawing under the address by which its criterion's row links to it."""
        return LinkedDrawing(f"{self.key}-chart-{slug(figure)}", name, drawn, of.id if of else None)

    @cached_property
    def spark(self) -> Drawing | None:
        """A small curve of the criterion nearest to a limit."""
        from certkit.reporting.charts.spark import sparkline  # noqa: PLC0415  # likewise

        return sparkline(self.result, self.nearest_criterion)

    @cached_property
    def frames(self) -> Drawing | None:
        """The test at a few instants."""
        from certkit.reporting.charts.motion_frames import frames_chart  # noqa: PLC0415  # likewise

        motion = self.result.motion
        return frames_chart(motion, t=self.spoken.word) if motion and motion.poses else None

    @cached_property
    def rig(self) -> Drawing | None:
        """The rig as it stands in the laboratory."""
        from certkit.reporting.charts.rig_drawing import rig_drawing  # noqa: PLC0415  # likewise

        motion = self.result.motion
        return rig_drawing(motion, t=self.spoken.word) if motion and motion.poses else None

    @cached_property
    def errors(self) -> Drawing | None:
        """Peaks of test and simulation beside each other."""
        from certkit.reporting.charts.error_bars import errors_chart  # noqa: PLC0415  # likewise

        comparison = self.result.comparison
        return errors_chart(comparison, t=self.spoken.word) if comparison and comparison.rows else None

    @cached_property
    def energies(self) -> Drawing | None:
        """Energies over time."""
        from certkit.reporting.charts.energies import energies_chart  # noqa: PLC0415  # likewise

        drawn = self.result.energies
        return energies_chart(drawn, t=self.spoken.word) if drawn else None

    @cached_property
    def front(self) -> FrontView | None:
        """What a vehicle's front did."""
        from certkit.reporting.vehicle_front_view import front_view  # noqa: PLC0415  # likewise

        return front_view(self.result.front, self.spoken)


def drawable(result: Result) -> bool:
    """Tell whether there are curves over time: one point is none."""
    return result.curves is not None and result.curves.count > 1
