"""Damaged recordings as ISO-MME folders and CSV tables, graded by the pendulum procedure."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

import certkit
from certkit.exchange.channels_csv import csv_text
from certkit.exchange.codes import code_table
from certkit.exchange.mme_write import mme_files
from certkit.exchange.read import read_recording
from support.damaged_inputs.signal_damages import signal_damages
from support.damaged_inputs.text_damages import encoded, line_damages
from support.damaged_inputs.variant import Finding, Variant

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.documents.result import Result
    from certkit.reasons import Reason
    from certkit.signals import Recording

MEASURED = Path(__file__).parents[3] / "examples/measured"
EVERY = 2
"""Every which sample of the shipped test is kept: 5 kHz are plenty for CFC 180, and quick to read."""

PROCEDURE = "pendulum"


def shipped_recording() -> Recording:
    """Return the shipped measured test, thinned."""
    read = read_recording(MEASURED / "FLX-0007-pendulum.zip").recording
    channels = {name: replace(c, values=c.values[::EVERY]) for name, c in read.channels.items()}
    return replace(read, time=read.time[::EVERY], channels=channels)


def finding(result: Result) -> Finding:
    """Return what a result says: the graded values, and the codes of all that stands beside them."""
    told = {code for reason in (*result.coded_remarks, *result.coded_notes) for code in _codes(reason)}
    values = {c.id: c.value for c in result.criteria if c.graded}
    words = "; ".join(str(reason) for reason in result.coded_remarks)
    return Finding(
        result.verdict == "pass", values, frozenset(told - {"words"}), f"{result.verdict}: {words}"
    )


def _codes(reason: Reason) -> Iterator[str]:
    yield reason.code
    for value in reason.parameters.values():
        for item in value if isinstance(value, list) else ():
            if not isinstance(item, str):
                yield from _codes(item)


@dataclass(frozen=True)
class Files:
    """Text files by path, and the one that certkit is told to grade."""

    texts: dict[str, str]
    graded: str

    def grade(self, folder: Path) -> Finding:
        """Write them into a folder and grade."""
        for path, text in self.texts.items():
            target = folder / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(encoded(text))
        return finding(certkit.grade(PROCEDURE, folder / self.graded))

    def with_text(self, path: str, text: str) -> Files:
        """Return the files with another content of one."""
        return Files({**self.texts, path: text}, self.graded)


def mme(recording: Recording) -> Files:
    """Return a recording as an ISO-MME folder."""
    texts = mme_files(recording, "leg", {"Laboratory name": "Nowhere"}, code_table())
    return Files({f"leg/{path}": text for path, text in texts.items()}, "leg")


def table(recording: Recording) -> Files:
    """Return a recording as certkit's own CSV."""
    return Files({"leg.csv": csv_text(recording)}, "leg.csv")


def mme_variants(recording: Recording, chance: np.random.Generator, folder: Path) -> Iterator[Variant]:
    """Yield damaged ISO-MME folders."""
    files = mme(recording)
    intact = files.grade(folder)
    for damage in signal_damages(recording, chance):
        yield Variant("ISO-MME", damage.kind, damage.name, intact, mme(damage.recording).grade)
    channel, count = "leg/Channel/leg.004", len(recording.channels)  # T1
    head = (
        files.texts[channel]
        .split("\n")
        .index(next(x for x in files.texts[channel].split("\n") if ":" not in x))
    )
    for path, lines in (
        ("leg/leg.mme", range(files.texts["leg/leg.mme"].count("\n"))),
        ("leg/Channel/leg.chn", range(2 + count)),
        (channel, range(head)),
    ):
        for kind, words, text in line_damages(files.texts[path], lines):
            name = f"{Path(path).name} {words}"
            yield Variant("ISO-MME", kind, name, intact, files.with_text(path, text).grade)
    for kind, name, text in _sample_damages(files.texts[channel], head, chance):
        yield Variant("ISO-MME", kind, f"leg.004 {name}", intact, files.with_text(channel, text).grade)
    for words, path, old, new in _MME_CONFLICTS:
        text = re.sub(old, new, files.texts[path], count=1, flags=re.MULTILINE)
        assert text != files.texts[path], words
        yield Variant("ISO-MME", "conflicting words", words, intact, files.with_text(path, text).grade)


_CHANNEL, _LIST, _MASTER = "leg/Channel/leg.004", "leg/Channel/leg.chn", "leg/leg.mme"
_WORDS: tuple[tuple[str, str, str, str, str], ...] = (
    ("temperature in a comment", _MASTER, r"\Z", "Comments :temperature = {} degC\n", "18 19.5 22 35 -20"),
    ("filter class", _CHANNEL, r"class      :NOVALUE", "class      :{}", "60 CFC_180 600 180Hz CFC60 none"),
    ("status", _CHANNEL, r"(?<=^Data status                  :)ok", "{}", "bad NOT-OK failed void ?"),
    ("unit", _CHANNEL, r":Nm$", ":{}", "kNm N mm Nmm m furlong 1"),
    ("samples announced", _CHANNEL, r"(?<=samples            :)\d+", "{}", "0 1 499 501 10000000 -5"),
    ("channels announced", _LIST, r"(?<=channels           :)\d+", "{}", "0 1 10 12 1000000"),
    ("interval", _CHANNEL, r"(?<=interval            :)\S+", "{}", "0.4 4e-05 0.4s 0.4mm 0 -0.0004"),
    ("first sample", _CHANNEL, r"(?<=first sample         :)\S+", "{}", "0 -30 30ms 0.03"),
    ("amplitude class", _CHANNEL, r"(?<=amplitude class      :)NOVALUE", "{}", "100 0.1kNm 200Nm"),
)
_MME_CONFLICTS = tuple(
    (f"{what} {word}", path, old, new.format(word))
    for what, path, old, new, said in _WORDS
    for word in said.split()
)


def _sample_damages(text: str, head: int, chance: np.random.Generator) -> Iterator[tuple[str, str, str]]:
    rows = text.split("\n")
    for words in (
        "nan",
        "NOVALUE",
        "inf",
        "",
        "1e999",
        "0,5",
        "12.5 3",
        "--",
        "#REF!",
        "1_000",
        "０",
        "\x13",
        "1e400",
    ):
        at = int(chance.integers(head, len(rows) - 2))
        yield "NaN", f"{words!r} in line {at + 1}", "\n".join([*rows[:at], words, *rows[at + 1 :]])
    for count in (1, 5, 60):
        at = int(chance.integers(head, len(rows) - 2 - count))
        yield (
            "wrong counts",
            f"{count} samples lost at line {at + 1}",
            "\n".join([*rows[:at], *rows[at + count :]]),
        )
        yield (
            "wrong counts",
            f"{count} samples twice at line {at + 1}",
            "\n".join([*rows[: at + count], *rows[at:]]),
        )
    for part in chance.uniform(0.02, 0.99, 8):
        end = int(part * len(text))
        yield "truncated", f"ends at byte {end}", text[:end]


def csv_variants(recording: Recording, chance: np.random.Generator, folder: Path) -> Iterator[Variant]:
    """Yield damaged CSV tables."""
    files = table(recording)
    intact = files.grade(folder)
    for damage in signal_damages(recording, chance):
        yield Variant("CSV", damage.kind, damage.name, intact, table(damage.recording).grade)
    text = files.texts["leg.csv"]
    rows = text.split("\n")
    head = next(i for i, row in enumerate(rows) if not row.startswith("#"))
    for kind, words, changed in line_damages(text, range(head + 1)):
        yield Variant("CSV", kind, words, intact, files.with_text("leg.csv", changed).grade)
    for kind, name, changed in _table_damages(rows, head, chance):
        yield Variant("CSV", kind, name, intact, files.with_text("leg.csv", changed).grade)


def _table_damages(rows: list[str], head: int, chance: np.random.Generator) -> Iterator[tuple[str, str, str]]:
    text = "\n".join(rows)
    last = len(rows) - 2
    column = rows[head].split(",").index("T1 [N·m]")

    def cell(at: int, new: str) -> str:
        cells = rows[at].split(",")
        return "\n".join(
            [*rows[:at], ",".join([*cells[:column], new, *cells[column + 1 :]]), *rows[at + 1 :]]
        )

    for word in (
        "nan",
        "",
        "inf",
        "1e999",
        '"4,848"',
        "0,5",
        "--",
        "#REF!",
        "1_000",
        "4.848.000",
        "x",
        "０",
        "\x13",
    ):
        at = int(chance.integers(head + 1, last))
        yield "NaN", f"{word!r} in line {at + 1}", cell(at, word)
    for count in (1, 5, 60):
        at = int(chance.integers(head + 1, last - count))
        yield (
            "wrong counts",
            f"{count} rows lost at line {at + 1}",
            "\n".join([*rows[:at], *rows[at + count :]]),
        )
        yield (
            "wrong counts",
            f"{count} rows twice at line {at + 1}",
            "\n".join([*rows[: at + count], *rows[at:]]),
        )
    for part in chance.uniform(0.01, 0.99, 12):
        end = int(part * len(text))
        yield "truncated", f"ends at byte {end}", text[:end]
    for new in (
        "T1 [mm]",
        "T1 [kN·m]",
        "T1",
        "T1 []",
        "T2 [N·m]",
        "time [s]",
        "T1 [N·m",
        "t1 [N·m]",
        "",
        "T9 [N·m]",
    ):
        cells = rows[head].split(",")
        changed = ",".join([*cells[:column], new, *cells[column + 1 :]])
        yield "conflicting words", f"head {new!r}", "\n".join([*rows[:head], changed, *rows[head + 1 :]])
    for sign in (";", "\t", "|", " "):
        yield (
            "text field",
            f"delimiter {sign!r} in all rows",
            "\n".join(row.replace(",", sign) for row in rows),
        )
        yield (
            "text field",
            f"delimiter {sign!r} in the head",
            text.replace(rows[head], rows[head].replace(",", sign)),
        )
    shifted = [*rows[: head + 1], *("0," + row.rpartition(",")[0] for row in rows[head + 1 : -1]), ""]
    yield "swapped", "all columns one to the right", "\n".join(shifted)
    for by in (1, 6):
        moved = [",".join(np.roll(row.split(","), by).tolist()) for row in rows[head + 1 : -1]]
        yield "swapped", f"columns rolled by {by}", "\n".join([*rows[: head + 1], *moved, ""])
