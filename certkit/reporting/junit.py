"""JUnit XML: each criterion, precondition and quality check a test case, with its numbers as properties.

| verdict | in JUnit |
|---|---|
| pass | passed |
| fail, conditional | failure, typed by the verdict |
| error | error |
| not evaluated (required) | error: a gate must not go green because a channel is missing |
| informative | skipped |
"""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.documents.result import Result, Verdict
    from certkit.reporting.criterion_row import Row
    from certkit.reporting.result_view import View


FILE = "junit.xml"
SUITE_FILE: str | None = "junit.xml"
TRANSLATED = False
REPEATABLE = True


def junit(views: Sequence[View]) -> bytes:
    """Return the XML of one or several results, a test suite each."""
    root = ET.Element("testsuites", name="certkit")
    for view in views:
        root.append(_suite(view))
    return xml_bytes(root)


def xml_bytes(root: ET.Element) -> bytes:
    """Return the file of several suites, with their counts summed up."""
    for count in ("tests", "failures", "errors", "skipped"):
        root.set(count, str(sum(int(suite.get(count, "0")) for suite in root)))
    ET.indent(root, " ")
    xml: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return xml + b"\n"


def fill_counts(suite: ET.Element) -> None:
    """Count a suite's cases by their outcome."""
    kinds = {"failures": "failure", "errors": "error", "skipped": "skipped"}
    suite.set("tests", str(len(suite.findall("testcase"))))
    for count, kind in kinds.items():
        suite.set(count, str(len(suite.findall(f"testcase/{kind}"))))


def _suite(view: View) -> ET.Element:
    result = view.result
    suite = ET.Element("testsuite", name=f"certkit.{result.procedure}")
    properties(
        suite,
        {
            "certificate": result.id,
            "kind": result.kind,
            "verdict": result.verdict,
            "method": result.method,
            "remarks": " ".join(result.remarks),
        },
    )
    for score in result.scores:
        name = f"score: {score.id}"
        properties(
            suite,
            {
                name: score.points,
                f"{name}, of": score.maximum,
                f"{name}, by": score.criterion,
                f"{name}, colour": score.colour,
                f"{name}, scheme": score.scheme,
            },
        )
    for row in view.rows:
        _criterion(suite, result, row)
    for condition in result.preconditions:
        case = _case(suite, result, f"precondition: {condition.quantity}")
        properties(case, {"value": condition.value, "unit": condition.unit})
        properties(case, {"lower": condition.lower, "upper": condition.upper})
        outcome(case, condition.verdict, condition.reason or f"{condition.quantity}: {condition.verdict}")
    for check in result.quality.checks if result.quality else []:
        case = _case(suite, result, f"quality: {check.title}")
        properties(case, {"value": check.value, "unit": check.unit, "upper": check.limit})
        outcome(case, check.verdict, f"{check.title} {check.value:g} {check.unit}, limit {check.limit:g}")
    case = _case(suite, result, "verdict")
    outcome(case, result.verdict, " ".join([f"{result.title}: {result.verdict}.", *result.remarks]))
    fill_counts(suite)
    return suite


def _criterion(suite: ET.Element, result: Result, row: Row) -> None:
    criterion = row.criterion
    case = _case(suite, result, criterion.id)
    properties(
        case,
        {
            "title": criterion.title,
            "value": criterion.value,
            "unit": criterion.unit,
            "lower": criterion.lower,
            "upper": criterion.upper,
            "margin": criterion.margin,
            "time_s": criterion.time,
            "confidence": criterion.confidence,
            "source": criterion.source,
        },
    )
    if criterion.graded:
        outcome(case, criterion.verdict, row.outcome)
    else:
        ET.SubElement(case, "skipped", message=criterion.reason or "informative: no corridor is known")


def _case(suite: ET.Element, result: Result, name: str) -> ET.Element:
    return ET.SubElement(suite, "testcase", classname=f"certkit.{result.procedure}", name=name)


def properties(parent: ET.Element, values: Mapping[str, str | float | None]) -> None:
    """Add named values to a suite or case; those without a value are left out."""
    holder = parent.find("properties")
    if holder is None:
        holder = ET.SubElement(parent, "properties")
    for name, value in values.items():
        if value is not None and value != "":
            text = value if isinstance(value, str) else f"{value:.7g}"
            ET.SubElement(holder, "property", name=name, value=_clean(text))


def outcome(case: ET.Element, verdict: Verdict, words: str) -> None:
    """Say how a case ended, by the table above."""
    if verdict in {"fail", "conditional"}:
        ET.SubElement(case, "failure", message=_clean(words), type=verdict)
    elif verdict in {"error", "not evaluated"}:
        ET.SubElement(case, "error", message=_clean(words), type=verdict)


def _clean(words: str) -> str:
    """Drop control characters that XML 1.0 cannot hold."""
    return "".join(sign for sign in words if sign in "\t\n" or ord(sign) >= 0x20)


def write(views: Sequence[View], *, title: str | None, paper: str) -> bytes:
    """Return the file; test runners read it in English."""
    del title, paper
    return junit(views)
