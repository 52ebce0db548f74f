"""`certkit grade`: verdicts, exit codes, and nothing written when the data cannot be used."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from msgspec.structs import replace
from support.curves import write_csv
from support.damage import DAMAGES
from support.pendulum_recording import pendulum_like

from certkit.bench import grade_measurement
from certkit.bench.run_simulation import run
from certkit.cli import main
from certkit.errors import DataError, RunError
from certkit.exchange.channels_csv import channels_csv
from certkit.exchange.mme_write import write_mme

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray
    from support.damage import Damage

    from certkit.signals import Recording

    Command = Callable[..., tuple[int, str, str]]

LAB = """\
laboratory: Example Crash Laboratory
place: Sampletown
item: {serial: FLX-0007}
test: {performed: 2026-03-02, number: "2026-014"}
sensors:
  - {channel: T1, serial: SG-11, calibrated: 2025-06-01, expires: EXPIRES}
uncertainties: {T1: 4 N·m, T2: 4 N·m, T3: 4 N·m, T4: 4 N·m, MCL: 0.1 mm, ACL: 0.1 mm, PCL: 0.1 mm}
decision: {rule: RULE}
conditions: {added mass: 5.01 kg}
"""


@pytest.fixture
def certkit(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Command:
    """Run the command in this process; return exit code, standard output and standard error."""

    def run(*arguments: object) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["certkit", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            main()
        printed = capsys.readouterr()
        return int(left.value.code or 0), printed.out, printed.err

    return run


@pytest.fixture
def data(tmp_path: Path) -> Path:
    recording = pendulum_like()
    write_mme(
        replace(recording, conditions={**recording.conditions, "added mass": 5.0}), tmp_path / "leg.zip"
    )
    return tmp_path / "leg.zip"


def laboratory(folder: Path, *, expires: str = "2026-06-01", rule: str = "simple acceptance") -> Path:
    path = folder / "lab.yaml"
    path.write_text(LAB.replace("EXPIRES", expires).replace("RULE", rule), encoding="utf-8")
    return path


def scaled(recording: Recording, name: str, peak: float) -> Recording:
    channel = recording[name]
    values = channel.values * peak / np.abs(channel.values).max()
    channels = {**recording.channels, name: replace(channel, values=values)}
    return replace(recording, channels=channels, conditions={**recording.conditions, "added mass": 5.0})


def grade(certkit: Command, data: Path, *more: object) -> tuple[int, dict[str, object]]:
    out = data.parent / "out"
    code, printed, _ = certkit(
        "grade", "--procedure", "pendulum", data, "--out", out, "--force", "--format", "csv", "--json", *more
    )
    return code, json.loads(printed)


def criterion(result: dict[str, object], name: str) -> dict[str, object]:
    return next(c for c in result["criteria"] if c["id"] == name)


def test_a_good_test_passes(certkit: Command, data: Path):
    code, result = grade(certkit, data)
    assert (code, result["verdict"], result["kind"]) == (0, "pass", "test evaluation")
    assert criterion(result, "T1")["value"] == pytest.approx(250.0, rel=1e-3)


def test_a_missing_channel_is_not_evaluated(certkit: Command, tmp_path: Path):
    recording = pendulum_like()
    left = {name: channel for name, channel in recording.channels.items() if name != "T1"}
    write_csv(scaled(replace(recording, channels=left), "T2", 200.0), tmp_path / "leg.csv")
    code, result = grade(certkit, tmp_path / "leg.csv")
    assert (code, result["verdict"]) == (4, "not evaluated")
    assert criterion(result, "T1")["verdict"] == "not evaluated"
    assert grade(certkit, tmp_path / "leg.csv", "--allow", "not-evaluated")[0] == 0


def test_a_value_outside_its_corridor_fails(certkit: Command, tmp_path: Path):
    write_csv(scaled(pendulum_like(), "T1", 280.0), tmp_path / "leg.csv")
    code, result = grade(certkit, tmp_path / "leg.csv")
    assert (code, result["verdict"], criterion(result, "T1")["verdict"]) == (1, "fail", "fail")


def test_a_value_inside_the_guard_band_is_conditional(certkit: Command, tmp_path: Path):
    write_csv(scaled(pendulum_like(), "T1", 270.0), tmp_path / "leg.csv")
    simple, result = grade(certkit, tmp_path / "leg.csv")
    assert (simple, result["verdict"]) == (0, "pass")
    (tmp_path / "lab").mkdir()
    write_csv(
        replace(scaled(pendulum_like(), "T1", 270.0), conditions=pendulum_like().conditions),
        tmp_path / "leg.csv",
    )
    lab = laboratory(tmp_path / "lab", rule="guard band")
    code, result = grade(certkit, tmp_path / "leg.csv", "--lab", lab)
    assert (code, result["verdict"], criterion(result, "T1")["verdict"]) == (1, "conditional", "conditional")
    assert "guard band" in result["decision_rule"]
    uncertainty = criterion(result, "T1")["uncertainty"]
    assert uncertainty["guard_band"] == pytest.approx(4.0)
    # 2 N·m from the limit with u = 2 N·m: one standard deviation, 16 % lie beyond.
    assert uncertainty["false_accept"] == pytest.approx(0.159, abs=0.005)


def test_an_expired_sensor_is_a_failed_precondition(certkit: Command, table: Path, tmp_path: Path):
    lab = laboratory(tmp_path, expires="2026-03-01")
    code, result = grade(certkit, table, "--lab", lab)
    assert (code, result["verdict"]) == (4, "not evaluated")
    row = next(p for p in result["preconditions"] if "SG-11" in p["quantity"])
    assert "expired on 2026-03-01" in row["reason"]


def test_a_laboratory_fills_the_header(certkit: Command, table: Path, tmp_path: Path):
    code, result = grade(certkit, table, "--lab", laboratory(tmp_path))
    assert code == 0
    assert result["laboratory"]["item"]["serial"] == "FLX-0007"
    assert result["specimen"]["serial"] == "FLX-0007"
    assert {"recording", "laboratory"} <= {item["role"] for item in result["provenance"]["inputs"]}


def test_a_test_too_warm_is_not_evaluated(certkit: Command, tmp_path: Path):
    recording = scaled(pendulum_like(), "T1", 250.0)
    write_csv(
        replace(recording, conditions={**recording.conditions, "temperature": 298.15}), tmp_path / "leg.csv"
    )
    code, result = grade(certkit, tmp_path / "leg.csv")
    assert (code, result["verdict"]) == (4, "not evaluated")
    row = next(p for p in result["preconditions"] if p["quantity"] == "temperature")
    assert (row["verdict"], row["value"]) == ("fail", pytest.approx(25.0))


def test_laboratory_and_data_must_agree(certkit: Command, data: Path, tmp_path: Path):
    lab = laboratory(tmp_path)
    lab.write_text(lab.read_text(encoding="utf-8").replace("5.01 kg", "6 kg"), encoding="utf-8")
    code, _, said = certkit("grade", "--procedure", "pendulum", data, "--lab", lab, "--out", tmp_path / "out")
    assert code == 2
    assert "condition added mass" in said


@pytest.mark.parametrize(("told", "refused"), [("Inverse test", True), ("pendulum impact", False)])
def test_a_header_that_names_another_kind_of_test_is_refused(tmp_path: Path, told: str, *, refused: bool):
    recording = pendulum_like()
    conditions = {**recording.conditions, "added mass": 5.0}
    data = tmp_path / "leg"
    write_mme(replace(recording, conditions=conditions), data)
    master = next(data.glob("*.mme"))
    master.write_text(re.sub(r"(?m)^(Type of the test\s*:).*", rf"\1{told}", master.read_text()))
    if not refused:
        assert grade_measurement.grade("pendulum", data).verdict == "pass"
        return
    with pytest.raises(DataError, match="`Type of the test` is `Inverse test`"):
        grade_measurement.grade("pendulum", data)


def assert_refused(certkit: Command, data: Path, says: str) -> None:
    out = data.parent / "refused"
    code, printed, said = certkit("grade", "--procedure", "pendulum", data, "--out", out)
    assert code == 2
    assert printed == ""
    assert said.startswith("error: ")
    assert said.count("\n") == 1
    assert says in said
    assert not out.exists()


@pytest.mark.parametrize("damage", DAMAGES, ids=lambda d: d.name)
def test_damaged_data_end_with_2_and_nothing_is_written(
    damage: Damage, certkit: Command, mme: Path, table: Path
):
    assert_refused(certkit, damage.do(mme if damage.container == "mme" else table), "leg")


def test_a_swapped_polarity_is_refused(certkit: Command, tmp_path: Path):
    recording = pendulum_like()
    turned = replace(recording["T1"], values=-recording["T1"].values)
    write_csv(replace(recording, channels={**recording.channels, "T1": turned}), tmp_path / "leg.csv")
    assert_refused(certkit, tmp_path / "leg.csv", "`T1` has its polarity swapped")


@pytest.mark.parametrize("how", [(), ("--lenient",)], ids=["strict", "lenient"])
def test_a_value_that_stands_for_a_missing_sample_is_told_as_a_jump(
    certkit: Command, tmp_path: Path, how: tuple[str, ...]
):
    recording = pendulum_like()
    values = recording["T1"].values.copy()
    values[int(np.argmax(values)) + 40] = -9999.0
    spiked = replace(recording["T1"], values=values)
    write_csv(replace(recording, channels={**recording.channels, "T1": spiked}), tmp_path / "leg.csv")
    code, printed, errors = certkit("grade", "-p", "pendulum", tmp_path / "leg.csv", "--format", "none", *how)
    assert code == 4, errors
    assert "T1: it jumps by" in printed


def test_a_clipped_channel_is_refused(certkit: Command, tmp_path: Path):
    recording = pendulum_like()
    clipped = replace(recording["T1"], values=np.minimum(recording["T1"].values, 180.0))
    write_csv(replace(recording, channels={**recording.channels, "T1": clipped}), tmp_path / "leg.csv")
    assert_refused(certkit, tmp_path / "leg.csv", "`T1` is clipped at 180 N·m")


@pytest.mark.parametrize("name", ["nothing.csv", "nothing.zip", "nothing"])
def test_missing_data_are_refused(certkit: Command, tmp_path: Path, name: str):
    assert_refused(certkit, tmp_path / name, "there is no such file or folder")


def test_a_simulated_test_grades_alike_after_every_export(certkit: Command, tmp_path: Path):
    run = tmp_path / "run"
    _, printed, _ = certkit("run", "--procedure", "pendulum", "--out", run, "--format", "csv", "--json")
    own = json.loads(printed)
    for target in ("pendulum.zip", "pendulum.csv", "pendulum"):
        assert certkit("export", run, tmp_path / target)[0] == 0
        _, result = grade(certkit, tmp_path / target)
        assert result["verdict"] == own["verdict"]
        assert result["kind"] == "virtual certification"
        for mine, theirs in zip(result["criteria"], own["criteria"], strict=True):
            assert mine["verdict"] == theirs["verdict"]
            assert mine["value"] == pytest.approx(theirs["value"], rel=1e-3)
    # The table of the run itself is known by the document beside it.
    for data in (run, run / "channels.csv"):
        _, result = grade(certkit, data)
        assert (result["kind"], result["verdict"]) == ("virtual certification", own["verdict"])


def test_a_record_longer_than_a_certificate_can_carry_is_refused_before_it_is_graded(
    table: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(grade_measurement, "MAX_CARRIED_VALUES", 5_000)
    with pytest.raises(DataError, match=r"channels of [\d,]+ samples are more than a certificate can carry"):
        grade_measurement.grade("pendulum", table)


def test_a_run_longer_than_a_document_can_hold_is_refused_before_it_is_simulated():
    with pytest.raises(RunError, match=r"a run of 3\.002 s .* is more than a document can hold"):
        run("inverse", overrides={"run.until": "3 s"})


@pytest.mark.parametrize(
    ("changed", "code"),
    [
        (lambda t1: np.minimum(t1, 240.0), "clipped"),
        (lambda t1: 10.0 * t1, "unit-out-by-ten"),
    ],
)
def test_a_simulated_table_that_was_changed_on_its_way_is_doubted(
    tmp_path: Path, changed: Callable[[NDArray[np.float64]], NDArray[np.float64]], code: str
):
    lines = channels_csv(run("inverse", refine=False)).splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("time"))
    column = lines[first].split(",").index("T1 [N·m]")
    rows = [line.split(",") for line in lines[first + 1 :]]
    values = changed(np.array([float(row[column]) for row in rows]))
    for row, value in zip(rows, values, strict=True):
        row[column] = repr(float(value))
    table = tmp_path / "channels.csv"
    table.write_text("\n".join([*lines[: first + 1], *(",".join(row) for row in rows)]), "utf-8")
    result = grade_measurement.grade("inverse", table)
    reason = next(criterion.coded_reason for criterion in result.criteria if criterion.id == "T1")
    assert reason is not None
    assert reason.code == code
