"""Binouts of one run as MPP, SMP and restarts leave them: the same numbers, a remark, or one clear error."""

from __future__ import annotations

import importlib.util
from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.definitions.virtual_test import History
from certkit.errors import DataError
from certkit.exchange.fe.histories import parse_units
from certkit.exchange.fe.readers.ls_dyna_binout import read_binout
from certkit.exchange.fe.run_binout import BinoutRun
from tests.support.binout_writer import glstat, matsum, rcforc, write

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.exchange.fe import PartHistories

pytestmark = pytest.mark.skipif(importlib.util.find_spec("lasso") is None, reason="needs lasso-python")

TIME = np.round(np.arange(0.0, 40.0, 0.5), 3)
UNITS = parse_units("kg mm ms")


def whole(folder: Path) -> PartHistories:
    (folder / "whole").mkdir()
    tables = {"matsum": matsum(TIME, (1, 2, 3)), "rcforc": rcforc(TIME, (7, 8)), "glstat": glstat(TIME)}
    return read_binout(write(folder / "whole/binout0000", **tables), UNITS, {})


def require_same(found: PartHistories, wanted: PartHistories) -> None:
    assert np.array_equal(found.time, wanted.time)
    assert found.parts.keys() == wanted.parts.keys()
    for name, part in wanted.parts.items():
        assert np.array_equal(found.parts[name].momentum, part.momentum), name
        assert found.parts[name].mass == part.mass
    assert found.contacts.keys() == wanted.contacts.keys()
    for name, contact in wanted.contacts.items():
        assert np.array_equal(found.contacts[name].impulse, contact.impulse)


def numbered(folder: Path, *files: dict, numbers: tuple[int, ...] = ()) -> list[Path]:
    numbers = numbers or tuple(range(len(files)))
    return [write(folder / f"binout{k:04d}", **tables) for k, tables in zip(numbers, files, strict=True)]


def test_tables_and_objects_that_processors_wrote_apart_are_put_together(tmp_path: Path) -> None:
    files = numbered(
        tmp_path,
        {"matsum": matsum(TIME, (1, 3)), "glstat": glstat(TIME)},
        {"matsum": matsum(TIME, (2,)), "rcforc": rcforc(TIME, (8,))},
        {"rcforc": rcforc(TIME, (7,))},
    )
    found = read_binout(files, UNITS, {})
    require_same(found, whole(tmp_path))
    assert not any("among the files" in note for note in found.notes)


@pytest.mark.parametrize(
    ("units", "mass", "length", "time"), [("t mm s", 1e-3, 1.0, 1e-3), ("kg m s", 1.0, 1e-3, 1e-3)]
)
def test_a_run_in_other_units_gives_the_same_numbers(
    tmp_path: Path, units: str, mass: float, length: float, time: float
) -> None:
    found = {}
    for name, factors in (("kg mm ms", (1.0, 1.0, 1.0)), (units, (mass, length, time))):
        m, x, t = factors
        parts, contacts = matsum(TIME, (1, 2)), rcforc(TIME, (7,))
        for table in (parts, contacts):
            table["time"] = t * table["time"]
        parts["mass"] = m * parts["mass"]
        parts["x_rbvelocity"] = x / t * parts["x_rbvelocity"]
        parts["x_momentum"] = m * x / t * parts["x_momentum"]
        contacts["x_force"] = m * x / t**2 * contacts["x_force"]
        path = write(tmp_path / f"binout{len(found):04d}", matsum=parts, rcforc=contacts)
        found[name] = read_binout(path, parse_units(name), {})
    assert found[units].time == pytest.approx(found["kg mm ms"].time)
    for name, part in found["kg mm ms"].parts.items():
        other = found[units].parts[name]
        assert other.mass == pytest.approx(part.mass)
        assert other.momentum == pytest.approx(part.momentum)
        assert other.displacement == pytest.approx(part.displacement)
    wanted = found["kg mm ms"].contact("contact 7").impulse
    assert found[units].contact("contact 7").impulse == pytest.approx(wanted)


def test_tables_one_level_down_are_found_and_joined(tmp_path: Path) -> None:
    inner = [{"matsum": matsum(TIME, (1,)), "rwforc/forces": rcforc(TIME, (number,))} for number in (4, 5)]
    inner[1].pop("matsum")
    run = BinoutRun(numbered(tmp_path, *inner), UNITS)
    wall = History(table="rwforc/forces", of="contact 5", variable="x_force")
    assert np.array_equal(run.history(wall, "force").values, np.full(TIME.size, 5000.0))
    with pytest.raises(DataError, match=r"no table `rwforc`; there are matsum, rwforc/forces"):
        run.history(History(table="rwforc", of="contact 5", variable="x_force"), "force")
    run.close()


def test_a_file_that_goes_on_in_others_is_one(tmp_path: Path) -> None:
    tables = {"matsum": matsum(TIME, (1, 2, 3)), "rcforc": rcforc(TIME, (7, 8)), "glstat": glstat(TIME)}
    path = write(tmp_path / "binout0000", split=20.0, **tables)
    assert (tmp_path / "binout0000%001").exists()
    found = read_binout(path, UNITS, {})
    require_same(found, whole(tmp_path))
    assert len(found.files) == 2


def test_a_number_that_is_missing_is_remarked(tmp_path: Path) -> None:
    files = [{"matsum": matsum(TIME, (1, 2, 3))}, {"rcforc": rcforc(TIME, (7, 8)), "glstat": glstat(TIME)}]
    found = read_binout(numbered(tmp_path, *files, numbers=(0, 2)), UNITS, {})
    require_same(found, whole(tmp_path))
    assert any(note.startswith("binout0001 is not among the files") for note in found.notes)


def test_a_continuation_that_is_missing_is_an_error(tmp_path: Path) -> None:
    path = write(tmp_path / "binout0000", split=20.0, matsum=matsum(TIME, (1, 2)))
    (tmp_path / "binout0000%001").rename(tmp_path / "binout0000%002")
    with pytest.raises(
        DataError, match=r"its continuation binout0000%001 is missing, binout0000%002 is there"
    ):
        read_binout(path, UNITS, {})


def test_a_time_that_no_file_tells_is_an_error(tmp_path: Path) -> None:
    first, last = TIME[TIME < 12], TIME[TIME >= 25]
    files = numbered(
        tmp_path, {"matsum": matsum(first, (1,))}, {"matsum": matsum(last, (1,))}, numbers=(0, 2)
    )
    with pytest.raises(
        DataError, match=r"matsum: between binout0000 \(0 to 11.5\) and binout0002 .* is missing"
    ):
        read_binout(files, UNITS, {})


def test_of_a_restart_that_overlaps_the_later_counts_and_it_is_remarked(tmp_path: Path) -> None:
    early, late = TIME[TIME <= 25], TIME[TIME >= 20]
    files = []
    for number, time in enumerate((early, late)):
        tables = {"matsum": matsum(time, (1, 2, 3)), "rcforc": rcforc(time, (7, 8)), "glstat": glstat(time)}
        if number == 0:  # what it wrote beyond the restart's state was given up
            tables["rcforc"]["x_force"] = tables["rcforc"]["x_force"] + 0.2 * (time > 24)[:, None]
        files.append(write(tmp_path / f"binout{number:04d}", **tables))
    found = read_binout(files, UNITS, {})
    require_same(found, whole(tmp_path))
    assert any("overlap and differ by up to 2.4 %" in note for note in found.notes)
    run = BinoutRun(files, UNITS)
    force = run.history(History(table="rcforc", of="contact 8", variable="x_force"), "force")
    assert np.array_equal(force.values, np.full(TIME.size, 8000.0))
    assert any("overlap" in remark for remark in run.remarks)
    run.close()


def test_files_of_two_runs_are_refused(tmp_path: Path) -> None:
    other = matsum(TIME[TIME >= 20], (1, 2))
    other["x_momentum"] = 1.5 * other["x_momentum"]
    files = numbered(tmp_path, {"matsum": matsum(TIME[TIME <= 25], (1, 2))}, {"matsum": other})
    with pytest.raises(
        DataError, match=r"overlap and differ by .* % of the largest value; name files of one run"
    ):
        read_binout(files, UNITS, {})


def test_a_file_inside_anothers_time_is_refused(tmp_path: Path) -> None:
    inner = TIME[(TIME > 10) & (TIME < 20)]
    files = numbered(tmp_path, {"matsum": matsum(TIME, (1, 2))}, {"matsum": matsum(inner, (1, 2))})
    with pytest.raises(DataError, match=r"binout0001 \(10.5 to 19.5\) lies inside binout0000"):
        read_binout(files, UNITS, {})


def test_an_object_that_a_restart_no_longer_has_is_named(tmp_path: Path) -> None:
    early, late = TIME[TIME < 20], TIME[TIME >= 20]
    files = numbered(tmp_path, {"matsum": matsum(early, (1, 2, 3))}, {"matsum": matsum(late, (1, 2))})
    with pytest.raises(DataError, match=r"matsum: object 3 has other instants \(0 to 19.5 in binout0000\)"):
        read_binout(files, UNITS, {})


def test_a_restart_that_lists_its_objects_in_another_order_goes_on(tmp_path: Path) -> None:
    early, late = TIME[TIME < 20], TIME[TIME >= 20]
    files = []
    for number, (time, ids) in enumerate(((early, (1, 2, 3)), (late, (3, 1, 2)))):
        tables = {"matsum": matsum(time, ids), "rcforc": rcforc(time, (7, 8)), "glstat": glstat(time)}
        files.append(write(tmp_path / f"binout{number:04d}", **tables))
    require_same(read_binout(files[::-1], UNITS, {}), whole(tmp_path))


def test_a_restart_in_a_continuation_is_told_with_what_to_do(tmp_path: Path) -> None:
    path = write(tmp_path / "binout0000", matsum=matsum(TIME[TIME <= 25], (1, 2)))
    write(tmp_path / "binout0000%001", matsum=matsum(TIME[TIME >= 20], (1, 2)))
    with pytest.raises(DataError, match=r"binout0000%001: matsum begins at 20, before binout0000 ends at 25"):
        read_binout(path, UNITS, {})


def test_a_variable_that_one_file_lacks_is_named_with_the_file(tmp_path: Path) -> None:
    late = matsum(TIME[TIME >= 20], (1, 2))
    del late["x_momentum"]
    files = numbered(tmp_path, {"matsum": matsum(TIME[TIME < 20], (1, 2))}, {"matsum": late})
    with pytest.raises(DataError, match="matsum has no `x_momentum` in binout0001"):
        read_binout(files, UNITS, {})
