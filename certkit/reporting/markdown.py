"""Plain text for continuous integration: a Markdown summary, and GitHub's annotation lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.junit import message
from certkit.reporting.margins import margin_words, tally, worst

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from certkit.documents.result import CriterionResult, Result


FILE = "summary.md"
SUITE_FILE: str | None = "summary.md"


def summary(results: Sequence[Result]) -> str:
    """Return a Markdown summary, fit for `$GITHUB_STEP_SUMMARY`: an overview of several, then each result."""
    parts = []
    if len(results) > 1:
        head = "| Procedure | Verdict | Nearest to a limit |\n|---|---|---|\n"
        lines = [
            f"| {_cell(r.procedure)} | {_word(r.verdict)} | {_cell(margin_words(worst(r)))} |"
            for r in results
        ]
        parts.append("## certkit\n\n" + head + "\n".join(lines) + "\n")
    parts += [_one(result) for result in results]
    return "\n".join(parts)


def _one(result: Result) -> str:
    lines = [f"### {_cell(result.title)}: {_word(result.verdict)}", "", tally(result)]
    lines += [line for remark in result.remarks for line in ("", f"> {_cell(remark)}")]
    lines += [
        "",
        "| Criterion | Value | Corridor | Margin | Verdict | Confidence |",
        "|---|--:|---|--:|---|---|",
    ]
    lines += [_criterion(criterion) for criterion in result.criteria]
    if result.comparison:
        lines += ["", f"rms error against {_cell(result.comparison.reference)}: "]
        lines[-1] += f"{words.fixed(result.comparison.rms_error_percent, 1)} %"
    lines += ["", f"Certificate `{result.id}`", ""]
    return "\n".join(lines)


def _criterion(criterion: CriterionResult) -> str:
    decimals = words.criterion_decimals(criterion)
    verdict = _word(criterion.verdict) if criterion.graded else "shown, not graded"
    cells = [
        words.named(criterion.id, criterion.title),
        f"{words.fixed(criterion.value, decimals)} {criterion.unit}",
        words.corridor(criterion.lower, criterion.upper),
        words.fixed(criterion.margin, decimals),
        verdict,
        criterion.confidence or words.MISSING,
    ]
    return "| " + " | ".join(_cell(cell) for cell in cells) + " |"


def _word(verdict: str) -> str:
    return f"{words.SIGNS[verdict]} {verdict}"


def _cell(text: str) -> str:
    """Keep text from breaking out of its cell or becoming markup."""
    escaped = text.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;").replace("`", "\\`")
    return " ".join(escaped.split())


def github_annotations(results: Sequence[Result]) -> list[str]:
    """Return GitHub workflow commands: `::error …`, and `::warning …` inside the guard band."""
    return [line for result in results for line in _annotations(result)]


def _annotations(result: Result) -> Iterator[str]:
    for criterion in result.criteria:
        if criterion.graded and criterion.verdict != "pass":
            level = "warning" if criterion.verdict == "conditional" else "error"
            title = f"{result.procedure} {criterion.id}: {criterion.verdict}"
            yield f"::{level} title={_property(title)}::{_data(message(criterion))}"
    if result.verdict in {"error", "not evaluated"}:
        text = " ".join([f"{result.title}: {result.verdict}.", *result.remarks])
        yield f"::error title={_property(f'{result.procedure}: {result.verdict}')}::{_data(text)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")


def write(results: Sequence[Result], *, title: str | None, paper: str, spoken: str) -> str:
    """Return the file; it is read in English beside other checks."""
    del title, paper, spoken
    return summary(results)
