"""Plain text for continuous integration: a Markdown summary, and GitHub's annotation lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.number_format import MISSING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from certkit.reporting.criterion_row import Row
    from certkit.reporting.result_view import View


FILE = "summary.md"
SUITE_FILE: str | None = "summary.md"
TRANSLATED = False
REPEATABLE = True


def summary(views: Sequence[View]) -> str:
    """Return a Markdown summary, fit for `$GITHUB_STEP_SUMMARY`: an overview of several, then each result."""
    parts = []
    if len(views) > 1:
        head = "| Procedure | Verdict | Nearest to a limit |\n|---|---|---|\n"
        lines = [
            f"| {_cell(view.result.procedure)} | {_verdict(view)} | {_cell(view.nearest)} |" for view in views
        ]
        parts.append("## certkit\n\n" + head + "\n".join(lines) + "\n")
    parts += [_one(view) for view in views]
    return "\n".join(parts)


def _one(view: View) -> str:
    result = view.result
    lines = [f"### {_cell(result.title)}: {_verdict(view)}", "", view.tally]
    lines += ["", _cell(view.points)] if view.points else []
    lines += [line for remark in result.remarks for line in ("", f"> {_cell(remark)}")]
    lines += [
        "",
        "| Criterion | Value | Corridor | Margin | Verdict | Confidence |",
        "|---|--:|---|--:|---|---|",
    ]
    lines += [_criterion(row) for row in view.rows]
    if result.comparison:
        lines += ["", f"rms error against {_cell(result.comparison.reference)}: {view.error} %"]
    lines += ["", f"Report `{result.id}`", ""]
    return "\n".join(lines)


def _criterion(row: Row) -> str:
    cells = [
        row.name,
        f"{row.value} {row.criterion.unit}",
        row.limits,
        row.margin,
        f"{row.sign} {row.verdict}" if row.graded else "shown, not graded",
        row.confidence or MISSING,
    ]
    return "| " + " | ".join(_cell(cell) for cell in cells) + " |"


def _verdict(view: View) -> str:
    return f"{view.sign} {view.result.verdict}"


def _cell(text: str) -> str:
    """Keep text from breaking out of its cell or becoming markup."""
    escaped = text.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;").replace("`", "\\`")
    return " ".join(escaped.split())


def github_annotations(views: Sequence[View]) -> list[str]:
    """Return GitHub workflow commands: `::error …`, and `::warning …` inside the guard band."""
    return [line for view in views for line in _annotations(view)]


def _annotations(view: View) -> Iterator[str]:
    result = view.result
    for row in view.rows:
        if row.graded and row.verdict != "pass":
            level = "warning" if row.verdict == "conditional" else "error"
            title = f"{result.procedure} {row.id}: {row.verdict}"
            yield f"::{level} title={_property(title)}::{_data(row.outcome)}"
    if result.verdict in {"error", "not evaluated"}:
        text = " ".join([f"{result.title}: {result.verdict}.", *result.remarks])
        yield f"::error title={_property(f'{result.procedure}: {result.verdict}')}::{_data(text)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")


def write(views: Sequence[View], *, title: str | None, paper: str) -> str:
    """Return the file; it is read in English beside other checks."""
    del title, paper
    return summary(views)
