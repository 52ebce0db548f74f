"""What a script or a notebook gets: strings as paths, overrides as a mapping, results by id, data frames."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import certkit
from certkit.bench.setup import prepare
from certkit.documents.result import Result
from certkit.errors import DataError, UsageError

MEASURED = str(Path(__file__).parents[2] / "examples" / "measured")
CSV_MAPPING = {"mapping": f"{MEASURED}/mapping.yaml"}


@pytest.fixture(scope="module")
def measured() -> Result:
    return certkit.grade("pendulum", f"{MEASURED}/FLX-0007-pendulum.zip", laboratory=f"{MEASURED}/lab.yaml")


def test_importing_the_package_imports_no_numbers_and_no_tables():
    code = "import certkit, sys; print(sorted({'numpy', 'pandas', 'pydantic', 'numba'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("name", sorted(set(certkit.__all__) - {"__version__"}))
def test_a_name_stays_the_function_when_its_module_has_been_imported(name: str):
    first = getattr(certkit, name)
    import_module(first.__module__)
    assert callable(first)
    assert getattr(certkit, name) is first


def test_a_name_that_there_is_not_is_refused_with_those_that_there_are():
    with pytest.raises(AttributeError, match="has no `fly`; it hands on calibrate, "):
        certkit.fly  # noqa: B018  # asking is the test


def test_an_override_is_a_path_with_a_value_in_words_or_a_number():
    setup = prepare(
        "pendulum",
        overrides={
            "rig.release.angle": "16 deg",
            "legform.parts.femur.segments": 6,
            "legform.knee.ligaments.MCL.femur": ["40 mm", "20 mm"],
        },
    )
    assert setup.overrides[0].path == "rig.release.angle"
    assert setup.legform.parts["femur"].segments == 6
    assert setup.legform.knee.ligaments["MCL"].femur == [pytest.approx(0.04), pytest.approx(0.02)]


def test_a_library_is_one_folder_or_several_as_strings(tmp_path: Path):
    shipped = certkit.load("procedure", "pendulum")
    (tmp_path / "procedures").mkdir()
    text = shipped.text.replace(shipped.document.title, "Our own pendulum")
    (tmp_path / "procedures" / "pendulum.yaml").write_text(text, encoding="utf-8")
    for library in (str(tmp_path), [str(tmp_path)], tmp_path):
        assert certkit.load("procedure", "pendulum", library=library).document.title == "Our own pendulum"
    with pytest.raises(UsageError, match="is no folder"):
        certkit.load("procedure", "pendulum", library=str(tmp_path / "nowhere"))


def test_criteria_are_found_by_id_and_by_place(measured: Result):
    assert measured.criteria["T1"] is measured.criteria[0]
    assert "T1" in measured.criteria
    assert "T9" not in measured.criteria
    with pytest.raises(KeyError, match="there is no `T9`; there are T1, T2"):
        measured.criteria["T9"]


def test_criteria_stay_a_plain_list_in_the_document(measured: Result):
    again = Result.from_json(measured.to_json())
    assert again.criteria["T1"] == again.criteria[0]
    assert again.to_json() == measured.to_json()
    assert Result.model_json_schema(by_alias=True)["properties"]["criteria"]["type"] == "array"


def test_criteria_and_channels_are_data_frames(measured: Result):
    criteria = measured.to_pandas()
    assert criteria.loc["T1", "value"] == measured.criteria["T1"].value
    assert list(criteria.index) == measured.criteria.ids
    channels = measured.channels.to_pandas()
    assert channels.attrs["units"]["T1"] == "N·m"
    assert channels.index.name == "time [s]"
    assert channels["T1"].to_list() == measured.channels.series["T1"].values
    assert channels.index[1] - channels.index[0] == pytest.approx(measured.channels.interval)


def test_a_notebook_shows_verdict_and_criteria_and_no_markup_of_others(measured: Result):
    shown = measured.model_copy(update={"title": "<b>bold</b>"})._repr_html_()
    assert "&lt;b&gt;bold&lt;/b&gt;: <strong>" in shown
    assert all(f"<th>{criterion.id}</th>" in shown for criterion in measured.criteria)


def test_a_result_is_rendered_loaded_verified_exported_and_graded_again(measured: Result, tmp_path: Path):
    folder = str(tmp_path / "run")
    written = certkit.render(measured, folder, "html, csv")
    assert [path.name for path in written] == ["result.json", "channels.csv", "report.html"]
    assert certkit.verify(folder).holds
    loaded = certkit.load("result", folder)
    assert loaded.id == measured.id
    archive = certkit.export(loaded, str(tmp_path / "test.zip"))
    again = certkit.grade("pendulum", str(archive), laboratory=f"{MEASURED}/lab.yaml")
    assert {c.id: c.verdict for c in again.criteria} == {c.id: c.verdict for c in measured.criteria}


def test_a_format_that_a_document_has_not_is_refused_before_anything_is_written(
    measured: Result, tmp_path: Path
):
    with pytest.raises(UsageError, match="`docx`"):
        certkit.render(measured, str(tmp_path / "out"), ["docx"])
    assert not (tmp_path / "out").exists()


def test_results_and_files_are_compared_alike(measured: Result, tmp_path: Path):
    other = certkit.grade("pendulum", f"{MEASURED}/FLX-0007-pendulum.csv", **CSV_MAPPING)
    compared = certkit.compare(measured, other)
    assert compared.rows
    files = [certkit.render(r, str(tmp_path / n), "none")[0] for r, n in ((measured, "a"), (other, "b"))]
    from_files = certkit.compare(str(files[0].parent), str(files[1]))
    assert [row.error_percent for row in from_files.rows] == [row.error_percent for row in compared.rows]
    certkit.render(compared, str(tmp_path / "c"))
    assert {path.name for path in (tmp_path / "c").iterdir()} == {"comparison.json", "comparison.html"}
    assert certkit.load("comparison", str(tmp_path / "c")).id == compared.id


def test_a_logbook_takes_runs_and_says_what_is_left(measured: Result, tmp_path: Path):
    run = certkit.render(measured, str(tmp_path / "run"), "none")[0].parent
    (leg,) = certkit.logbook(str(tmp_path / "book"), tests=str(run), day="2026-04-01")
    assert (leg.serial, len(leg.tests), leg.day) == ("FLX-0007", 1, "2026-04-01")
    assert (
        certkit.logbook(str(tmp_path / "book"), tests=[str(run)], serials=["FLX-0007"])[0].tests == leg.tests
    )
    with pytest.raises(UsageError, match="is no day"):
        certkit.logbook(str(tmp_path / "book"), day="tomorrow")
    with pytest.raises(DataError, match="no logbook here"):
        certkit.logbook(str(tmp_path / "nothing"))


def test_a_document_has_no_values_to_change(tmp_path: Path):
    with pytest.raises(UsageError, match="cannot be changed"):
        certkit.load("result", str(tmp_path), overrides={"verdict": "pass"})
