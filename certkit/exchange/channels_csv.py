"""Channels as a table for machines: time in seconds, one column a channel with its unit in the head."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.documents.rounding import SIGNIFICANT_DIGITS

if TYPE_CHECKING:
    from certkit.documents.result import Result


def channels_csv(result: Result) -> str | None:
    """Return `channels.csv`, or None where the document carries no raw channels.

    Values keep the digits of the result document, lines end with a line feed, a missing value
    is an empty cell.
    """
    histories = result.channels
    if histories is None:
        return None
    names = list(histories.series)
    head = ["time [s]", *(f"{name} [{histories.series[name].unit}]" for name in names)]
    lines = [",".join(_quoted(cell) for cell in head)]
    columns = [histories.series[name].values for name in names]
    form = f".{SIGNIFICANT_DIGITS}g"
    for index in range(histories.count):
        time = round(histories.start + index * histories.interval, 9)
        cells = [format(time, ".9g")]
        cells += [_number(column[index], form) if index < len(column) else "" for column in columns]
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else ""


def _quoted(cell: str) -> str:
    return '"' + cell.replace('"', '""') + '"' if any(sign in cell for sign in ',"\n') else cell
