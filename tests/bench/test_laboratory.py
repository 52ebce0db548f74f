"""The laboratory file: every mistake is told, sensors expire, a logo is a picture and nothing else."""

from __future__ import annotations

import zlib
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import pytest

from certkit.bench.laboratory_logo import embedded_logo
from certkit.bench.laboratory_terms import read_laboratory
from certkit.errors import DataError, DefinitionError, UsageError

if TYPE_CHECKING:
    from pathlib import Path

WHOLE = """\
laboratory: Example
place: Sampletown
item: {serial: FLX-1}
test: {performed: 2026-03-02}
sensors:
  - {channel: T1, serial: A, calibrated: 2025-03-02, expires: 2026-03-02}
  - {channel: T2, serial: B, calibrated: 2025-03-01, expires: 2026-03-01}
  - {channel: T3, serial: C, calibrated: 2026-03-03, expires: 2027-03-03}
uncertainties: {T1: 4 N·m, MCL: 0.25 mm}
decision: {rule: guard band, r: 0.5}
conditions: {temperature: 20.4 degC}
"""


def written(folder: Path, text: str = WHOLE) -> Path:
    path = folder / "lab.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def png(width: int = 40, height: int = 20) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return len(data).to_bytes(4, "big") + kind + data + zlib.crc32(kind + data).to_bytes(4, "big")

    head = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 0, 0, 0, 0])
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IEND", b"")


def test_a_sensor_covers_its_last_day_and_no_other(tmp_path: Path):
    checks = read_laboratory(written(tmp_path)).checks
    assert [check.verdict for check in checks] == ["pass", "fail", "fail"]
    expired, late = checks[1].coded_reason, checks[2].coded_reason
    assert (expired.code, expired.parameters["day"]) == ("sensor-expired", "2026-03-01")
    assert (late.code, late.parameters["day"]) == ("sensor-calibrated-later", "2026-03-03")


def test_uncertainties_and_conditions_are_si(tmp_path: Path):
    lab = read_laboratory(written(tmp_path))
    assert lab.uncertainties == pytest.approx({"T1": 4.0, "MCL": 0.25e-3})
    assert lab.conditions == pytest.approx({"temperature": 293.55})
    assert lab.decision.ratio == 0.5


def test_every_mistake_is_told_at_once_with_its_line(tmp_path: Path):
    text = (
        WHOLE.replace("channel: T1", "channel: Q1")
        .replace("T1: 4 N·m", "T1: 4 mm")
        .replace("0.25 mm", "0 mm")
    )
    text = text.replace("calibrated: 2025-03-01", "calibrated: 2026-09-01")
    with pytest.raises(DefinitionError) as caught:
        read_laboratory(written(tmp_path, text))
    places = {(problem.line, problem.message.split(";")[0]) for problem in caught.value.problems}
    assert any(line == 6 and "Q1" in said for line, said in places)
    assert any(line == 7 and "before it was calibrated" in said for line, said in places)
    assert any(line == 9 and "`4 mm`" in said for line, said in places)
    assert any(line == 9 and "greater than zero" in said for line, said in places)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("performed: 2026-03-02", "performed: yesterday"), "lab.yaml:4"),
        (("serial: FLX-1", "serial: ''"), "lab.yaml:3"),
        (("r: 0.5", "r: -1"), "lab.yaml:10"),
        (("rule: guard band", "rule: gut feeling"), "lab.yaml:10"),
        (("uncertainties: {T1: 4 N·m, MCL: 0.25 mm}\n", ""), "guard band needs `uncertainties`"),
    ],
)
def test_single_mistakes(tmp_path: Path, change: tuple[str, str], says: str):
    with pytest.raises(DefinitionError, match=says):
        read_laboratory(written(tmp_path, WHOLE.replace(*change)))


def test_a_condition_has_a_unit(tmp_path: Path):
    with pytest.raises(DataError, match="condition temperature"):
        read_laboratory(written(tmp_path, WHOLE.replace("20.4 degC", "warm")))


def test_a_logo_is_embedded(tmp_path: Path):
    (tmp_path / "logo.png").write_bytes(png())
    lab = read_laboratory(written(tmp_path, WHOLE + "logo: logo.png\n"))
    header: dict[str, Any] = lab.header or {}
    assert header["logo"].startswith("data:image/png;base64,")


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("logo.svg", b"<svg onload='alert(1)'/>", "neither PNG nor JPEG"),
        ("logo.png", b"GIF89a", "neither PNG nor JPEG"),
        ("logo.png", png(9000, 10), "pixels"),
        ("logo.png", png() + bytes(400_000), "kB"),
        ("../logo.png", png(), "outside"),
        ("missing.png", None, "no such logo"),
    ],
)
def test_a_logo_is_a_small_picture_beside_the_file(
    tmp_path: Path, name: str, content: bytes | None, says: str
):
    folder = tmp_path / "lab"
    folder.mkdir()
    if content is not None:
        (folder / name).write_bytes(content)
    with pytest.raises(DefinitionError, match=says):
        embedded_logo(name, folder)


SHARED = """\
laboratory: Example
place: Sampletown
numbering: {pattern: "EX-{year}-{number:03}"}
persons: [{name: B. Signatory, role: authorised the report, signs: true}]
equipment: [{name: hygrometer, serial: H-1, calibrated: 2025-01-10, expires: 2026-01-10}]
decision: {rule: guard band}
uncertainties: {T1: 4 N·m}
"""
TEST = """\
laboratory: Example
shared: lab.yaml
item: {serial: FLX-1}
test: {performed: 2026-03-02}
persons: [{name: A. Tester, role: performed the test}]
equipment: [{name: balance, serial: B-1, calibrated: 2025-06-01, expires: 2026-06-01}]
uncertainties: {T2: 3 N·m}
"""


def two_files(folder: Path, test: str = TEST, shared: str = SHARED) -> Path:
    written(folder, shared)
    (folder / "test.yaml").write_text(test, encoding="utf-8")
    return folder / "test.yaml"


def test_what_never_changes_stands_in_a_file_that_tests_share(tmp_path: Path):
    lab = read_laboratory(two_files(tmp_path))
    header: dict[str, Any] = lab.header or {}
    assert header["place"] == "Sampletown"
    assert [person["name"] for person in header["persons"]] == ["B. Signatory", "A. Tester"]
    assert lab.uncertainties == pytest.approx({"T1": 4.0, "T2": 3.0})
    assert lab.decision.ratio == 1.0
    assert [item.path for item in lab.inputs] == ["lab.yaml", "test.yaml"]


def test_expired_equipment_is_a_precondition_that_fails(tmp_path: Path):
    checks = {check.quantity: check for check in read_laboratory(two_files(tmp_path)).checks}
    assert checks["calibration left, balance B-1"].verdict == "pass"
    expired = checks["calibration left, hygrometer H-1"]
    assert (expired.verdict, expired.coded_reason.code) == ("fail", "equipment-expired")


def test_a_laboratorys_own_file_describes_no_test(tmp_path: Path):
    with pytest.raises(DefinitionError, match="describes no test"):
        read_laboratory(written(tmp_path, SHARED))


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("performed: 2026-03-02", "performed: 2026-03-02, replaces: 3F9A"), "`reason` is missing"),
        (("performed: 2026-03-02", "performed: 2026-03-02, revision: 1"), "`replaces` is missing"),
        (("performed: 2026-03-02", "performed: 2026-03-02, issued: 2026-03-01"), "before the test"),
        (("serial: FLX-1", "serial: FLX-1, received: 2026-03-03"), "after the test"),
        (("shared: lab.yaml\n", ""), "`place` is missing"),
        (("shared: lab.yaml", "shared: test.yaml"), "cannot share another"),
    ],
)
def test_mistakes_of_a_tests_own_file(tmp_path: Path, change: tuple[str, str], says: str):
    with pytest.raises(DefinitionError, match=says):
        read_laboratory(two_files(tmp_path, TEST.replace(*change)))


@pytest.mark.parametrize("pattern", ["EX-{year}", "EX-{number", "EX-{day}-{number}"])
def test_a_pattern_gives_every_report_a_number_of_its_own(tmp_path: Path, pattern: str):
    with pytest.raises(DefinitionError, match=r"pattern|same number"):
        read_laboratory(two_files(tmp_path, shared=SHARED.replace("EX-{year}-{number:03}", pattern)))


def number_of(path: Path, test: str) -> str:
    return str((read_laboratory(path, test=test).header or {})["test"]["number"])


def test_report_numbers_are_given_out_once(tmp_path: Path):
    path = two_files(tmp_path)
    assert number_of(path, "pendulum a") == "EX-2026-001"
    assert number_of(path, "pendulum b") == "EX-2026-002"
    assert number_of(path, "pendulum a") == "EX-2026-001"  # the same test graded again
    amended = "performed: 2026-03-02, revision: 1, replaces: 3F9A, reason: typing error, changes: the serial"
    amendment = two_files(tmp_path, TEST.replace("performed: 2026-03-02", amended))
    assert number_of(amendment, "pendulum b") == "EX-2026-002"
    chosen = two_files(
        tmp_path, TEST.replace("performed: 2026-03-02", "performed: 2026-03-02, number: EX-2026-001")
    )
    with pytest.raises(UsageError, match="EX-2026-001 belongs to another report"):
        number_of(chosen, "pendulum c")


def test_report_numbers_differ_also_among_processes_at_once(tmp_path: Path):
    path = two_files(tmp_path)
    with ThreadPoolExecutor(8) as pool:
        numbers = list(pool.map(lambda n: number_of(path, f"pendulum {n}"), range(16)))
    assert sorted(numbers) == [f"EX-2026-{n:03}" for n in range(1, 17)]


def test_a_register_that_is_none_is_not_written_over(tmp_path: Path):
    (tmp_path / "report-numbers.csv").write_text("a;b\n1;2\n")
    with pytest.raises(DataError, match="not a register"):
        number_of(two_files(tmp_path), "pendulum a")


def test_a_laboratory_file_in_another_encoding_is_refused_with_its_line(tmp_path: Path):
    path = tmp_path / "lab.yaml"
    path.write_bytes("laboratory: Prüflabor\nplace: Sampletown\n".encode("latin-1"))
    with pytest.raises(DefinitionError, match=r"lab\.yaml:1"):
        read_laboratory(path)
