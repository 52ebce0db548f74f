"""Shipped extraction cases in other units, orders and hands: the same numbers, or one clear error."""

from __future__ import annotations

import csv
import gzip
import io
import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.errors import DataError, InputError
from certkit.exchange.fe.readers.openradioss_native import read_native
from certkit.exchange.fe.reading import read_case_data
from certkit.identification.five_steps import extract
from tests.support.radioss_writer import Group, History, written

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.exchange.fe import PartHistories
    from certkit.identification import ExtractionResult

EXAMPLES = Path(__file__).parents[3] / "examples/extract"
BUMPER, FRONT = EXAMPLES / "bumper-reference", EXAMPLES / "front1"
TABLE = "histories.csv"
Rows = list[list[str]]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("case-tidy.yaml", "foam-curve.csv", TABLE):
        shutil.copy(BUMPER / name, tmp_path)
    return tmp_path


def read(folder: Path, case: str = "case-tidy.yaml") -> PartHistories:
    return read_case_data(load("case", folder / case).document.histories, folder).histories


def extracted(folder: Path, case: str = "case-tidy.yaml") -> ExtractionResult:
    return extract(load("case", folder / case).document, folder)


def require_same(found: PartHistories, wanted: PartHistories) -> None:
    """Hold histories against each other, to a millionth of the largest or to a 32-bit place of 0.1 m."""

    def near(a: object, b: object, least: float = 0.0) -> None:
        values = np.asarray(b, float)
        most = max(1e-6 * float(np.abs(values).max()), least, 1e-12)
        np.testing.assert_allclose(np.asarray(a, float), values, rtol=0, atol=most)

    near(found.time, wanted.time)
    assert found.parts.keys() == wanted.parts.keys()
    for name, part in wanted.parts.items():
        near(found.parts[name].momentum, part.momentum)
        near(found.parts[name].displacement, part.displacement, 1.5e-8)
        assert found.parts[name].mass == pytest.approx(part.mass, rel=1e-6)
    for name, contact in wanted.contacts.items():
        near(found.contacts[name].impulse, contact.impulse)
    for name, node in wanted.nodes.items():
        near(found.nodes[name], node)


def rows_of(folder: Path) -> Rows:
    return list(csv.reader(io.StringIO((folder / TABLE).read_text("utf-8"))))


def put(folder: Path, rows: Rows, *, mark: str = ",", end: str = "\n") -> None:
    (folder / TABLE).write_bytes("".join(mark.join(row) + end for row in rows).encode())


def in_units(folder: Path, units: dict[str, tuple[str, float]]) -> None:
    """Rename columns by the ends of their names, scale them, and rename them in the case."""
    rows = rows_of(folder)
    case = (folder / "case-tidy.yaml").read_text("utf-8")
    for k, name in enumerate(rows[0]):
        stem, _, unit = name.rpartition("_")
        if unit in units:
            other, factor = units[unit]
            rows[0][k] = f"{stem}_{other}"
            case = re.sub(rf"\b{name}\b", rows[0][k], case)
            for row in rows[1:]:
                row[k] = f"{factor * float(row[k]):.12g}"
    put(folder, rows)
    (folder / "case-tidy.yaml").write_text(case, "utf-8")


def shuffled(folder: Path) -> None:
    rows = rows_of(folder)
    order = np.random.default_rng(1).permutation(len(rows[0]))
    put(folder, [[row[k] for k in order] for row in rows])


def packed(folder: Path) -> None:
    (folder / f"{TABLE}.gz").write_bytes(gzip.compress((folder / TABLE).read_bytes()))
    (folder / TABLE).unlink()


def with_commas(folder: Path) -> None:
    put(folder, [[cell.replace(".", ",") for cell in row] for row in rows_of(folder)], mark=";")


SAME: dict[str, Callable[[Path], None]] = {
    "metres, seconds, newtons": lambda f: in_units(
        f, {"mm": ("m", 1e-3), "ms": ("s", 1e-3), "kN": ("N", 1e3)}
    ),
    "millimetres, milliseconds, kilonewtons": lambda f: in_units(f, {"Ns": ("kNms", 1.0), "N": ("kN", 1e-3)}),
    "tonnes, millimetres, seconds": lambda f: in_units(f, {"ms": ("s", 1e-3), "Ns": ("kNs", 1e-3)}),
    "columns in another order": shuffled,
    "further columns": lambda f: put(
        f, [[*row, "note" if k == 0 else "7"] for k, row in enumerate(rows_of(f))]
    ),
    "a packed file": packed,
    "ends of lines as on Windows": lambda f: put(f, rows_of(f), end="\r\n"),
    "a comma behind every row": lambda f: put(f, [[*row, ""] for row in rows_of(f)]),
    "blank lines": lambda f: put(f, [rows_of(f)[0], [], *rows_of(f)[1:], []]),
    "semicolons and decimal commas": with_commas,
    "tabs": lambda f: put(f, rows_of(f), mark="\t"),
}


@pytest.mark.parametrize("change", SAME)
def test_the_same_table_in_another_hand_gives_the_same_numbers(folder: Path, change: str) -> None:
    SAME[change](folder)
    require_same(read(folder), read(BUMPER))


def column(folder: Path, name: str, change: Callable[[float], float]) -> None:
    rows = rows_of(folder)
    k = rows[0].index(name)
    for row in rows[1:]:
        row[k] = f"{change(float(row[k])):.12g}"
    put(folder, rows)


def exchanged(folder: Path, first: str, second: str) -> None:
    rows = rows_of(folder)
    a, b = rows[0].index(first), rows[0].index(second)
    for row in rows[1:]:
        row[a], row[b] = row[b], row[a]
    put(folder, rows)


def without(folder: Path, begin: int, end: int) -> None:
    rows = rows_of(folder)
    put(folder, rows[:begin] + rows[end:])


REFUSED: dict[str, tuple[Callable[[Path], None], str]] = {
    "rows that are no numbers": (
        lambda f: put(f, [["nan"] * len(r) if 100 <= k < 105 else r for k, r in enumerate(rows_of(f))]),
        r"histories\.csv: `time_ms` is not a finite number in row 100|the time of row 100",
    ),
    "decimal commas between commas": (
        lambda f: put(f, [[c.replace(".", ",") for c in row] for row in rows_of(f)]),
        r"histories\.csv:\d+: \d+ cells, the head has \d+",
    ),
    "a row cut short": (
        lambda f: (f / TABLE).write_bytes((f / TABLE).read_bytes()[:50_000]),
        r"histories\.csv:\d+: .*(cells, the head has|is not a number|an empty cell)",
    ),
    "rows twice, as after a restart": (
        lambda f: put(f, rows_of(f)[:300] + rows_of(f)[280:]),
        "time does not increase at row 300",
    ),
    "rows that lack": (lambda f: without(f, 200, 260), "there is a hole of .* in the histories at"),
    "metres called millimetres": (
        lambda f: column(f, "xcg_fascia_disp_mm", lambda v: 1e-3 * v),
        "part `fascia` moves by 0.1498 mm, its momentum over its mass gives 149.8 mm; check the units",
    ),
    "seconds called milliseconds": (
        lambda f: column(f, "time_ms", lambda v: 1e-3 * v),
        "the histories last 3.99.*e-05 s",
    ),
    "microseconds called milliseconds": (
        lambda f: column(f, "time_ms", lambda v: 1e3 * v),
        "the histories last 39.9. s",
    ),
    "a momentum a thousand times too large": (
        lambda f: column(f, "P_fascia_Ns", lambda v: 1e3 * v),
        "part `fascia` moves at up to .* m/s by its momentum and mass",
    ),
    "a momentum of the other sign": (
        lambda f: column(f, "P_impactor_Ns", lambda v: -v),
        "part `impactor` moves by 140.4 mm, .*, on another course; check the units and signs",
    ),
    "columns of two parts exchanged": (
        lambda f: exchanged(f, "P_fascia_Ns", "P_foam_Ns"),
        r"part `(fascia|foam)` moves by .* its momentum over its mass gives",
    ),
    "a file that is missing": (lambda f: (f / TABLE).unlink(), r"histories\.csv: there is no such file"),
}  # fmt: skip


@pytest.mark.parametrize("change", REFUSED)
def test_a_table_that_cannot_be_right_is_one_clear_error(folder: Path, change: str) -> None:
    spoil, said = REFUSED[change]
    spoil(folder)
    with pytest.raises(DataError, match=said):
        extracted(folder)


def test_contacts_in_another_unit_do_not_close(folder: Path) -> None:
    column(folder, "J_fascia_foam_Ns", lambda v: 1e-3 * v)
    result = extracted(folder)
    assert result.closed is False
    assert any("impulse does not close: fascia – beam" in said for said in result.warnings)


def test_histories_that_end_in_the_middle_of_the_impact_are_warned_of(folder: Path) -> None:
    without(folder, 130, 10_000)
    told = [said for said in extracted(folder).warnings if "are they cut?" in said]
    assert len(told) == 1
    assert "end at 6.371 ms, while the impactor still pushes with 10588 N of 10707 N" in told[0]


def test_times_that_jitter_change_a_peak_force_by_little(folder: Path) -> None:
    rows = rows_of(folder)
    values = np.array(rows[1:], float)
    rng = np.random.default_rng(2)
    time = values[:, 0] + rng.uniform(-0.01, 0.01, len(values))
    again = np.stack([time, *(np.interp(time, values[:, 0], v) for v in values.T[1:])], axis=1)
    put(folder, [rows[0], *([f"{v:.12g}" for v in row] for row in again)])
    peaks = [
        next(p for p in extracted(f).paths if p.name == "fascia – beam").peak_force for f in (folder, BUMPER)
    ]
    assert peaks[0] == pytest.approx(peaks[1], rel=0.01)


UNITS = {
    "kg mm ms": (1.0, 1e-3, 1e-3),
    "g mm ms": (1e-3, 1e-3, 1e-3),
    "t mm s": (1e3, 1e-3, 1.0),
    "kg m s": (1.0, 1.0, 1.0),
}


def native_in(folder: Path, units: str, *, told: bool = True) -> None:
    """Write the shipped native history in other units, in a layout that tells them."""
    shipped = read_native(BUMPER / "time-history.T01.gz")
    mass, length, time = UNITS[units]
    m, x, t = 1.0 / mass, 1e-3 / length, 1e-3 / time
    factors = {3: m * x / t, 6: m, 9: x, 29: x / t}
    names = {3: "XMOM", 6: "MASS", 9: "XCG", 29: "VX"}
    parts = {p: {n: factors[n] * v[names[n]] for n in names} for p, v in shipped.parts.items()}
    nodes, contacts = shipped.nodes, shipped.contacts
    groups = [
        Group(
            0,
            dict(enumerate(nodes, 1)),
            {1: [x * v["DX"] for v in nodes.values()], 4: [x / t * v["VX"] for v in nodes.values()]},
        ),
        Group(
            101,
            dict(enumerate(contacts, 1)),
            {k: [m * x / t * v[n] for v in contacts.values()] for k, n in ((1, "FNX"), (4, "FTX"))},
        ),
    ]
    code = 4021 if told else 3040
    content = written(History(t * shipped.time, parts, groups), code, factors=UNITS[units])
    (folder / "time-history.T01").write_bytes(content)
    text = (BUMPER / "case.yaml").read_text("utf-8").replace("units: kg mm ms", f"units: {units}")
    (folder / "case.yaml").write_text(text, "utf-8")


@pytest.mark.parametrize("units", UNITS)
def test_a_native_history_in_other_units_gives_the_same_numbers(tmp_path: Path, units: str) -> None:
    native_in(tmp_path, units)
    require_same(read(tmp_path, "case.yaml"), read(BUMPER, "case.yaml"))


@pytest.mark.parametrize(
    ("said_in_case", "said"),
    [
        ("t mm s", "the histories last 39.95 s"),
        ("kg m s", "the histories last 39.95 s"),
        ("kg m ms", r"moves at up to \d+ m/s by its momentum and mass; correct `units`"),
    ],
)
def test_wrong_units_of_a_history_that_tells_none_are_seen(
    tmp_path: Path, said_in_case: str, said: str
) -> None:
    native_in(tmp_path, "kg mm ms", told=False)
    case = tmp_path / "case.yaml"
    case.write_text(case.read_text("utf-8").replace("units: kg mm ms", f"units: {said_in_case}"), "utf-8")
    with pytest.raises(DataError, match=said):
        read(tmp_path, "case.yaml")


def test_a_wrong_unit_of_mass_does_not_close(tmp_path: Path) -> None:
    native_in(tmp_path, "kg mm ms", told=False)
    shutil.copy(BUMPER / "foam-curve.csv", tmp_path)
    case = tmp_path / "case.yaml"
    case.write_text(case.read_text("utf-8").replace("units: kg mm ms", "units: g mm ms"), "utf-8")
    assert extracted(tmp_path, "case.yaml").closed is False


def test_a_converted_history_in_another_hand_gives_the_same_numbers(tmp_path: Path) -> None:
    rows = list(
        csv.reader(io.StringIO(gzip.decompress((BUMPER / "time-history.csv.gz").read_bytes()).decode()))
    )
    rows = [row[: len(rows[0])] for row in rows if row]
    order = [0, *(1 + np.random.default_rng(3).permutation(len(rows[0]) - 1))]
    lines = [
        ",".join([*(row[k] for k in order), "further" if n == 0 else "1.0"]) for n, row in enumerate(rows)
    ]
    (tmp_path / "time-history.csv").write_text("\r\n".join(lines), "utf-8")
    shutil.copy(BUMPER / "case-converted.yaml", tmp_path)
    found = read(tmp_path, "case-converted.yaml")
    require_same(found, read(BUMPER, "case-converted.yaml"))
    assert any("columns that are not read" in note and "further" in note for note in found.notes)


def front(folder: Path) -> Path:
    for path in FRONT.iterdir():
        if path.name != "animation_1ms.csv.gz":
            shutil.copy(path, folder)
    text = (FRONT / "case.yaml").read_text("utf-8").replace("  node motion: animation_1ms.csv\n", "")
    (folder / "case.yaml").write_text(text, "utf-8")
    return folder


def test_one_of_a_fronts_files_that_is_cut_or_missing_is_named(tmp_path: Path) -> None:
    where = front(tmp_path)
    lines = gzip.decompress((FRONT / "ground_forces.csv.gz").read_bytes()).splitlines(keepends=True)
    (where / "ground_forces.csv.gz").unlink()
    (where / "ground_forces.csv").write_bytes(b"".join(lines[:-40]))
    with pytest.raises(
        DataError, match=r"ground_forces\.csv: its times differ from those of .*vehicle_groups"
    ):
        read(where, "case.yaml")
    (where / "ground_forces.csv").unlink()
    with pytest.raises(DataError, match=r"ground_forces\.csv: there is no such file"):
        read(where, "case.yaml")


def test_a_table_of_groups_with_decimal_commas_gives_the_same_faces(tmp_path: Path) -> None:
    where = front(tmp_path)
    text = (FRONT / "groups_table.csv").read_text("utf-8")
    (where / "groups_table.csv").unlink()
    (where / "groups_table.csv").write_text(text.replace(",", ";").replace(".", ","), "utf-8")
    section = load("case", where / "case.yaml").document.histories
    assert read_case_data(section, where).faces == read_case_data(section, FRONT).faces


def by_velocity_and_force(folder: Path) -> None:
    """Leave the momenta, the displacements of centres and the impulses out; write velocities in m/s."""
    rows = rows_of(folder)
    for name, mass in (("impactor", 6.0), ("fascia", 0.17556), ("foam", 0.096), ("back_beam", 3.91872)):
        k = rows[0].index(f"P_{name}_Ns")
        rows[0][k] = f"v_{name}_mps"
        for row in rows[1:]:
            row[k] = f"{float(row[k]) / mass:.12g}"
    put(folder, rows)
    case = (folder / "case-tidy.yaml").read_text("utf-8")
    case = re.sub(r"momentum: P_(\w+)_Ns, displacement: \w+", r"velocity: v_\1_mps", case)
    case = re.sub(r"impulse: \w+, ", "", case)
    (folder / "case-tidy.yaml").write_text(case, "utf-8")


def test_velocities_and_forces_do_as_well_as_momenta_and_impulses(folder: Path) -> None:
    by_velocity_and_force(folder)
    found, wanted = extracted(folder), extracted(BUMPER)
    for path, other in zip(found.paths, wanted.paths, strict=True):
        assert path.force == pytest.approx(other.force, abs=1e-4 * abs(other.peak_force))
    closure = next(p for p in found.paths if p.name == "fascia – beam").closures[0]
    assert closure.percent < 0.5
    assert any("momenta are masses times velocities: impactor" in note for note in found.notes)
    assert any("impulses are integrals of forces: impactor-fascia" in note for note in found.notes)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "mass: 6.0 kg, velocity",
            "velocity",
            "part `impactor` has no momentum; .* or `velocity` and a mass",
        ),
        (
            "velocity: v_impactor_mps",
            "velocity: v_impactor_mps, momentum: x_Ns",
            r"yaml:\d+:\d+: stands beside `momentum`",
        ),
        ("{force: F_foam_beam_kN}", "{}", r"yaml:\d+:\d+: a contact needs `impulse` or `force`"),
        (
            "velocity: v_fascia_mps",
            "velocity: x_fascia_front_mm",
            "`x_fascia_front_mm` should be a speed; .* _mps, _mmps",
        ),
    ],
)
def test_what_lacks_beside_a_velocity_is_told(folder: Path, old: str, new: str, said: str) -> None:
    by_velocity_and_force(folder)
    case = folder / "case-tidy.yaml"
    assert old in case.read_text("utf-8")
    case.write_text(case.read_text("utf-8").replace(old, new), "utf-8")
    with pytest.raises(InputError, match=said):
        extracted(folder)
