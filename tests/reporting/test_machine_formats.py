from __future__ import annotations

import csv
import io
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from support import synthetic_result
from support.synthetic_result import parsed

from certkit.documents.result import Result
from certkit.errors import UsageError
from certkit.exchange.channels_csv import channels_csv
from certkit.reporting.junit import junit
from certkit.reporting.markdown import github_annotations, summary
from certkit.reporting.result_view import View, unique_views
from certkit.reporting.writing import render, render_suite


def cases(result: Result) -> dict[str | None, ET.Element]:
    return {case.get("name"): case for case in parsed(junit(unique_views([result]))).iter("testcase")}


def properties(case: ET.Element) -> dict[str | None, str | None]:
    return {entry.get("name"): entry.get("value") for entry in case.iter("property")}


def test_a_criterion_brings_its_numbers_as_properties(pendulum: Result):
    found = properties(cases(pendulum)["T1"])
    assert found["value"] == "253.4"
    assert found["lower"] == "235"
    assert found["upper"] == "272"
    assert found["unit"] == "N·m"
    assert found["confidence"] == "recalled"


def test_verdicts_become_what_a_gate_understands(measured: Result):
    found = cases(measured)
    assert found["T1"].find("failure") is None
    assert found["T4"].find("failure").get("type") == "fail"
    assert found["MCL"].find("failure").get("type") == "conditional"
    assert found["ACL"].find("error").get("type") == "not evaluated"
    assert found["F1"].find("skipped") is not None
    assert found["verdict"].find("failure") is not None


def test_counts_agree_with_the_cases(measured: Result, pendulum: Result):
    root = parsed(junit(unique_views([measured, pendulum])))
    for name, kind in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        assert int(root.get(name)) == len(root.findall(f".//{kind}"))
    assert int(root.get("tests")) == len(root.findall(".//testcase"))


def test_control_characters_do_not_spoil_the_xml():
    parsed(junit(unique_views([synthetic_result.result(remarks=["bell \x07 and < & >"])])))


def table_of(result: Result) -> list[list[str]]:
    """Return the rows of a result's CSV below what it says of itself."""
    lines = io.StringIO(channels_csv(result)).readlines()
    return list(csv.reader(line for line in lines if not line.startswith("#")))


def test_channels_have_time_in_seconds_and_units_in_the_head(pendulum: Result):
    rows = table_of(pendulum)
    assert rows[0][0] == "time [s]"
    assert "T1 [N·m]" in rows[0]
    assert "MCL [mm]" in rows[0]
    assert len(rows) == pendulum.channels.count + 1
    column = rows[0].index("T1 [N·m]")
    assert float(rows[101][0]) == pytest.approx(100 * pendulum.channels.interval)
    assert float(rows[101][column]) == pytest.approx(pendulum.channels.series["T1"].values[100], rel=1e-6)


def test_a_name_with_a_comma_stays_one_column():
    document = synthetic_result.document()
    document["channels"]["series"]['odd, "name"'] = document["channels"]["series"].pop("T1")
    rows = table_of(Result.model_validate(document))
    assert 'odd, "name" [N·m]' in rows[0]
    assert {len(row) for row in rows} == {len(rows[0])}


def test_the_summary_shows_verdict_and_every_criterion(measured: Result):
    text = summary(unique_views([measured]))
    assert "✗ fail" in text
    for criterion in measured.criteria:
        assert criterion.title in text


def test_a_bar_in_a_title_does_not_make_a_column():
    text = summary(unique_views([synthetic_result.result(title="a | b <b>")]))
    assert "a \\| b &lt;b>" in text


def test_annotations_name_what_failed_and_escape_what_github_would_read(measured: Result):
    lines = github_annotations(unique_views([measured]))
    assert any(line.startswith("::error title=pendulum T4%3A fail::T4: 112.4") for line in lines)
    assert any(line.startswith("::warning title=pendulum MCL") for line in lines)
    assert any("ACL" in line and line.startswith("::error") for line in lines)
    assert not any("\n" in line for line in lines)


def test_a_pass_is_not_annotated(pendulum: Result):
    assert github_annotations(unique_views([pendulum])) == []


def test_render_writes_the_files_of_the_contract(bending: Result, tmp_path: Path):
    written = render(bending.as_written(), tmp_path, ["html", "pdf", "junit", "csv", "md"])
    names = {"report.html", "report.pdf", "junit.xml", "channels.csv", "summary.md"}
    assert {path.name for path in written} == names
    assert {path.name for path in tmp_path.iterdir()} == names


def test_render_suite_writes_the_index_and_one_bound_pdf(bending: Result, pendulum: Result, tmp_path: Path):
    written = render_suite([bending, pendulum], tmp_path, ["html", "pdf", "junit", "csv"])
    assert {path.name for path in written} == {"index.html", "suite.pdf", "junit.xml"}


def test_what_was_shown_of_each_result_is_shown_again_of_all(
    bending: Result, pendulum: Result, tmp_path: Path
):
    shown: dict[str, list[View]] = {}
    for result in (bending, pendulum):
        render(result.as_written(), tmp_path / result.procedure, ["html", "junit"], shown=shown)
    render_suite([bending, pendulum], tmp_path / "again", ["html", "junit"], shown=shown)
    render_suite([bending, pendulum], tmp_path / "anew", ["html", "junit"])
    assert [view.document.id for view in shown["en"]] == [bending.id, pendulum.id]
    for name in ("index.html", "junit.xml"):
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "anew" / name).read_bytes()


def test_views_of_one_procedure_run_twice_are_made_anew_since_their_keys_are_alike(
    pendulum: Result, tmp_path: Path
):
    shown: dict[str, list[View]] = {}
    for _ in range(2):
        render(pendulum.as_written(), tmp_path / "one", ["html"], shown=shown)
    render_suite([pendulum, pendulum], tmp_path / "again", ["html"], shown=shown)
    assert 'id="pendulum-2"' in (tmp_path / "again" / "index.html").read_text()


def test_an_unknown_format_is_refused_before_anything_is_written(bending: Result, tmp_path: Path):
    with pytest.raises(UsageError, match="unknown format `docx`"):
        render(bending.as_written(), tmp_path, ["html", "docx"])
    assert list(tmp_path.iterdir()) == []


def test_a_result_without_raw_channels_has_no_channels_file(tmp_path: Path):
    assert render(synthetic_result.result(channels=None).as_written(), tmp_path, ["csv"]) == []
