"""OpenRadioss' native history in every layout that its format codes stand for, and the units it tells."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from certkit.definitions.virtual_test import History as Asked
from certkit.errors import DataError
from certkit.exchange.fe.radioss_variables import is_impulse
from certkit.exchange.fe.readers.openradioss_native import read_native
from certkit.exchange.fe.run_radioss import RadiossRun
from tests.support.radioss_writer import Group, History, written

TIME = np.linspace(0.0, 3.0, 16)
FORCE = 4.0 * np.sin(TIME)
LONG = "bumper foam, upper half, behind the fascia of the car"
"""53 characters: titles of 40 cut it."""

CODES = (3000, 3017, 3023, 3030, 3040, 3041, 3049, 3050, 3060, 4020, 4021, 4022)


def history() -> History:
    mass = np.full(TIME.size, 2.0)
    velocity = 11.0 - TIME
    return History(
        TIME,
        {LONG: {3: mass * velocity, 6: mass, 29: velocity}, "rigid": {}},
        [
            Group(0, {7: "node A", 9: "node B"}, {1: [TIME**2, TIME], 4: [2 * TIME, 1 + 0 * TIME]}),
            Group(101, {3: "leg to foam"}, {1: [np.cumsum(FORCE)]}),
            Group(104, {}, {}),  # nothing asked for: no record in any instant
            Group(104, {5: "cut"}, {1: [5.0 * TIME]}),
        ],
        subset={2: TIME},
        globals_=[TIME + k for k in range(22)],
    )


def put(folder: Path, content: bytes) -> Path:
    path = folder / "runT01"
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("code", CODES)
def test_every_known_code_yields_the_same_numbers(tmp_path: Path, code: int) -> None:
    found = read_native(put(tmp_path, written(history(), code)), "kg mm ms")
    assert found.notes == ()
    part = found.parts[LONG if code > 3040 else LONG[:40].strip()]
    assert part["XMOM"] == pytest.approx(2.0 * (11.0 - TIME), rel=1e-6)
    assert found.nodes["node B"]["DX"] == pytest.approx(TIME, rel=1e-6)
    assert found.contacts["leg to foam"]["FNX"] == pytest.approx(np.cumsum(FORCE), rel=1e-6)
    assert found.energies["outlet energy"] == pytest.approx(TIME + 21, rel=1e-6)


@pytest.mark.parametrize("code", [2999, 4100, 9999, 0, -1])
def test_a_code_that_is_not_known_is_one_clear_error(tmp_path: Path, code: int) -> None:
    with pytest.raises(DataError, match=rf"runT01: format code {code} is not known \(known: 3000 to"):
        read_native(put(tmp_path, written(history(), code, titles=40)))


def test_a_file_of_3050_without_its_further_records_is_read_as_the_converter_does(tmp_path: Path) -> None:
    found = read_native(put(tmp_path, written(history(), 3050, further=False, titles=80)), "t mm s")
    assert LONG in found.parts


def test_the_file_itself_says_how_long_its_titles_are(tmp_path: Path) -> None:
    assert LONG in read_native(put(tmp_path, written(history(), 4021, titles=64))).parts


@pytest.mark.parametrize(
    ("units", "factors"),
    [("kg mm ms", (1.0, 1e-3, 1e-3)), ("t mm s", (1e3, 1e-3, 1.0)), ("g mm ms", (1e-3, 1e-3, 1e-3))],
)
def test_units_that_the_file_tells_are_held_against_those_of_the_case(
    tmp_path: Path, units: str, factors: tuple[float, float, float]
) -> None:
    path = put(tmp_path, written(history(), 4021, factors=factors))
    assert read_native(path, units).notes == ()
    with pytest.raises(DataError, match=r"units of mass, length and time are .* kg, .* m, .* s, but"):
        read_native(path, "kg m s")
    with pytest.raises(DataError, match="correct `units`"):
        RadiossRun(path, "kg m s")


def test_units_that_the_file_leaves_open_are_remarked(tmp_path: Path) -> None:
    found = read_native(put(tmp_path, written(history(), 4021, factors=(1.0, 1.0, 1.0))), "kg mm ms")
    assert "unit factors are all 1" in found.notes[0]


@pytest.mark.parametrize("code", [3040, 4021])
def test_titles_of_another_length_are_no_numbers(tmp_path: Path, code: int) -> None:
    content = written(history(), code, further=False, titles=60)
    with pytest.raises(DataError, match="has 80 bytes where its format code asks for"):
        read_native(put(tmp_path, content))


def test_records_the_other_way_round_are_told(tmp_path: Path) -> None:
    head = struct.pack("<i", 84) + b"\0" * 84 + struct.pack("<i", 84)
    with pytest.raises(DataError, match="little-endian"):
        read_native(put(tmp_path, head))


def test_a_section_is_kind_104_and_its_forces_are_impulses_in_the_file(tmp_path: Path) -> None:
    path = put(tmp_path, written(history(), 4021))
    names = [(0, "DX"), (0, "VX"), (0, "DX"), (0, "VX"), (101, "FNX"), (104, "F1")]
    titles = tmp_path / "runT01_TITLES"
    titles.write_text("".join(f"{kind:10d}\n{name:10}\n" for kind, name in names))
    run = RadiossRun(path, "kg mm ms")
    asked = Asked.model_validate({"table": "section", "of": "cut", "variable": "F1"})
    assert run.history(asked, "force").values == pytest.approx(np.full(TIME.size, 5e3), rel=1e-5)
    titles.write_text(titles.read_text().replace("       104", "       101"))
    with pytest.raises(DataError, match=r"_TITLES:11: kind 101 where the history has kind 104"):
        RadiossRun(path, "kg mm ms")


def test_only_what_the_solver_accumulates_is_differentiated() -> None:
    accumulated = [(101, "FNX"), (102, "FX"), (103, "MZ"), (104, "M2"), (0, "REACX"), (101, "||FN||")]
    assert all(is_impulse(kind, name) for kind, name in accumulated)
    assert not any(
        is_impulse(kind, name) for kind, name in [(6, "FX"), (6, "MX"), (5, "M2"), (103, "M2"), (0, "DX")]
    )
