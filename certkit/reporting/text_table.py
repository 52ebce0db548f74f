"""The verdict table on a terminal: each value inside its corridor as a small bar. Plain text when piped."""

from __future__ import annotations

import math
import os
import sys
from typing import TYPE_CHECKING, TextIO, TypeAlias

from certkit.grading.relative_margin import relative_margin
from certkit.reporting.number_format import fixed
from certkit.reporting.plaintext import aligned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult
    from certkit.reporting.criterion_row import Row
    from certkit.reporting.result_view import View

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


def heads(view: View) -> list[str]:
    """Return the heads of the table's columns."""
    spread = ["over the family"] if _spreads(view) else []
    return ["", "value", "", "corridor", "", "margin", *spread, "verdict"]


def cells(row: Row, *, spreads: bool) -> list[Line]:
    """Return a criterion's cells."""
    style = STYLES[row.criterion.verdict] if row.graded else "dim"
    verdict = f"{row.sign} {row.verdict}" if row.graded else "  shown only"
    reason = f" ({row.reason})" if row.reason and row.graded else ""
    return [
        [(row.id, "bold")],
        [(row.value, "")],
        [(row.criterion.unit, "")],
        [(row.limits, "")],
        [(bar(row.criterion), style)],
        [(row.margin, "")],
        *([[(row.spread, "")]] if spreads else []),
        [(verdict, style), (reason, "")],
    ]


def above(view: View) -> Line:
    """Return the line above the table: what was tested, the verdict, the certificate's id."""
    result = view.result
    verdict = (f"{view.sign} {result.verdict.upper()}", STYLES[result.verdict])
    return [(result.title, "bold"), ("  ", ""), verdict, (f"  {result.id}", "dim")]


def below(view: View) -> list[Line]:
    """Return the lines below the table: how many passed, points, the error, the remarks."""
    lines: list[Line] = [[(view.tally, "")]]
    if view.points:
        lines.append([(view.points, "")])
    if view.result.comparison:
        lines.append([(f"rms error against {view.result.comparison.reference}: {view.error} %", "")])
    lines += [[("! ", "yellow"), (remark, "")] for remark in view.result.remarks]
    return [*lines, []]


SUITE_HEADS = ("verdict", "procedure", "in corridor", "worst", "value", "", "corridor", "margin", "%")
SUITE_RIGHT = (4, 7, 8)
SUITE_GOES = (8, 2)
"""Columns that a narrow terminal is spared, the first of them first; the report has them."""


def suite_cells(view: View) -> list[Line]:
    """Return a result's line in the table of several: verdict, how many passed, the worst criterion.

    The last column is the margin over the half-width of a corridor, or over a limit.
    """
    graded = [criterion for criterion in view.result.criteria if criterion.graded]
    passed = sum(criterion.verdict == "pass" for criterion in graded)
    worst = view.nearest_criterion if graded else None
    row = next((row for row in view.rows if worst is not None and row.id == worst.id), None)
    share = None if worst is None else relative_margin(worst)
    style = STYLES[view.result.verdict]
    return [
        [(f"{view.sign} {view.result.verdict}", style)],
        [(view.result.procedure, "bold")],
        [(f"{passed} of {len(graded)}" if graded else "–", "")],
        [(row.id if row else "–", "")],
        [(row.value if row else "", "")],
        [(worst.unit if worst else "", "")],
        [(row.limits if row else "", "")],
        [(row.margin if row else "", style)],
        [("" if share is None else fixed(100 * share, 0), style)],
    ]


def suite_columns(rows: Sequence[Sequence[Line]], width: int) -> list[int]:
    """Return which columns of the table of several results have room on a terminal that is `width` wide."""
    widest = [
        max(len(head), *(sum(len(part) for part, _ in row[number]) for row in rows))
        for number, head in enumerate(SUITE_HEADS)
    ]
    kept = list(range(len(SUITE_HEADS)))
    for goes in SUITE_GOES:
        if sum(widest[number] + 2 for number in kept) - 2 > width:
            kept.remove(goes)
    return kept


def _spreads(view: View) -> bool:
    return any(row.criterion.spread for row in view.rows)


def show(views: Sequence[View], stream: TextIO | None = None, *, details: bool = True) -> None:
    """Print what came out.

    Parameters
    ----------
    views : sequence of View
        One result is shown with its criteria; several first in one table, a line each.
    stream : TextIO, optional
        Standard output otherwise.
    details : bool
        Show the criteria of each of several results, too.
    """
    target = stream or sys.stdout
    if target.isatty() or os.environ.get("FORCE_COLOR"):
        _show_in_colour(views, target, details=details)
    else:
        _show_plain(views, target, details=details)


def _show_plain(views: Sequence[View], target: TextIO, *, details: bool) -> None:
    """Print for a pipe, at any width and without waiting 50 ms for rich."""

    def text(line: Line) -> str:
        return "".join(part for part, _ in line)

    if len(views) > 1:
        suite = [[text(cell) for cell in suite_cells(view)] for view in views]
        print(aligned(SUITE_HEADS, suite, right=SUITE_RIGHT), file=target)
        if not details:
            return
        print(file=target)
    for view in views:
        table = [[text(cell) for cell in cells(row, spreads=_spreads(view))] for row in view.rows]
        print(text(above(view)), aligned(heads(view), table, right=RIGHT), sep="\n", file=target)
        print(*map(text, below(view)), sep="\n", file=target)


def _show_in_colour(views: Sequence[View], target: TextIO, *, details: bool) -> None:
    """Print for people."""
    from rich.console import Console  # noqa: PLC0415  # a pipe need not wait for it
    from rich.table import Table  # noqa: PLC0415  # likewise
    from rich.text import Text  # noqa: PLC0415  # likewise

    def table(heads: Sequence[str], right: Sequence[int], rows: Sequence[Sequence[Line]]) -> Table:
        made = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="dim")
        for number, head in enumerate(heads):
            # The last column holds words, which may be long.
            made.add_column(
                head, justify="right" if number in right else "left", no_wrap=number + 1 < len(heads)
            )
        for row in rows:
            made.add_row(*(Text.assemble(*cell) for cell in row))
        return made

    console = Console(file=target, highlight=False, no_color=bool(os.environ.get("NO_COLOR")) or None)
    if len(views) > 1:
        suite = [suite_cells(view) for view in views]
        kept = suite_columns(suite, console.width)
        right = [place for place, number in enumerate(kept) if number in SUITE_RIGHT]
        lines = [[row[number] for number in kept] for row in suite]
        console.print(table([SUITE_HEADS[number] for number in kept], right, lines))
        if not details:
            return
        console.print()
    for view in views:
        console.print(Text.assemble(*above(view)))
        rows = [cells(row, spreads=_spreads(view)) for row in view.rows]
        console.print(table(heads(view), RIGHT, rows))
        for line in below(view):
            console.print(Text.assemble(*line))
