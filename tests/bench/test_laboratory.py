"""The laboratory file: every mistake is told, sensors expire, a logo is a picture and nothing else."""

from __future__ import annotations

import zlib
from typing import TYPE_CHECKING, Any

import pytest

from certkit.bench.laboratory_terms import embedded_logo, read_laboratory
from certkit.errors import DataError, DefinitionError

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
