# ruff: noqa: E501  # a table reads best with one line a case
"""Damaged case, history and vehicle files: one clear error each, with the place; nothing is written."""

from __future__ import annotations

import gzip
import shutil
import struct
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from certkit.definitions.loading.library import load
from certkit.errors import DataError, DefinitionError, InputError
from certkit.exchange.fe import data_folder
from certkit.identification.five_steps import extract

if TYPE_CHECKING:
    from collections.abc import Callable

CASES = Path(__file__).parents[3] / "examples/extract"

Damage = tuple["Callable[[Path], None]", str]


def _text(name: str, old: str, new: str, *, once: bool = True) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        path = folder / name
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new, 1 if once else -1))

    return damage


def _line(name: str, number: int, change: Callable[[list[str]], str]) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        path = folder / name
        lines = path.read_text().splitlines()
        lines[number - 1] = change(lines[number - 1].split(","))
        path.write_text("\n".join(lines) + "\n")

    return damage


def _native(change: Callable[[bytes], bytes]) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        packed = folder / "time-history.T01.gz"
        content = gzip.decompress(packed.read_bytes())
        (folder / "time-history.T01").write_bytes(change(content))

    return damage


def _cell(index: int, value: str) -> Callable[[list[str]], str]:
    return lambda cells: ",".join([*cells[:index], value, *cells[index + 1 :]])


TIDY: dict[str, Damage] = {
    "a word where a number belongs": (_line("histories.csv", 40, _cell(3, "abc")), r"\.csv:40: column `P_foam_Ns`: `abc`"),
    "an empty cell": (_line("histories.csv", 7, _cell(1, "")), r"\.csv:7: column `P_impactor_Ns`: an empty cell"),
    "a number that is not finite": (_line("histories.csv", 9, _cell(2, "nan")), "`P_fascia_Ns` is not a finite number in row 8"),
    "a row cut short": (_line("histories.csv", 90, lambda c: ",".join(c[:5])), r"\.csv:90: 5 cells"),
    "a column twice": (_text("histories.csv", "P_foam_Ns", "P_fascia_Ns"), "`P_fascia_Ns` stands there twice"),
    "time going back": (_line("histories.csv", 60, _cell(0, "0.5")), "time does not increase at row 59"),
    "a missing column": (_text("histories.csv", "P_fascia_Ns", "P_skin_Ns"), "no column `P_fascia_Ns`"),
    "a unit in a name that does not fit": (
        _text("case-tidy.yaml", "momentum: P_fascia_Ns", "momentum: x_fascia_front_mm"),
        "should be a momentum",
    ),
    "a missing file": (lambda f: (f / "histories.csv").unlink(), "there is no such file"),
    "a file that is empty": (lambda f: (f / "histories.csv").write_text(""), "the file is empty"),
    "a binary file": (lambda f: (f / "histories.csv").write_bytes(b"\xff\xfe\x00\x81" * 50), "not a text file"),
    "a path out of the folder": (
        _text("case-tidy.yaml", "files: [histories.csv]", "files: [../histories.csv]"),
        "leads out of the case's folder",
    ),
    "a folder elsewhere": (
        _text("case-tidy.yaml", "  files: [histories.csv]", "  folder: ../elsewhere\n  files: [histories.csv]"),
        "leads out of the case's folder",
    ),
    "a group that is not there": (
        _text("case-tidy.yaml", "between: [fascia, beam], contact", "between: [fascia, bream], contact"),
        "there is no group `bream`",
    ),
    "a part that is not there": (_text("case-tidy.yaml", "parts: [back_beam]", "parts: [back_bean]"), "no part `back_bean`; did you mean `back_beam`"),
    "a part in two groups": (_text("case-tidy.yaml", "parts: [back_beam]", "parts: [fascia]"), "is in the groups"),
    "a contact that is not there": (_text("case-tidy.yaml", "contact: fascia-foam", "contact: skin-foam"), "no contact `skin-foam`"),
    "a group nobody reaches": (
        _text("case-tidy.yaml", "  - {between: [impactor, fascia], contact: impactor-fascia, law: false}\n", ""),
        "no path reaches group `impactor`",
    ),
    "no material curve": (lambda f: (f / "foam-curve.csv").unlink(), "foam-curve.csv: there is no such file"),
    "an area that is none": (_text("case-tidy.yaml", "40000 mm²", "40000 mm"), "is no area"),
    "a mass without unit": (_text("case-tidy.yaml", "mass: 0.17556 kg", "mass: 0.17556"), "has no unit"),
    "a misspelt key": (_text("case-tidy.yaml", "strain from:", "strain form:"), "did you mean|unknown"),
    "a format nobody reads": (_text("case-tidy.yaml", "format: tidy csv", "format: excel"), "excel|tidy csv"),
}  # fmt: skip

NATIVE: dict[str, Damage] = {
    "a file cut in a record": (_native(lambda b: b[:200_001]), "the file ends inside the record"),
    "a file without instants": (_native(lambda b: b[: b.index(struct.pack(">3i", 4, 0, 4))]), "no instants"),
    "an unknown format code": (_native(lambda b: b[:4] + struct.pack(">i", 9999) + b[8:]), "format code 9999"),
    "a text file": (_native(lambda _: b"time,x\n" * 100), "no record|ends inside|two different lengths"),
    "a broken record length": (_native(lambda b: b[:88] + struct.pack(">i", 81) + b[92:]), "two different lengths|ends inside"),
    "a damaged archive": (
        lambda f: (f / "time-history.T01.gz").write_bytes((f / "time-history.T01.gz").read_bytes()[:5000]),
        "damaged gzip",
    ),
    "a rigid body nobody describes": (
        _text("case.yaml", "    impactor: {mass: 6.0 kg, node: impactor_main}", "    foam: {mass: 6.0 kg, node: impactor_main}"),
        "has no momentum; if it is a rigid body",
    ),
    "a main node that is not there": (_text("case.yaml", "node: impactor_main", "node: impactor_mian"), "no node `impactor_mian`"),
    "unknown units": (_text("case.yaml", "units: kg mm ms", "units: kg inch ms"), "units `kg inch ms`"),
}  # fmt: skip


def _extract(folder: Path, case: str) -> None:
    document = load("case", folder / case).document
    extract(document, data_folder(document.histories, folder))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for path in sorted((CASES / "bumper-reference").iterdir()):
        if path.name != "bumper.binout0000":
            shutil.copy(path, tmp_path / path.name)
    return tmp_path


@pytest.mark.parametrize("damage", TIDY)
def test_a_damaged_tidy_case_is_refused_with_its_place(folder: Path, damage: str) -> None:
    change, message = TIDY[damage]
    change(folder)
    with pytest.raises(InputError, match=message):
        _extract(folder, "case-tidy.yaml")


@pytest.mark.parametrize("damage", NATIVE)
def test_a_damaged_native_file_is_refused_with_its_place(folder: Path, damage: str) -> None:
    change, message = NATIVE[damage]
    change(folder)
    with pytest.raises(InputError, match=message):
        _extract(folder, "case.yaml")


def test_a_definition_error_names_line_and_column(folder: Path) -> None:
    _text("case-tidy.yaml", "strain from:", "strain form:")(folder)
    with pytest.raises(DefinitionError, match=r"case-tidy.yaml:\d+:\d+: "):
        _extract(folder, "case-tidy.yaml")


def test_a_damaged_outline_is_refused_with_its_name(tmp_path: Path) -> None:
    from certkit.exchange.fe import read_faces  # noqa: PLC0415  # only here

    shutil.copy(CASES / "front1/groups_table.csv", tmp_path)
    (tmp_path / "params.json").write_text('{"fascia_poly_x_z": [[70, 200], [35, 190]]}')
    with pytest.raises(DataError, match="`fascia_poly_x_z` must be points"):
        read_faces(tmp_path / "groups_table.csv", tmp_path / "params.json")
    (tmp_path / "params.json").write_text("[1, 2")
    with pytest.raises(DataError, match="no JSON object"):
        read_faces(tmp_path / "groups_table.csv", tmp_path / "params.json")
