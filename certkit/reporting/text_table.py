"""The verdict table on a terminal: each value inside its corridor as a small bar. Plain text when piped."""

from __future__ import annotations

import math
import os
import sys
from typing import TYPE_CHECKING, TextIO, TypeAlias

from certkit.reporting import number_format as words
from certkit.reporting.margins import margin_words, tally, worst
from certkit.reporting.plaintext import aligned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult, Result

STYLES = {
    "pass": "green",
    "fail": "bold red",
    "conditional": "yellow",
    "not evaluated": "dim",
    "error": "bold magenta",
}
Line: TypeAlias = list[tuple[str, str]]
"""Pieces of text, each with its style."""

RIGHT = (1, 5)
"""Columns that are aligned to the right: value and margin."""

WIDTH = 17
"""Signs in the bar: the corridor takes the middle half."""


def bar(criterion: CriterionResult) -> str:
    """Draw `····├───●───┤····`, or nothing where there is no value or no two-sided corridor.

    The value's sign sits at the end of the bar when it lies further out.
    """
    value, lower, upper = criterion.value, criterion.lower, criterion.upper
    if value is None or not math.isfinite(value) or (lower is None and upper is None):
        return ""
    start, end = WIDTH // 4, WIDTH - 1 - WIDTH // 4
    signs = ["·"] * WIDTH
    if lower is not None and upper is not None:
        low, step = lower, (upper - lower) / (end - start) or 1.0
    elif upper is not None:
        low, step = 0.0, upper / end or 1.0
        start = 0
    else:
        low, step = lower or 0.0, (lower or 1.0) / start
        end = WIDTH - 1
    for place in range(start, end + 1):
        signs[place] = "─"
    if lower is not None:
        signs[start] = "├"
    if upper is not None:
        signs[end] = "┤"
    place = round((value - low) / step) + start
    # A value that failed by a hair must not be drawn on the good side of its limit.
    if lower is not None and value < lower:
        place = min(place, start - 1)
    if upper is not None and value > upper:
        place = max(place, end + 1)
    signs[min(WIDTH - 1, max(0, place))] = "●"
    return "".join(signs)


def heads(result: Result) -> list[str]:
    """Return the heads of the table's columns."""
    spread = ["over the family"] if _spreads(result) else []
    return ["", "value", "", "corridor", "", "margin", *spread, "verdict"]


def row(criterion: CriterionResult, *, spreads: bool) -> list[Line]:
    """Return a criterion's cells."""
    decimals = words.criterion_decimals(criterion)
    style = STYLES[criterion.verdict] if criterion.graded else "dim"
    verdict = f"{words.SIGNS[criterion.verdict]} {criterion.verdict}" if criterion.graded else "  shown only"
    reason = f" ({criterion.reason})" if criterion.reason and criterion.graded else ""
    return [
        [(criterion.id, "bold")],
        [(words.fixed(criterion.value, decimals), "")],
        [(criterion.unit, "")],
        [(words.corridor(criterion.lower, criterion.upper), "")],
        [(bar(criterion), style)],
        [(words.fixed(criterion.margin, decimals), "")],
        *([[(_spread(criterion, decimals), "")]] if spreads else []),
        [(verdict, style), (reason, "")],
    ]


def above(result: Result) -> Line:
    """Return the line above the table: what was tested, the verdict, the certificate's id."""
    verdict = f"{words.SIGNS[result.verdict]} {result.verdict.upper()}"
    return [(result.title, "bold"), ("  ", ""), (verdict, STYLES[result.verdict]), (f"  {result.id}", "dim")]


def below(result: Result) -> list[Line]:
    """Return the lines below the table: how many passed, the error against the reference, the remarks."""
    lines: list[Line] = [[(tally(result), "")]]
    if result.comparison:
        error = words.fixed(result.comparison.rms_error_percent, 1)
        lines.append([(f"rms error against {result.comparison.reference}: {error} %", "")])
    lines += [[("! ", "yellow"), (remark, "")] for remark in result.remarks]
    return [*lines, []]


def last(results: Sequence[Result]) -> list[Line]:
    """Return a line for each of several procedures."""
    if len(results) < 2:
        return []
    return [
        [
            (f"{words.SIGNS[result.verdict]} {result.verdict:<13}", STYLES[result.verdict]),
            (f"  {result.procedure:<14}  {margin_words(worst(result))}", ""),
        ]
        for result in results
    ]


def _spreads(result: Result) -> bool:
    return any(criterion.spread for criterion in result.criteria)


def _spread(criterion: CriterionResult, decimals: int) -> str:
    """Return smallest and largest value over a family of legs, with mean and standard deviation."""
    spread = criterion.spread
    if spread is None:
        return words.MISSING
    low, high, mean, deviation = (
        words.fixed(v, decimals)
        for v in (spread.minimum, spread.maximum, spread.mean, spread.standard_deviation)
    )
    share = "" if spread.passing is None else f", {100 * spread.passing:.0f} % pass"
    return f"{low} to {high}, {mean} ± {deviation}{share}"


def show(results: Sequence[Result], stream: TextIO | None = None) -> None:
    """Print the verdict tables and, for several procedures, one line each at the end."""
    target = stream or sys.stdout
    if target.isatty() or os.environ.get("FORCE_COLOR"):
        _show_in_colour(results, target)
    else:
        _show_plain(results, target)


def _show_plain(results: Sequence[Result], target: TextIO) -> None:
    """Print for a pipe, at any width and without waiting 50 ms for rich."""

    def text(line: Line) -> str:
        return "".join(part for part, _ in line)

    for result in results:
        cells = [[text(cell) for cell in row(c, spreads=_spreads(result))] for c in result.criteria]
        print(text(above(result)), aligned(heads(result), cells, right=RIGHT), sep="\n", file=target)
        print(*map(text, below(result)), sep="\n", file=target)
    for line in last(results):
        print(text(line), file=target)


def _show_in_colour(results: Sequence[Result], target: TextIO) -> None:
    """Print for people."""
    from rich.console import Console  # noqa: PLC0415  # a pipe need not wait for it
    from rich.table import Table  # noqa: PLC0415  # likewise
    from rich.text import Text  # noqa: PLC0415  # likewise

    console = Console(file=target, highlight=False, no_color=bool(os.environ.get("NO_COLOR")) or None)
    for result in results:
        table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="dim")
        *narrow, verdict = heads(result)
        for number, head in enumerate(narrow):
            table.add_column(head, justify="right" if number in RIGHT else "left", no_wrap=True)
        table.add_column(verdict)
        for criterion in result.criteria:
            table.add_row(*(Text.assemble(*cell) for cell in row(criterion, spreads=_spreads(result))))
        console.print(Text.assemble(*above(result)))
        console.print(table)
        for line in below(result):
            console.print(Text.assemble(*line))
    for line in last(results):
        console.print(Text.assemble(*line))
