"""Documents as pandas data frames, and how a result shows itself in a notebook."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import pandas as pd

    from certkit.documents.list_by_id import Identified

COLUMNS = ("title", "value", "unit", "lower", "upper", "margin", "time", "verdict", "confidence", "source")
SHOWN = ("title", "value", "unit", "lower", "upper", "margin", "verdict")
"""Columns that a notebook shows."""


class Graded(Protocol):
    """What has criteria and a verdict."""

    @property
    def title(self) -> str:
        """What was tested."""

    @property
    def verdict(self) -> str:
        """Over all."""

    @property
    def criteria(self) -> Sequence[Identified]:
        """All criteria, with the fields of `COLUMNS`."""


class SampledSeries(Protocol):
    """Values of one channel."""

    @property
    def unit(self) -> str:
        """Of the values."""

    @property
    def values(self) -> Sequence[float]:
        """At the times of the axis."""


class Sampled(Protocol):
    """Channels on one uniform time axis."""

    @property
    def start(self) -> float:
        """Time of the first sample, s."""

    @property
    def interval(self) -> float:
        """Time between samples, s."""

    @property
    def count(self) -> int:
        """Number of samples."""

    @property
    def series(self) -> Mapping[str, SampledSeries]:
        """By name."""


class CriteriaFrame:
    """Gives a document its criteria as a data frame."""

    def to_pandas(self: Graded) -> pd.DataFrame:
        """Return the criteria: one row each, by id, values and limits in the unit of the row, times in s."""
        import pandas as pd  # noqa: PLC0415  # slow to import, and only tables need it

        rows = [[getattr(criterion, name) for name in COLUMNS] for criterion in self.criteria]
        ids = pd.Index([criterion.id for criterion in self.criteria], name="id")
        return pd.DataFrame(rows, index=ids, columns=list(COLUMNS))

    def _repr_html_(self: Graded) -> str:
        """Show verdict and criteria in a notebook."""
        from html import escape  # noqa: PLC0415  # brings a table of two thousand names

        table = CriteriaFrame.to_pandas(self)[list(SHOWN)].to_html(na_rep="", float_format="{:.4g}".format)
        return f"<p>{escape(self.title)}: <strong>{escape(self.verdict)}</strong></p>\n{table}"


class SeriesFrame:
    """Gives channels over time as a data frame, and their times."""

    @property
    def milliseconds(self: Sampled) -> list[float]:
        """The time axis, ms."""
        return [(self.start + k * self.interval) * 1e3 for k in range(self.count)]

    def to_pandas(self: Sampled) -> pd.DataFrame:
        """Return one column a channel over the time in s; `attrs["units"]` has the unit of each."""
        import pandas as pd  # noqa: PLC0415  # likewise

        time = [round(self.start + i * self.interval, 9) for i in range(self.count)]
        columns = {name: pd.Series(series.values, dtype=float) for name, series in self.series.items()}
        frame = pd.DataFrame(columns)
        frame.index = pd.Index(time, name="time [s]")
        frame.attrs["units"] = {name: series.unit for name, series in self.series.items()}
        return frame
