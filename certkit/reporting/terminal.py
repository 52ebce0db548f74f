"""The verdict table on a terminal: each value inside its corridor as a small bar. Plain text when piped."""

from __future__ import annotations

import math
import os
import sys
from typing import TYPE_CHECKING, TextIO

from certkit.reporting import words
from certkit.reporting.worst import margin_words, tally, worst

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.console import Console
    from rich.table import Table

    from certkit.grading.result import CriterionResult, Result

STYLES = {
    "pass": "green",
    "fail": "bold red",
    "conditional": "yellow",
    "not evaluated": "dim",
    "error": "bold magenta",
}
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


def table(result: Result) -> Table:
    """Return the criteria of one result as a table."""
    from rich.markup import escape  # noqa: PLC0415  # rich costs 60 ms that `--json` need not pay
    from rich.table import Table  # noqa: PLC0415  # likewise

    made = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="dim")
    for head, right in (("", False), ("value", True), ("", False), ("corridor", False), ("", False)):
        made.add_column(head, justify="right" if right else "left", no_wrap=True)
    made.add_column("margin", justify="right", no_wrap=True)
    spreads = any(criterion.spread for criterion in result.criteria)
    if spreads:
        made.add_column("over the family", no_wrap=True)
    made.add_column("verdict")
    for criterion in result.criteria:
        decimals = words.criterion_decimals(criterion)
        style = STYLES[criterion.verdict] if criterion.graded else "dim"
        verdict = (
            f"{words.SIGNS[criterion.verdict]} {criterion.verdict}" if criterion.graded else "  shown only"
        )
        reason = f" ({criterion.reason})" if criterion.reason and criterion.graded else ""
        made.add_row(
            f"[bold]{escape(criterion.id)}[/]",
            words.fixed(criterion.value, decimals),
            escape(criterion.unit),
            words.corridor(criterion.lower, criterion.upper),
            f"[{style}]{bar(criterion)}[/]",
            words.fixed(criterion.margin, decimals),
            *([_spread(criterion, decimals)] if spreads else []),
            f"[{style}]{verdict}[/]{escape(reason)}",
        )
    return made


def _spread(criterion: CriterionResult, decimals: int) -> str:
    """Return smallest and largest value over a family of legs, with mean and standard deviation."""
    spread = criterion.spread
    if spread is None:
        return words.MISSING
    low, high, mean, deviation = (
        words.fixed(v, decimals)
        for v in (spread.minimum, spread.maximum, spread.mean, spread.standard_deviation)
    )
    return f"{low} to {high}, {mean} ± {deviation}"


def console(stream: TextIO | None = None) -> Console:
    """Return a console on `stream`. Piped text gets no colours, and a width that cuts nothing."""
    from rich.console import Console  # noqa: PLC0415  # as above

    target = stream or sys.stdout
    piped = not target.isatty()
    return Console(
        file=target,
        highlight=False,
        width=200 if piped else None,
        no_color=bool(os.environ.get("NO_COLOR")) or None,
    )


def show(results: Sequence[Result], stream: TextIO | None = None) -> None:
    """Print the verdict tables and, for several procedures, one line each at the end."""
    from rich.markup import escape  # noqa: PLC0415  # as above

    out = console(stream)
    for result in results:
        style = STYLES[result.verdict]
        sign = words.SIGNS[result.verdict]
        verdict = f"[{style}]{sign} {result.verdict.upper()}[/]"
        out.print(f"[bold]{escape(result.title)}[/]  {verdict}  [dim]{escape(result.id)}[/]")
        out.print(table(result))
        out.print(tally(result))
        if result.comparison:
            error = words.fixed(result.comparison.rms_error_percent, 1)
            out.print(f"rms error against {escape(result.comparison.reference)}: {error} %")
        for remark in result.remarks:
            out.print(f"[yellow]![/] {escape(remark)}")
        out.print()
    if len(results) > 1:
        for result in results:
            style = STYLES[result.verdict]
            verdict = f"[{style}]{words.SIGNS[result.verdict]} {result.verdict:<13}[/]"
            out.print(f"{verdict}  {escape(result.procedure):<14}  {escape(margin_words(worst(result)))}")
