"""A campaign as JUnit XML: a test suite a scheme, a test case a point, with its numbers as properties."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

from certkit.reporting.campaign_view import car_score
from certkit.reporting.junit import fill_counts, outcome, properties, xml_bytes
from certkit.reporting.number_format import signed

if TYPE_CHECKING:
    from certkit.documents.campaign_report import CampaignReport, JudgedPoint, JudgedScheme


def campaign_junit(document: CampaignReport) -> bytes:
    """Return the XML. Points of a scheme that gives points are skipped: the total is what is gated."""
    root = ET.Element("testsuites", name="certkit")
    for scheme in document.schemes:
        root.append(_suite(document, scheme))
    root.append(_agreement(document))
    return xml_bytes(root)


def _suite(document: CampaignReport, scheme: JudgedScheme) -> ET.Element:
    name = f"certkit.{document.campaign}.{scheme.scheme}"
    suite = ET.Element("testsuite", name=f"{name}.{scheme.kind}")
    properties(
        suite,
        {
            "campaign": document.id,
            "scheme": scheme.title,
            "verdict": scheme.verdict,
            "points": scheme.total,
            "maximum": scheme.maximum,
            "worst point": scheme.worst_point,
            "remarks": "; ".join(scheme.remarks),
        },
    )
    for row in scheme.points:
        _point(suite, name, row)
    if scheme.kind == "points" and scheme.verdict is not None:
        case = ET.SubElement(suite, "testcase", classname=name, name="total")
        properties(case, {"points": scheme.total, "maximum": scheme.maximum, "at least": scheme.at_least})
        outcome(case, scheme.verdict, f"{car_score(scheme)}: {scheme.verdict}")
    fill_counts(suite)
    return suite


def _point(suite: ET.Element, name: str, row: JudgedPoint) -> None:
    case = ET.SubElement(suite, "testcase", classname=name, name=row.point)
    properties(
        case,
        {
            "basis": row.basis,
            "of": row.of,
            "source": row.source,
            "criterion": row.worst,
            "percent of limit": row.percent,
            "points": row.points,
            "maximum": row.maximum,
            **{f"{each.id} [{each.unit}]": each.value for each in row.criteria},
        },
    )
    if row.verdict is None:
        ET.SubElement(case, "skipped", message=row.reason or "gives points; the total is gated, if anything")
    else:
        outside = [
            f"{each.id} {each.value:.4g} {each.unit}, limit {each.limit:.4g}"
            for each in row.criteria
            if each.verdict != "pass" and each.value is not None
        ]
        outcome(
            case, row.verdict, "; ".join([*outside, *([row.reason] if row.reason else [])]) or row.verdict
        )


def _agreement(document: CampaignReport) -> ET.Element:
    name = f"certkit.{document.campaign}.agreement"
    suite = ET.Element("testsuite", name=name)
    for row in document.agreement:
        case = ET.SubElement(
            suite, "testcase", classname=name, name=f"{row.point} {row.criterion} {row.kind}"
        )
        properties(
            case,
            {
                "predicted": row.predicted,
                "measured": row.measured,
                "unit": row.unit,
                "error percent": row.error_percent,
                "tolerance percent": document.tolerance_percent,
            },
        )
        if row.within is None:
            ET.SubElement(case, "skipped", message="no tolerance is set")
        elif not row.within:
            outcome(
                case, "fail", f"{signed(row.error_percent, 1)} %, tolerance {document.tolerance_percent:g} %"
            )
    fill_counts(suite)
    return suite
