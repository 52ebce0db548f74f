"""Damaged YAML: a mapping, a laboratory's file, a procedure, corridors; with intact data beside them."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import certkit
from certkit.exchange.mme_write import write_mme
from support.damaged_inputs.measured_files import MEASURED, PROCEDURE, finding
from support.damaged_inputs.text_damages import encoded, line_damages
from support.damaged_inputs.variant import Finding, Variant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from certkit.signals import Recording

ROOT = Path(__file__).parents[3]


def yaml_variants(recording: Recording, folder: Path) -> Iterator[Variant]:
    """Yield damaged definitions, each with what grades by it."""
    data = folder / "data"
    write_mme(recording, data, test="leg")
    sheet = _thinned((MEASURED / "FLX-0007-pendulum.csv").read_bytes())
    corridors = next(path for path in (ROOT / "corridors").glob("*.yaml") if "pendulum" in path.read_text())
    for name, text, grade in (
        ("mapping.yaml", (MEASURED / "mapping.yaml").read_text(encoding="utf-8"), _by_mapping(sheet)),
        ("lab.yaml", (MEASURED / "lab.yaml").read_text(encoding="utf-8"), _with_laboratory(data)),
        (
            "pendulum.yaml",
            (ROOT / "procedures/pendulum.yaml").read_text(encoding="utf-8"),
            _in_library(data, "procedures"),
        ),
        (corridors.name, corridors.read_text(encoding="utf-8"), _in_library(data, "corridors")),
    ):
        place = folder / f"intact {name}"
        place.mkdir()
        intact = grade(place, name, text)
        rows = text.split("\n")
        lines = [index for index, row in enumerate(rows) if row.strip() and not row.lstrip().startswith("#")]
        for kind, words, changed in line_damages(text, iter(lines)):
            yield Variant("YAML", kind, f"{name} {words}", intact, _attempt(grade, name, changed))
        for kind, words, changed in _of_yaml(text):
            yield Variant("YAML", kind, f"{name} {words}", intact, _attempt(grade, name, changed))


def _attempt(grade: Callable[[Path, str, str], Finding], name: str, text: str) -> Callable[[Path], Finding]:
    return lambda folder: grade(folder, name, text)


def _thinned(table: bytes) -> bytes:
    rows = table.split(b"\n")
    return b"\n".join([*rows[:3], *rows[3::4], b""])


def _by_mapping(sheet: bytes) -> Callable[[Path, str, str], Finding]:
    def grade(folder: Path, name: str, text: str) -> Finding:
        (folder / "leg.csv").write_bytes(sheet)
        (folder / name).write_bytes(encoded(text))
        return finding(certkit.grade(PROCEDURE, folder / "leg.csv", mapping=folder / name))

    return grade


def _with_laboratory(data: Path) -> Callable[[Path, str, str], Finding]:
    def grade(folder: Path, name: str, text: str) -> Finding:
        (folder / name).write_bytes(encoded(text))
        return finding(certkit.grade(PROCEDURE, data, laboratory=folder / name))

    return grade


def _in_library(data: Path, kind: str) -> Callable[[Path, str, str], Finding]:
    def grade(folder: Path, name: str, text: str) -> Finding:
        (folder / kind).mkdir()
        (folder / kind / name).write_bytes(encoded(text))
        found = finding(certkit.grade(PROCEDURE, data, library=folder))
        shutil.rmtree(folder / kind)
        return found

    return grade


def _of_yaml(text: str) -> Iterator[tuple[str, str, str]]:
    """Yield damages that only YAML knows."""
    yield "text field", "a tab before the first key", f"\t{text}"
    yield "text field", "an alias to itself", f"{text}\nself: &a [*a]\n"
    yield "text field", "a tag", f"{text}\nmore: !!python/object/apply:os.getcwd []\n"
    yield "text field", "a merge key", f"{text}\n<<: {{a: 1}}\n"
    yield "text field", "two documents", f"{text}\n---\n{text}"
    yield "text field", "a list instead", f"- {text.splitlines()[0]}\n"
    yield "text field", "brackets without end", text + "\nx: " + "[" * 5_000
    yield "text field", "nothing", ""
    yield "text field", "null", "null\n"
