"""How one channel behaves over the tests of one procedure: mean, scatter, control limits, drift."""

from __future__ import annotations

import math
import statistics
from datetime import date, timedelta
from itertools import pairwise
from typing import TYPE_CHECKING

from certkit.documents.logbook_overview import Trend
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.logbook_rules import PublishedVariation, TrendRule
    from certkit.logbooks.logbook_entry import LogbookEntry, Reading

INDIVIDUALS = 2.66
"""Control limits: mean ± 2.66 · mean moving range, three standard deviations (ISO 7870-2)."""
SIGNIFICANT = 2.0
"""A slope is a drift when it is more than so many times its standard error: about 95 %."""
HORIZON = 3653
"""Days beyond which no date of leaving is given."""
YEAR = 365.25


def trends(entries: Sequence[LogbookEntry], rule: TrendRule) -> list[Trend]:
    """Return the trends of one legform, by procedure and criterion in the order of first appearance.

    Only tests of the same rig can show a drift of the legform, so the caller leaves out vehicle tests.

    Parameters
    ----------
    entries : sequence of LogbookEntry
        In order.
    rule : TrendRule
        Tests below which neither control limits nor a drift are given; published coefficients of variation.
    """
    rows: dict[tuple[str, str], list[tuple[date, Reading]]] = {}
    for entry in entries:
        for reading in entry.readings:
            if reading.value is not None and math.isfinite(reading.value):
                rows.setdefault((entry.procedure, reading.criterion), []).append((entry.day, reading))
    known = {each.procedure: each for each in rule.published}
    return [
        _trend(procedure, row, rule.at_least, known.get(procedure)) for (procedure, _), row in rows.items()
    ]


def _trend(
    procedure: str, row: list[tuple[date, Reading]], at_least: int, published: PublishedVariation | None
) -> Trend:
    days = [day for day, _ in row]
    last = row[-1][1]
    values = [reading.value for _, reading in row if reading.value is not None]
    mean = statistics.fmean(values)
    deviation = statistics.stdev(values) if len(values) > 1 else None
    enough = len(values) >= at_least
    reach = INDIVIDUALS * statistics.fmean(abs(b - a) for a, b in pairwise(values)) if enough else None
    slope, drifts = _slope(days, values) if enough else (None, False)
    leaves, remark = (
        _leaving(days, values, slope, last, drifts=drifts)
        if enough
        else (None, Reason.of("trend-of-few-tests", least=at_least))
    )
    return Trend(
        procedure=procedure,
        criterion=last.criterion,
        title=last.title,
        unit=last.unit,
        days=[day.isoformat() for day in days],
        values=values,
        lower=last.lower,
        upper=last.upper,
        count=len(values),
        mean=mean,
        standard_deviation=deviation,
        variation_percent=None if deviation is None or mean == 0 else 100 * deviation / abs(mean),
        published_percent=None if published is None else published.percent,
        published_source="" if published is None else published.source or "",
        control_lower=None if reach is None else mean - reach,
        control_upper=None if reach is None else mean + reach,
        outside_control=[]
        if reach is None
        else [place for place, value in enumerate(values, 1) if abs(value - mean) > reach],
        slope_per_year=None if slope is None else slope * YEAR,
        drifts=drifts,
        leaves=None if leaves is None else leaves.isoformat(),
        coded_remark=remark,
    )


def _slope(days: Sequence[date], values: Sequence[float]) -> tuple[float | None, bool]:
    """Return the slope of the straight line of least squares, per day, and whether it is a drift."""
    x = [float(day.toordinal()) for day in days]
    middle, mean = statistics.fmean(x), statistics.fmean(values)
    spread = sum((a - middle) ** 2 for a in x)
    if spread == 0:
        return None, False
    slope = sum((a - middle) * (b - mean) for a, b in zip(x, values, strict=True)) / spread
    rest = sum((b - mean - slope * (a - middle)) ** 2 for a, b in zip(x, values, strict=True))
    error = math.sqrt(rest / (len(x) - 2) / spread)
    return slope, abs(slope) > SIGNIFICANT * error and slope != 0


def _leaving(
    days: Sequence[date], values: Sequence[float], slope: float | None, last: Reading, *, drifts: bool
) -> tuple[date | None, Reason]:
    """Return the day on which the fitted line leaves the corridor, and what is to be said of it."""
    if not drifts or slope is None:
        return None, Reason.of("trend-none")
    limit = last.upper if slope > 0 else last.lower
    if limit is None:
        return None, Reason.of("trend-without-corridor")
    middle = statistics.fmean(float(day.toordinal()) for day in days)
    on = middle + (limit - statistics.fmean(values)) / slope
    ahead = on - days[-1].toordinal()
    if ahead > HORIZON:
        return None, Reason.of("trend-stays")
    if ahead <= 0:
        return days[-1], Reason.of("trend-has-left")
    return days[-1] + timedelta(days=math.floor(ahead)), Reason.of("trend-drifts")
