"""The digital calibration certificate (DCC) of a measured test: XML by PTB's schema 3.3.0, units by D-SI.

It is a twin of the test report for machines: administrative data from the laboratory file, each criterion as
a quantity in SI units with its expanded uncertainty, the verdict against its corridor as a statement of
conformity, equipment, and the conditions of the test. Only a measured test can be one, and the schema asks
for more than a laboratory file has to hold: country, customer, and somebody who answers for it.

The kept packages for DCCs read and check them (pydcc, dcclib) and do not write them; the standard library's
XML writer does. `tests/reporting/test_dcc.py` holds the outcome against the schema that dcclib ships.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from certkit.documents.document_kinds import MEASURED
from certkit.errors import UsageError
from certkit.plain_text import without_odd_characters

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult, Result
    from certkit.reporting.result_view import View

FILE = "dcc.xml"
SUITE_FILE: str | None = None
TRANSLATED = False
REPEATABLE = True

VERSION = "3.3.0"
DCC, SI = "https://ptb.de/dcc", "https://ptb.de/si"
COVERAGE, PROBABILITY = "2", "0.95"

UNITS = {
    "N·m": (r"\newton\metre", 1.0),
    "N": (r"\newton", 1.0),
    "kN": (r"\newton", 1e3),
    "mm": (r"\metre", 1e-3),
    "m/s": (r"\metre\second\tothe{-1}", 1.0),
    "m/s²": (r"\metre\second\tothe{-2}", 1.0),
    "deg": (r"\radian", math.pi / 180),
    "J": (r"\joule", 1.0),
    "kg": (r"\kilogram", 1.0),
    "s": (r"\second", 1.0),
    "ms": (r"\second", 1e-3),
    "h": (r"\second", 3600.0),
    "%": (r"\one", 0.01),
    "°C": (r"\degreecelsius", 1.0),
}
"""D-SI unit and factor of each unit that results use."""

CONFORMITY = {"pass": "pass", "fail": "fail", "conditional": "conditionalPass"}


def write(views: Sequence[View], *, title: str | None, paper: str) -> bytes:
    """Return the file of one result.

    Raises
    ------
    UsageError
        When the result can be no DCC; says what is missing.
    """
    del title, paper
    return dcc(views[0].document)


def lacking(result: Result) -> list[str]:
    """Return what a result lacks to be a DCC; empty where it lacks nothing."""
    if result.kind != MEASURED:
        return [f"a measured test; this is a {result.kind}"]
    header = result.laboratory or {}
    test = header.get("test") or {}
    found = {
        "`country` of the laboratory, such as DE": header.get("country"),
        "`customer`": header.get("customer"),
        "`persons`": header.get("persons"),
        "`item`": header.get("item"),
        "`test: performed`": test.get("performed"),
    }
    return [name for name, value in found.items() if not value]


def dcc(result: Result) -> bytes:
    """Return the certificate.

    Raises
    ------
    UsageError
        When the result lacks something that the schema asks for.
    """
    missing = lacking(result)
    if missing:
        raise UsageError(
            f"a digital calibration certificate needs {', '.join(missing)}; complete the laboratory file "
            "and grade the test again, or leave the format `dcc` out"
        )
    root = ET.Element(f"{{{DCC}}}digitalCalibrationCertificate", schemaVersion=VERSION)
    _administration(_under(root, "administrativeData"), result)
    _measurement(_under(_under(root, "measurementResults"), "measurementResult"), result)
    ET.register_namespace("dcc", DCC)
    ET.register_namespace("si", SI)
    ET.indent(root, " ")
    xml: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return xml + b"\n"


def _under(parent: ET.Element, name: str, text: str | None = None) -> ET.Element:
    """Add an element of the DCC; blanks of its text are made single, as the schema wants them."""
    made = ET.SubElement(parent, f"{{{DCC}}}{name}")
    if text is not None:
        made.text = " ".join(without_odd_characters(text).split())
    return made


def _words(parent: ET.Element, name: str, text: str) -> ET.Element:
    """Add an element whose text stands in English."""
    made = _under(parent, name)
    _under(made, "content", text).set("lang", "en")
    return made


def _administration(parent: ET.Element, result: Result) -> None:
    header: dict[str, Any] = result.laboratory or {}
    test, item = header["test"], header["item"]
    software = _under(_under(parent, "dccSoftware"), "software")
    _words(software, "name", "certkit")
    _under(software, "release", result.provenance.certkit)
    core = _under(parent, "coreData")
    _under(core, "countryCodeISO3166_1", header["country"])
    _under(core, "usedLangCodeISO639_1", "en")
    _under(core, "mandatoryLangCodeISO639_1", "en")
    _under(core, "uniqueIdentifier", str(test.get("number") or result.id))
    _identified(core, (("other", result.id, "certificate id"),))
    if item.get("received"):
        _under(core, "receiptDate", item["received"])
    _under(core, "beginPerformanceDate", test["performed"])
    _under(core, "endPerformanceDate", test["performed"])
    _under(core, "performanceLocation", "other" if test.get("place") else "laboratory")
    if test.get("issued"):
        _under(core, "issueDate", test["issued"])
    if test.get("replaces"):
        change = _under(core, "reportAmendedSubstituted")
        _under(change, "typeOfChange", "substituted")
        _under(change, "replacedUniqueIdentifier", test["replaces"])
    tested = _under(_under(parent, "items"), "item")
    _words(tested, "name", str(item.get("legform") or result.specimen.get("legform") or "legform"))
    if item.get("condition"):
        _words(tested, "description", item["condition"])
    _identified(tested, (("manufacturer", item["serial"], "serial number"),))
    contact = _under(_under(parent, "calibrationLaboratory"), "contact")
    _contact(contact, header["laboratory"], str(header.get("place") or ""), header["country"])
    persons = _under(parent, "respPersons")
    for person in header["persons"]:
        held = _under(persons, "respPerson")
        _words(_under(held, "person"), "name", person["name"])
        _under(held, "role", person["role"])
        if person.get("signs"):
            _under(held, "mainSigner", "true")
    customer = header["customer"]
    _contact(_under(parent, "customer"), customer["name"], str(customer.get("address") or ""), "")


def _identified(parent: ET.Element, entries: Sequence[tuple[str, str, str]]) -> None:
    listed = _under(parent, "identifications")
    for issuer, value, name in entries:
        made = _under(listed, "identification")
        _under(made, "issuer", issuer)
        _under(made, "value", value)
        _words(made, "name", name)


def _contact(parent: ET.Element, name: str, place: str, country: str) -> None:
    _words(parent, "name", name)
    location = _under(parent, "location")
    if country:
        _under(location, "countryCode", country)
    if place or not country:
        _words(location, "further", place or "not stated")


def _measurement(parent: ET.Element, result: Result) -> None:
    _words(parent, "name", result.title)
    method = _under(_under(parent, "usedMethods"), "usedMethod")
    _words(method, "name", result.title)
    if result.method:
        _under(method, "norm", result.method)
    software = _under(_under(parent, "usedSoftware"), "software")
    _words(software, "name", "certkit")
    _under(software, "release", result.provenance.certkit)
    _equipment(parent, result.laboratory or {})
    _conditions(parent, result)
    results = _under(parent, "results")
    for criterion in result.criteria:
        if criterion.value is not None:
            made = _under(results, "result")
            _words(made, "name", f"{criterion.id}: {criterion.title}")
            _criterion(_under(made, "data"), criterion)
    verdict = _under(_under(results, "result"), "name")
    _under(verdict, "content", "verdict").set("lang", "en")
    _words(_under(results[-1], "data"), "text", " ".join([result.verdict, *result.remarks]))


def _equipment(parent: ET.Element, header: dict[str, Any]) -> None:
    used = [(f"sensor of {each['channel']}", each) for each in header.get("sensors", [])]
    used += [(each["name"], each) for each in header.get("equipment", [])]
    if not used:
        return
    listed = _under(parent, "measuringEquipments")
    for name, each in used:
        made = _under(listed, "measuringEquipment")
        _words(made, "name", name)
        _words(made, "description", f"calibrated {each['calibrated']}, valid until {each['expires']}")
        _identified(made, (("calibrationLaboratory", each["serial"], "serial number"),))


def _conditions(parent: ET.Element, result: Result) -> None:
    rows = [row for row in result.preconditions if row.value is not None and row.unit in UNITS]
    if not rows:
        return
    listed = _under(parent, "influenceConditions")
    for row in rows:
        made = _under(listed, "influenceCondition")
        _words(made, "name", row.quantity)
        quantity = _under(_under(made, "data"), "quantity")
        _real(quantity, float(row.value or 0.0), row.unit, None)


def _criterion(parent: ET.Element, criterion: CriterionResult) -> None:
    quantity = _under(parent, "quantity")
    _words(quantity, "name", criterion.id)
    expanded = criterion.uncertainty.expanded if criterion.uncertainty else None
    _real(quantity, criterion.value or 0.0, criterion.unit, expanded)
    if not criterion.graded or criterion.verdict not in CONFORMITY:
        return
    meta = _under(_under(quantity, "measurementMetaData"), "metaData")
    if criterion.source:
        _under(meta, "reference", criterion.source)
    limits = ((criterion.lower, "at least"), (criterion.upper, "at most"))
    told = " and ".join(f"{word} {limit:.7g} {criterion.unit}" for limit, word in limits if limit is not None)
    if told:
        _words(meta, "declaration", told)
    _under(meta, "conformity", CONFORMITY[criterion.verdict])


def _real(parent: ET.Element, value: float, unit: str, expanded: float | None) -> None:
    """Add a quantity in SI units."""
    name, factor = UNITS.get(unit, (r"\one", 1.0))
    real = ET.SubElement(parent, f"{{{SI}}}real")
    ET.SubElement(real, f"{{{SI}}}value").text = f"{value * factor:.9g}"
    ET.SubElement(real, f"{{{SI}}}unit").text = name
    if expanded is None:
        return
    held = ET.SubElement(real, f"{{{SI}}}measurementUncertaintyUnivariate")
    spread = ET.SubElement(held, f"{{{SI}}}expandedMU")
    for tag, text in (
        ("valueExpandedMU", f"{expanded * factor:.9g}"),
        ("coverageFactor", COVERAGE),
        ("coverageProbability", PROBABILITY),
        ("distribution", "normal"),
    ):
        ET.SubElement(spread, f"{{{SI}}}{tag}").text = text
