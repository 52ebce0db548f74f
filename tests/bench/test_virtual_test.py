"""A finite-element run is graded as a virtual test: alike from each solver's files, and only when sound."""

from __future__ import annotations

import importlib.util
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import certkit
from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Callable

RUNS = Path(__file__).parents[2] / "examples" / "finite-elements"
FORMATS = ["openradioss", "table"]
if importlib.util.find_spec("lasso") is not None:
    FORMATS.append("binout")


def graded(kind: str, folder: Path | None = None, mapping: Path | None = None) -> certkit.Result:
    return certkit.grade("vehicle", folder or RUNS / kind, mapping=mapping or RUNS / f"mapping-{kind}.yaml")


@pytest.fixture(scope="module")
def results() -> dict[str, certkit.Result]:
    return {kind: graded(kind) for kind in FORMATS}


def changed(folder: Path, change: Callable[[dict[str, np.ndarray]], None], **words: str) -> certkit.Result:
    """Grade a copy of the table with other columns, and of its mapping with other words."""
    heads, *rows = (RUNS / "table" / "leg.csv").read_text("utf-8").splitlines()
    values = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    columns = {head: values[:, k] for k, head in enumerate(heads.split(","))}
    change(columns)
    table = np.stack(list(columns.values()), axis=1)
    lines = [",".join(columns), *(",".join(f"{value:.9g}" for value in row) for row in table)]
    (folder / "leg.csv").write_text("\n".join(lines) + "\n", "utf-8")
    text = (RUNS / "mapping-table.yaml").read_text("utf-8")
    for old, new in words.items():
        assert old in text
        text = text.replace(old, new)
    (folder / "mapping.yaml").write_text(text, "utf-8")
    return graded("table", folder / "leg.csv", folder / "mapping.yaml")


def rows(result: certkit.Result) -> dict[str, certkit.documents.result.PreconditionResult]:
    return {row.quantity: row for row in result.preconditions}


def test_every_format_of_one_run_gives_the_same_values(results: dict[str, certkit.Result]):
    first = results["table"]
    assert (first.kind, first.verdict) == ("virtual test", "fail")
    for other in results.values():
        assert other.verdict == first.verdict
        values = {c.id: c.value for c in first.criteria if c.value is not None}
        assert len(values) == 12
        assert {i: other.criteria[i].value for i in values} == pytest.approx(values, rel=1e-6)
        told = {name: row.value for name, row in rows(first).items() if row.value is not None}
        assert {n: rows(other)[n].value for n in told} == pytest.approx(told, rel=1e-6, abs=1e-9)


def test_the_peaks_are_those_that_the_run_was_published_with(results: dict[str, certkit.Result]):
    published = {"T1": 344.7, "T2": 251.0, "T3": 193.7, "T4": 134.6, "F1": 342.0, "MCL": 27.75, "ACL": 12.13}
    for name, peak in published.items():
        assert results["table"].criteria[name].value == pytest.approx(peak, rel=1e-3)


def test_the_runs_quality_takes_the_place_of_the_laboratorys_room(results: dict[str, certkit.Result]):
    found = rows(results["table"])
    assert {"temperature", "humidity", "soak time"}.isdisjoint(found)
    assert {"speed", "free-flight noise", "energy ratio", "certification of the legform model"} <= set(found)
    assert found["energy ratio"].value == pytest.approx(98.53, abs=0.01)
    # It flies for 1 ms; the central difference of the impulse sees the contact a row of 0.08 ms before.
    assert found["free flight"].value == pytest.approx(0.92, abs=0.08)
    assert all(row.verdict == "pass" for row in found.values() if row.required)


def test_hourglass_energy_of_a_fifth_is_not_evaluated(tmp_path: Path):
    def hourglass(columns: dict[str, np.ndarray]) -> None:
        columns["hourglass_J"][:] = 0.2 * columns["internal_J"]

    result = changed(tmp_path, hourglass)
    assert result.verdict == "not evaluated"
    assert rows(result)["hourglass energy"].verdict == "fail"
    assert "hourglass energy is 20 %, outside at most 10 %" in " ".join(result.remarks)


def test_a_run_without_energies_is_not_evaluated(tmp_path: Path):
    text = (RUNS / "mapping-table.yaml").read_text("utf-8")
    begin, end = text.index("  energies:"), text.index("  speed:")
    result = changed(tmp_path, lambda _: None, **{text[begin:end]: ""})
    assert result.verdict == "not evaluated"
    open_ones = [
        name for name, row in rows(result).items() if row.verdict == "not evaluated" and row.required
    ]
    assert open_ones == ["energy ratio", "hourglass energy", "mass scaling", "contact energy"]


@pytest.mark.parametrize(
    ("quantity", "change"),
    [
        ("mass scaling", lambda c: c["mass_kg"].__setitem__(slice(300, None), 1.06 * c["mass_kg"][0])),
        ("energy ratio", lambda c: c["internal_J"].__setitem__(slice(300, None), 1000.0)),
        ("contact energy", lambda c: c["contact_J"].__setitem__(slice(300, None), -20.0)),
        ("free flight", lambda c: c["contact_N"].__setitem__(slice(0, 13), 500.0)),
        ("speed", lambda c: c["knee_vx_mps"].__setitem__(slice(0, 13), 10.0)),
        ("free-flight noise", lambda c: c["T1_Nm"].__setitem__(slice(2, 6), 20.0)),
    ],
)
def test_each_limit_holds(quantity: str, change: Callable[[dict[str, np.ndarray]], None], tmp_path: Path):
    result = changed(tmp_path, change)
    assert (result.verdict, rows(result)[quantity].verdict) == ("not evaluated", "fail")


def test_a_legform_model_without_its_own_certification_is_not_evaluated(tmp_path: Path):
    own = ', certification: "its own pendulum, inverse and static tests, examples/calibrate/fe-leg"'
    result = changed(tmp_path, lambda _: None, **{own: ""})
    assert result.verdict == "not evaluated"
    assert "names no certification of the legform model" in " ".join(result.remarks)


def test_a_swapped_or_missing_history_is_told(tmp_path: Path):
    with pytest.raises(DataError, match=r"no column `T9_Nm`; did you mean `T._Nm`"):
        changed(tmp_path, lambda _: None, T1_Nm="T9_Nm")
    with pytest.raises(DataError, match="should be a moment"):
        changed(tmp_path, lambda _: None, T1_Nm="MCL_elong_mm")


def test_a_run_without_a_mapping_asks_for_one():
    with pytest.raises(DataError, match="--mapping"):
        certkit.grade("vehicle", RUNS / "openradioss" / "legT01.gz")


def test_the_certificate_is_verified_from_itself_and_from_the_run(
    results: dict[str, certkit.Result], tmp_path: Path
):
    path = tmp_path / "result.json"
    path.write_text(results["openradioss"].to_json(), "utf-8")
    checks = certkit.verify(path, data=[RUNS / "openradioss"])
    assert [check.what for check in checks.checks if check.outcome == "does not hold"] == []


def test_a_quality_that_the_run_does_not_have_is_found_beside_it(
    results: dict[str, certkit.Result], tmp_path: Path
):
    told = results["table"]
    better = {**told.conditions, "energy ratio": 1.0}
    rows_ = [
        r.model_copy(update={"value": 100.0}) if r.quantity == "energy ratio" else r
        for r in told.preconditions
    ]
    forged = told.model_copy(update={"conditions": better, "preconditions": rows_}).with_id()
    path = tmp_path / "result.json"
    path.write_text(forged.to_json(), "utf-8")
    assert certkit.verify(path, data=[RUNS / "table"]).outcome == "does not hold"


def test_as_iso_mme_it_is_a_virtual_test_still_and_keeps_its_quality(
    results: dict[str, certkit.Result], tmp_path: Path
):
    archive, mapping = tmp_path / "run.zip", tmp_path / "mapping.yaml"
    certkit.export(results["table"], archive)
    mapping.write_text("mapping: own\nlegform model: {name: a leg, certification: report 7}\n", "utf-8")
    again = certkit.grade("vehicle", archive, mapping=mapping)
    assert (again.kind, again.verdict) == ("virtual test", "fail")
    assert rows(again)["energy ratio"].value == pytest.approx(rows(results["table"])["energy ratio"].value)
    assert certkit.grade("vehicle", archive).verdict == "not evaluated"  # nobody names the model


def test_a_simulation_of_another_program_is_no_certification_by_certkit(tmp_path: Path):
    archive = tmp_path / "own.zip"
    certkit.export(certkit.run("pendulum", refine=False), archive)
    assert certkit.grade("pendulum", archive).kind == "virtual certification"
    foreign = tmp_path / "foreign.zip"
    with zipfile.ZipFile(archive) as own, zipfile.ZipFile(foreign, "w") as other:
        for name in own.namelist():
            lines = own.read(name).decode().splitlines(keepends=True)
            other.writestr(name, "".join(line for line in lines if "simulated by certkit" not in line))
    result = certkit.grade("pendulum", foreign)
    assert (result.kind, result.verdict) == ("virtual test", "not evaluated")
