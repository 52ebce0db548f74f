"""Damaged finite-element histories: OpenRadioss' native file and its conversion, and a binout, extracted."""

from __future__ import annotations

import gzip
import importlib.util
import struct
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import certkit
from support.damaged_inputs.variant import Finding, Variant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

BUMPER = Path(__file__).parents[3] / "examples/extract/bumper-reference"


def _extracted(case: str, name: str, content: bytes) -> Callable[[Path], Finding]:
    """Return an attempt that puts one damaged history beside the intact case and extracts."""

    def attempt(folder: Path) -> Finding:
        for path in (BUMPER / case, BUMPER / "foam-curve.csv"):
            (folder / path.name).write_bytes(path.read_bytes())
        (folder / name).write_bytes(content)
        found = certkit.extract(folder / case)
        values: dict[str, float | None] = {}
        for path in found.paths:
            values[f"force {path.name}"] = path.peak_force
            values[f"impulse {path.name}"] = max(map(abs, path.impulse))
        values |= {f"mass {group.name}": group.mass for group in found.groups}
        told = frozenset({*found.warnings, *found.notes, *_unclosed(found)})
        return Finding(passed=True, values=values, told=told, said="; ".join(found.warnings))

    return attempt


def _unclosed(found: certkit.ExtractionResult) -> Iterator[str]:
    """Name what the extraction says does not close."""
    for path in found.paths:
        for closure in path.closures:
            if closure.percent > 2.0:
                yield f"does not close: {path.name}"


def native_variants(chance: np.random.Generator, count: int, folder: Path) -> Iterator[Variant]:
    """Yield damaged native histories (T01)."""
    content = gzip.decompress((BUMPER / "time-history.T01.gz").read_bytes())
    intact = _extracted("case.yaml", "time-history.T01", content)(_made(folder / "T01"))

    def variant(kind: str, name: str, changed: bytes) -> Variant:
        return Variant("T01", kind, name, intact, _extracted("case.yaml", "time-history.T01", changed))

    for _ in range(count):
        at = int(chance.integers(0, len(content) - 8))
        yield variant("truncated", f"ends at byte {at}", content[:at])
        yield variant("dropped", f"4 bytes lost at {at}", content[:at] + content[at + 4 :])
        at -= at % 4
        for words, number in (("NaN", float("nan")), ("infinite", float("inf"))):
            changed = content[:at] + struct.pack(">f", number) + content[at + 4 :]
            yield variant("NaN", f"{words} at byte {at}", changed)
        near = int(chance.integers(0, 4_000))
        flipped = bytearray(content)
        flipped[near] ^= 1 << int(chance.integers(0, 8))
        yield variant("text field", f"a bit of byte {near} of the directory", bytes(flipped))
    for old, new in (
        (b"fascia  ", b"foam    "),
        (b"back_beam", b"fascia   "),
        (b"impactor", b"foam    "),
        (b"fascia-foam", b"foam-beam  "),
        (b"fascia-foam", b"\x13scia-foam"),
    ):
        yield variant(
            "conflicting words", f"{old.strip()!r} is called {new.strip()!r}", content.replace(old, new, 1)
        )
    for code in (0, 2999, 3041, 3050, 4021, 9999):
        yield variant(
            "conflicting words", f"format code {code}", content[:4] + struct.pack(">i", code) + content[8:]
        )


def converted_variants(chance: np.random.Generator, count: int, folder: Path) -> Iterator[Variant]:
    """Yield damaged conversions (CSV)."""
    text = gzip.decompress((BUMPER / "time-history.csv.gz").read_bytes()).decode()
    name = "time-history.csv"
    intact = _extracted("case-converted.yaml", name, text.encode())(_made(folder / "converted"))

    def variant(kind: str, words: str, changed: str) -> Variant:
        content = changed.encode("utf-8", "surrogateescape")
        return Variant("converted CSV", kind, words, intact, _extracted("case-converted.yaml", name, content))

    rows = [row.split(",") for row in text.split("\n") if row.strip()]
    heads = [" ".join(head.strip('"').split()) for head in rows[0]]
    for _ in range(count):
        at = int(chance.integers(0, len(text)))
        yield variant("truncated", f"ends at byte {at}", text[:at])
        row, column = int(chance.integers(1, len(rows))), int(chance.integers(0, len(heads) - 1))
        for cell in ("nan", "", "x", "1e999", "1,5"):
            changed = [r.copy() for r in rows]
            changed[row][column] = cell
            yield variant("NaN", f"{cell!r} in row {row}, {heads[column]}", _joined(changed))
        yield variant("wrong counts", f"row {row} lost", _joined([*rows[:row], *rows[row + 1 :]]))
        yield variant("wrong counts", f"row {row} twice", _joined([*rows[:row], rows[row], *rows[row:]]))
    used = (
        "fascia XMOM",
        "fascia MASS",
        "nodes 4 impactor_main VX",
        "fascia-foam FNX",
        "fascia_front_centre DX",
    )
    for head in used:
        column = next(
            (
                i
                for i, word in enumerate(heads)
                if word.endswith(head.split(" ", 2)[-1] if "nodes" in head else head)
            ),
            None,
        )
        if column is None:
            continue
        for kind, words, change in (
            ("dropped", "zero", np.zeros_like),
            ("frozen", "frozen", lambda v: np.where(np.arange(v.size) < v.size // 8, v, v[v.size // 8])),
            ("inverted", "inverted", lambda v: -v),
            ("scaled", "times 10", lambda v: 10 * v),
            ("scaled", "times 0.001", lambda v: 1e-3 * v),
        ):
            numbers = np.array([float(r[column]) for r in rows[1:]])
            changed = [r.copy() for r in rows]
            for cells, number in zip(changed[1:], change(numbers), strict=True):
                cells[column] = f"{number:.9g}"
            yield variant(kind, f"{heads[column]} {words}", _joined(changed))
    for by in (1, 6):
        for begin in range(1, len(heads) - 10, max(len(heads) // max(count, 1), 1)):
            moved = [
                rows[0],
                *([*r[:begin], *["0"] * by, *r[begin : len(r) - by - 1], *r[-1:]] for r in rows[1:]),
            ]
            yield variant("shifted", f"by {by} columns from {heads[begin]} on", _joined(moved))


def binout_variants(chance: np.random.Generator, count: int, folder: Path) -> Iterator[Variant]:
    """Yield damaged binouts; none without lasso-python."""
    if importlib.util.find_spec("lasso") is None:
        return
    content = (BUMPER / "bumper.binout0000").read_bytes()
    name = "bumper.binout0000"
    intact = _extracted("case-binout.yaml", name, content)(_made(folder / "binout"))
    for _ in range(count):
        at = int(chance.integers(0, len(content)))
        for kind, words, changed in (
            ("truncated", f"ends at byte {at}", content[:at]),
            ("dropped", f"16 bytes lost at {at}", content[:at] + content[at + 16 :]),
            ("dropped", f"64 zeros at byte {at}", content[:at] + bytes(64) + content[at + 64 :]),
        ):
            attempt = _extracted("case-binout.yaml", name, changed)
            yield Variant("binout", kind, words, intact, attempt)


def _made(folder: Path) -> Path:
    folder.mkdir(parents=True)
    return folder


def _joined(rows: list[list[str]]) -> str:
    return "\n".join(",".join(row) for row in rows) + "\n"
