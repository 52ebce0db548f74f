"""What a container says of its data counts: where they came from, what test they are of, where they lie."""

from __future__ import annotations

import re
import shutil
import zipfile
from pathlib import Path

import pytest

import certkit
from certkit.errors import DataError

DATA = Path(__file__).parents[2] / "examples" / "measured" / "FLX-0007-pendulum.zip"
STATIC = Path(__file__).parents[2] / "examples" / "certification" / "FLX-0007-static-femur.zip"


def _saying(folder: Path, words: str, value: str, *, suffix: str = "[0-9]", data: Path = DATA) -> Path:
    """Unpack a test, and write another value behind a descriptor of its files."""
    with zipfile.ZipFile(data) as archive:
        archive.extractall(folder)
    for path in folder.rglob(f"*{suffix}"):
        text = path.read_text("latin-1")
        path.write_text(re.sub(rf"(?m)^({words} *:).*", rf"\g<1>{value}", text), "latin-1")
    return folder


@pytest.mark.parametrize(
    ("source", "kind", "remarked"),
    [
        ("transducer", "test evaluation", False),
        ("Strain gauge", "test evaluation", False),
        ("NOVALUE", "test evaluation", False),
        ("calculation", "test evaluation", True),
        ("unknown", "test evaluation", True),
        ("simulation", "virtual test", False),
        ("simulated", "virtual test", False),
        ("FE model of the legform", "virtual test", False),
        ("LS-DYNA R13", "virtual test", False),
    ],
)
def test_what_was_simulated_is_no_measured_test(
    tmp_path: Path, source: str, kind: str, *, remarked: bool
) -> None:
    result = certkit.grade("pendulum", _saying(tmp_path / "leg", "Data source", source))
    assert result.kind == kind
    said = [each for each in result.remarks if f"`Data source` is `{source}`" in each]
    assert len(said) == remarked


@pytest.mark.parametrize("told", ["Vehicle test", "pedestrian leg to bumper", "static bending"])
def test_a_pendulum_test_is_no_test_of_another_kind(tmp_path: Path, told: str) -> None:
    with pytest.raises(DataError, match=f"`Type of the test` is `{told}`"):
        certkit.grade("pendulum", _saying(tmp_path / "leg", "Type of the test", told, suffix=".mme"))


def test_a_femur_is_not_bent_as_a_tibia(tmp_path: Path) -> None:
    data = _saying(tmp_path / "leg", "Type of the test", "static femur", suffix=".mme", data=STATIC)
    assert certkit.grade("static-femur", data).procedure == "static-femur"
    with pytest.raises(DataError, match="static femur"):
        certkit.grade("static-tibia", data)


@pytest.mark.parametrize("sample", ["1e308", "-1e200", "1e15"])
def test_a_sample_beyond_all_measuring_is_named_with_its_line(tmp_path: Path, sample: str) -> None:
    folder = _saying(tmp_path / "leg", "nothing", "")
    channel = folder / "Channel" / "FLX-0007-pendulum.004"
    lines = channel.read_text("latin-1").split("\n")
    lines[900] = sample
    channel.write_text("\n".join(lines), "latin-1")
    with pytest.raises(DataError, match=r"pendulum\.004:901: .* larger than anything that is measured"):
        certkit.grade("pendulum", folder)


def test_the_same_data_make_the_same_certificate_wherever_they_lie(tmp_path: Path) -> None:
    first = _saying(tmp_path / "one" / "leg", "Data status", "questionable data")
    shutil.copytree(first, tmp_path / "two" / "deeper" / "leg")
    one, two = (certkit.grade("pendulum", tmp_path / at / "leg") for at in ("one", "two/deeper"))
    assert one.id == two.id
    assert any("leg/Channel/FLX-0007-pendulum.004:20: data status" in each for each in one.remarks)
    assert str(tmp_path) not in one.to_json()
