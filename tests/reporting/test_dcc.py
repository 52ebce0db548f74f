"""The digital calibration certificate says in SI units what the result says, and holds to PTB's schema."""

from __future__ import annotations

import os
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from certkit import grade, render, verify
from certkit.documents.result import Result
from certkit.errors import UsageError
from certkit.reporting.attachments import enclosures
from certkit.reporting.dcc_report import FILE, dcc, lacking

MEASURED = Path(__file__).parents[2] / "examples" / "measured"
SPACES = {"dcc": "https://ptb.de/dcc", "si": "https://ptb.de/si"}
SCHEMA = os.environ.get("CERTKIT_DCC_SCHEMA", "")


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Result:
    header = tmp_path_factory.mktemp("lab") / "lab.yaml"
    words = (MEASURED / "lab.yaml").read_text(encoding="utf-8")
    header.write_text(words.replace("contact:", "country: DE\ncontact:", 1), encoding="utf-8")
    return grade("pendulum", MEASURED / "FLX-0007-pendulum.zip", laboratory=header).as_written()


def quantities(result: Result) -> dict[str, ET.Element]:
    root = ET.fromstring(dcc(result))  # noqa: S314  # made by this very line
    found = root.findall(".//dcc:results/dcc:result/dcc:data/dcc:quantity", SPACES)
    return {str(each.findtext("dcc:name/dcc:content", "", SPACES)): each for each in found}


def test_values_and_uncertainties_stand_in_si_units(result: Result) -> None:
    made = quantities(result)
    t1, mcl = result.criteria["T1"], result.criteria["MCL"]
    assert made["T1"].findtext("si:real/si:unit", "", SPACES) == r"\newton\metre"
    assert float(made["T1"].findtext("si:real/si:value", "", SPACES)) == pytest.approx(t1.value)
    assert made["MCL"].findtext("si:real/si:unit", "", SPACES) == r"\metre"
    assert float(made["MCL"].findtext("si:real/si:value", "", SPACES)) == pytest.approx(1e-3 * mcl.value)
    assert mcl.uncertainty is not None
    assert mcl.uncertainty.expanded is not None
    expanded = made["MCL"].findtext(".//si:valueExpandedMU", "", SPACES)
    assert float(expanded) == pytest.approx(1e-3 * mcl.uncertainty.expanded)


def test_each_graded_criterion_says_whether_it_conforms(result: Result) -> None:
    made = quantities(result)
    told = {name: each.findtext(".//dcc:conformity", None, SPACES) for name, each in made.items()}
    words = {"pass": "pass", "conditional": "conditionalPass", "fail": "fail"}
    graded = [c for c in result.criteria if c.graded and c.verdict in words]
    assert graded
    assert {c.id: told[c.id] for c in graded} == {c.id: words[c.verdict] for c in graded}


def test_a_simulated_test_is_no_calibration(result: Result) -> None:
    simulated = result.model_copy(update={"kind": "virtual certification"})
    with pytest.raises(UsageError, match="needs a measured test"):
        dcc(simulated)


def test_what_the_schema_asks_for_and_the_file_lacks_is_named(result: Result) -> None:
    bare = result.model_copy(update={"laboratory": {"laboratory": "Example", "item": {"serial": "A-1"}}})
    assert [words.split("`")[1] for words in lacking(bare)] == [
        "country",
        "customer",
        "persons",
        "test: performed",
    ]
    assert not [part for part in enclosures(bare) if part.role == "dcc"]


def test_the_twin_goes_with_the_certificate_and_is_verified(result: Result, tmp_path: Path) -> None:
    assert [part.content for part in enclosures(result) if part.role == "dcc"] == [dcc(result)]
    render(result, tmp_path, "dcc")
    assert not [check.what for check in verify(tmp_path).checks if check.outcome == "does not hold"]
    path = tmp_path / FILE
    path.write_bytes(path.read_bytes().replace(b">pass<", b">fail<"))
    assert [c.what for c in verify(tmp_path).checks if c.outcome == "does not hold"] == [FILE]


@pytest.mark.skipif(not SCHEMA, reason="CERTKIT_DCC_SCHEMA names no folder with PTB's schema (dcclib 0.3.0)")
def test_the_file_is_valid_by_the_schema_that_dcclib_ships(result: Result) -> None:
    etree = pytest.importorskip("lxml.etree")
    schema = etree.XMLSchema(etree.parse(str(Path(SCHEMA) / "dcc" / "v3.3.0.xsd")))
    schema.assertValid(etree.fromstring(dcc(result)))
    broken = dcc(result).replace(b"<dcc:issuer>manufacturer<", b"<dcc:issuer>nobody<")
    assert not schema.validate(etree.fromstring(broken))
