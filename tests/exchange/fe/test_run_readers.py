"""Histories of a finite-element run by the solver's names: units, impulses, distances, and what is wrong."""

from __future__ import annotations

import gzip
import shutil
from pathlib import Path

import numpy as np
import pytest

from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.loading.validation import read_document
from certkit.errors import DataError
from certkit.exchange.fe.run_objects import NodePath, growth_of_distance
from certkit.exchange.fe.run_radioss import rate_of
from certkit.exchange.read import read_recording
from tests.support.radioss_writer import Group, History, written

RUNS = Path(__file__).parents[3] / "examples" / "finite-elements"


def read(folder: Path, text: str):
    path = folder / "mapping.yaml"
    path.write_text(text, "utf-8")
    return read_recording(folder, read_document(path, Mapping)).recording


@pytest.fixture
def radioss(tmp_path: Path) -> tuple[Path, str]:
    for file in (RUNS / "openradioss").iterdir():
        shutil.copy(file, tmp_path)
    return tmp_path, (RUNS / "mapping-openradioss.yaml").read_text("utf-8")


def test_the_distance_of_two_nodes_grows_by_what_they_move_apart():
    along = np.linspace(0.0, 3.0, 7)
    moved = np.stack([along, 0 * along, 0 * along], axis=1)
    start = np.array([0.0, 4.0, 0.0])
    grown = growth_of_distance(NodePath(along, np.zeros(3), 0 * moved), NodePath(along, start, moved))
    assert grown.values == pytest.approx(np.hypot(4.0, along) - 4.0)


def test_an_impulse_becomes_the_force_that_it_is_of():
    time = np.array([0.0, 1.0, 2.5, 3.0, 4.5, 5.0])
    assert rate_of(7.0 * time, time) == pytest.approx(np.full(6, 7.0))


def test_an_objects_id_does_as_well_as_its_title(radioss: tuple[Path, str]):
    folder, text = radioss
    first = read(folder, text)
    again = read(folder, text.replace("of: gauge T1,", 'of: "4",'))
    assert again["T1"].values == pytest.approx(first["T1"].values)


def test_the_mean_of_two_objects_lies_between_them(radioss: tuple[Path, str]):
    folder, text = radioss
    first = read(folder, text)
    mean = read(folder, text.replace("of: gauge T1,", "of: [gauge T1, gauge T2], combine: mean,"))
    assert mean["T1"].values == pytest.approx(
        0.5 * (first["T1"].values + first["T2"].values), rel=1e-5, abs=1e-5
    )


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("of: gauge T1,", "of: gauge T9,", r"no beam `gauge T9`; did you mean"),
        ("variable: M2", "variable: M5", r"beam `gauge F1`: no variable `M5`; there are M2"),
        ("table: beam", "table: secforc", r"no kind of group `secforc`; there are node"),
        (
            "table: beam, of: gauge F1, variable: M2",
            "between: [knee, hip]",
            r"node `knee`: no variable `DX`",
        ),
    ],
)
def test_a_history_that_is_not_there_is_named_with_what_there_is(
    radioss: tuple[Path, str], old: str, new: str, said: str
):
    folder, text = radioss
    with pytest.raises(DataError, match=said):
        read(folder, text.replace(old, new, 1))


def test_damaged_files_are_one_error_each(radioss: tuple[Path, str]):
    folder, text = radioss
    titles = folder / "legT01_TITLES"
    whole = titles.read_text("ascii")
    titles.write_text(whole[:-22], "ascii")
    with pytest.raises(DataError, match="names 12 variables, the history has 13"):
        read(folder, text)
    titles.write_text(whole, "ascii")
    content = gzip.decompress((folder / "legT01.gz").read_bytes())
    (folder / "legT01.gz").write_bytes(gzip.compress(content[:-30]))
    with pytest.raises(DataError, match="it was cut"):
        read(folder, text)
    (folder / "legT01.gz").unlink()
    with pytest.raises(DataError, match=r"usual files \(\*T01, \*T01\.gz\) is in this folder"):
        read(folder, text)


def test_conditions_that_contradict_the_run_are_refused(radioss: tuple[Path, str]):
    folder, text = radioss
    with pytest.raises(DataError, match=r"hourglass energy is 0\.02 here and 0 in"):
        read(folder, text + "  hourglass energy: 2 %\n")


def test_units_that_a_run_leaves_open_are_noted_in_the_recording(tmp_path: Path):
    time = np.linspace(0.0, 20.0, 81)
    push = np.cumsum(np.where(time > 5.0, np.sin(time - 5.0) ** 2, 0.0))
    run = History(time, {}, [Group(101, {1: "leg to front"}, {1: [push]})])
    (tmp_path / "legT01").write_bytes(written(run, 4021, factors=(1.0, 1.0, 1.0)))
    told = read(
        tmp_path,
        "mapping: made up\nsource: made up\nfinite elements:\n  legform model: {name: made up}\n"
        "  channels: {contact force: {table: contact, of: leg to front, variable: FNX}}\n",
    )
    said = [str(note.parameters["said"]) for note in told.notes if note.code == "run-files-remark"]
    assert len(said) == 1
    assert "unit factors are all 1" in said[0]
