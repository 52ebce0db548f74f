"""Ways to spoil a test's files, each with the words that the one-line error must have."""

from __future__ import annotations

import io
import re
import zipfile
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

CHANNEL = "Channel/leg.001"  # T1
LIST = "Channel/leg.chn"


@dataclass(frozen=True)
class Damage:
    """What is done to the files, what the error says, and on which kind of container it is done.

    `do` gets the folder (or the CSV file) and returns what is then read.
    """

    name: str
    container: str
    do: Callable[[Path], Path]
    says: str


def _edit(file: str, pattern: str, replacement: str, count: int = 1) -> Callable[[Path], Path]:
    def do(root: Path) -> Path:
        path = root / file if file else root
        text = path.read_text(encoding="utf-8")
        changed = re.sub(pattern, lambda _: replacement, text, count=count, flags=re.MULTILINE)
        assert changed != text
        path.write_text(changed, encoding="utf-8")
        return root

    return do


def _lines(file: str, change: Callable[[list[str]], list[str]]) -> Callable[[Path], Path]:
    def do(root: Path) -> Path:
        path = root / file if file else root
        lines = path.read_text(encoding="utf-8").split("\n")
        path.write_text("\n".join(change(lines)), encoding="utf-8")
        return root

    return do


def _bytes(file: str, change: Callable[[bytes], bytes]) -> Callable[[Path], Path]:
    def do(root: Path) -> Path:
        path = root / file if file else root
        path.write_bytes(change(path.read_bytes()))
        return root

    return do


def _clip(root: Path) -> Path:
    path = root / CHANNEL
    head, samples = path.read_text().split("Data status                  :ok\n")
    clipped = "\n".join(str(min(float(x), 200.0)) for x in samples.split())
    head = head.replace("amplitude class      :NOVALUE", "amplitude class      :200")
    path.write_text(f"{head}Data status                  :ok\n{clipped}\n")
    return root


def _remove(file: str) -> Callable[[Path], Path]:
    def do(root: Path) -> Path:
        (root / file).unlink()
        return root

    return do


def _link(root: Path) -> Path:
    (root / "Channel/leg.001").unlink()
    (root / "Channel/leg.001").symlink_to("/etc/hostname")
    return root


def _twice(root: Path) -> Path:
    (root / "other.mme").write_bytes((root / "leg.mme").read_bytes())
    return root


def _zip(spoil: Callable[[zipfile.ZipFile], None]) -> Callable[[Path], Path]:
    def do(root: Path) -> Path:
        target = root.with_suffix(".zip")
        with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
            for path in sorted(root.rglob("*")):
                if path.is_file():
                    archive.write(path, path.relative_to(root))
            spoil(archive)
        return target

    return do


def _cut_zip(root: Path) -> Path:
    target = _zip(lambda _: None)(root)
    target.write_bytes(target.read_bytes()[:-200])
    return target


def _flipped_zip(root: Path) -> Path:
    target = _zip(lambda _: None)(root)
    data = bytearray(target.read_bytes())
    with zipfile.ZipFile(io.BytesIO(bytes(data))) as archive:
        entry = archive.getinfo(CHANNEL)
    middle = entry.header_offset + 60 + entry.compress_size // 2
    data[middle : middle + 8] = b"\xff" * 8
    target.write_bytes(bytes(data))
    return target


def _symlink_member(archive: zipfile.ZipFile) -> None:
    entry = zipfile.ZipInfo("Channel/leg.099")
    entry.external_attr = 0o120777 << 16
    archive.writestr(entry, "/etc/hostname")


DAMAGES = [
    Damage("no mme", "mme", _remove("leg.mme"), r"no \.mme file"),
    Damage("two mme", "mme", _twice, r"2 \.mme files"),
    Damage("no edition", "mme", _edit("leg.mme", r"^Data format.*\n", ""), "no `Data format edition number`"),
    Damage("no channel list", "mme", _remove(LIST), r"no channel list"),
    Damage("empty channel list", "mme", _bytes(LIST, lambda _: b""), r"leg\.chn: is empty"),
    Damage("channel file missing", "mme", _remove(CHANNEL), r"leg\.chn:3: channel 001 .* has no file"),
    Damage(
        "wrong channel count",
        "mme",
        _edit(LIST, r"(?<=channels           :)7", "9"),
        r"leg\.chn:2: 9 channels announced, 7",
    ),
    Damage(
        "absurd channel count",
        "mme",
        _edit(LIST, r"(?<=channels           :)7", "7000000"),
        r"leg\.chn:2: .* refused",
    ),
    Damage("empty channel file", "mme", _bytes(CHANNEL, lambda _: b""), r"leg\.001: is empty"),
    Damage("header only", "mme", _lines(CHANNEL, lambda x: x[:20]), r"leg\.001:21: there are no samples"),
    Damage(
        "truncated",
        "mme",
        _lines(CHANNEL, lambda x: x[:-500]),
        r"leg\.001:17: 2500 samples announced, 2001 found",
    ),
    Damage(
        "wrong sample count",
        "mme",
        _edit(CHANNEL, r":2500$", ":2600"),
        r"leg\.001:17: 2600 samples announced, 2500",
    ),
    Damage(
        "absurd sample count",
        "mme",
        _edit(CHANNEL, r":2500$", ":99999999999"),
        r"leg\.001:17: 99999999999 samples",
    ),
    Damage(
        "sample count in words", "mme", _edit(CHANNEL, r":2500$", ":many"), r"leg\.001:17: .* whole number"
    ),
    Damage("no sample count", "mme", _edit(CHANNEL, r"^Number of samples.*\n", ""), "no `Number of samples`"),
    Damage("no sampling interval", "mme", _edit(CHANNEL, r"^Sampling.*\n", ""), "no `Sampling interval`"),
    Damage(
        "interval NOVALUE",
        "mme",
        _edit(CHANNEL, r"(?<=interval            :).*", "NOVALUE"),
        "no `Sampling interval`",
    ),
    Damage(
        "interval zero",
        "mme",
        _edit(CHANNEL, r"(?<=interval            :).*", "0"),
        r"leg\.001:14: a sampling interval of 0 s",
    ),
    Damage("no first time", "mme", _edit(CHANNEL, r"^Time of first.*\n", ""), "no `Time of first sample`"),
    Damage(
        "unknown unit",
        "mme",
        _edit(CHANNEL, r":Nm$", ":furlong"),
        r"leg\.001:11: unit `furlong` for tibia moment 1",
    ),
    Damage("wrong unit", "mme", _edit(CHANNEL, r":Nm$", ":mm"), r"leg\.001:11: unit `mm` .* written in N·m"),
    Damage("no unit", "mme", _edit(CHANNEL, r"^Unit.*\n", ""), r"leg\.001: no `Unit`"),
    Damage(
        "NaN",
        "mme",
        _lines(CHANNEL, lambda x: [*x[:700], "nan", *x[701:]]),
        r"leg\.001:701: `nan` is not a finite number",
    ),
    Damage(
        "infinite",
        "mme",
        _lines(CHANNEL, lambda x: [*x[:700], "1e999", *x[701:]]),
        r"leg\.001:701: .* finite",
    ),
    Damage(
        "NOVALUE",
        "mme",
        _lines(CHANNEL, lambda x: [*x[:700], "NOVALUE", *x[701:]]),
        r"leg\.001:701: a sample is missing",
    ),
    Damage(
        "word",
        "mme",
        _lines(CHANNEL, lambda x: [*x[:700], "overflow", *x[701:]]),
        r"leg\.001:701: `overflow` is not a number",
    ),
    Damage(
        "decimal comma",
        "mme",
        _lines(CHANNEL, lambda x: [*x[:700], "1,5", *x[701:]]),
        r"leg\.001:701: .* decimal comma",
    ),
    Damage(
        "two values a line",
        "mme",
        _lines(CHANNEL, lambda x: [*x[:700], "1 2", *x[701:]]),
        r"leg\.001:701: 2 values",
    ),
    Damage(
        "binary", "mme", _bytes(CHANNEL, lambda x: x[:900] + b"\0\1" + x[902:]), r"leg\.001:\d+: a zero byte"
    ),
    Damage(
        "two encodings in a file",
        "mme",
        _bytes("leg.mme", lambda x: x + "Title :Prüfung\n".encode() + "Comments :Größe\n".encode("cp1252")),
        r"leg\.mme:\d+: UTF-8 here, another encoding elsewhere",
    ),
    Damage(
        "two encodings in a test",
        "mme",
        lambda root: _bytes(LIST, lambda x: x + "Comments :Größe\n".encode("cp1252"))(
            _bytes("leg.mme", lambda x: x + "Comments :Größe\n".encode())(root)
        ),
        "cp1252 text, but leg.mme is utf-8",
    ),
    Damage(
        "huge header",
        "mme",
        _lines(CHANNEL, lambda x: ["Comments :more"] * 600 + x),
        "more than 500 header lines",
    ),
    Damage(
        "endless line",
        "mme",
        _lines(CHANNEL, lambda x: ["Comments :" + "x" * 9000, *x]),
        r"leg\.001:1: a line of",
    ),
    Damage(
        "another code in the file",
        "mme",
        _edit(CHANNEL, r"TIBIUP", "TIBILO"),
        r"leg\.001:5: channel code D0TIBILO",
    ),
    Damage("code twice", "mme", _edit(LIST, r"D0TIBIMIUPPFMOX0", "D0TIBIUP00PFMOX0"), r"are both T1"),
    Damage("no legform", "mme", _edit(LIST, r"PF", "XX", count=0), "no channel of a Flex-PLI"),
    Damage(
        "contradicting filter",
        "mme",
        lambda root: _edit(LIST, r"(?<=TIBIUP00PFMOX)0", "D")(
            _edit(CHANNEL, r"class      :NOVALUE", "class      :180")(
                _edit(CHANNEL, r"(?<=TIBIUP00PFMOX)0", "D")(root)
            )
        ),
        r"leg\.001:10: CFC 180, but the code",
    ),
    Damage("two time bases", "mme", _edit(CHANNEL, r":0\.0001$", ":0.0002"), "two time bases"),
    Damage("two starts", "mme", _edit(CHANNEL, r":-0\.05$", ":0"), "two time bases"),
    Damage(
        "explicit time",
        "mme",
        _edit(CHANNEL, r":implicit", ":explicit"),
        r"leg\.001:18: time in a channel of its own",
    ),
    Damage("clipped", "mme", _clip, r"leg\.001:\d+: clipped at (199.9|200)"),
    Damage("symbolic link", "mme", _link, "a symbolic link"),
    Damage("zip cut off", "mme", _cut_zip, "not a whole zip archive"),
    Damage("zip with flipped bits", "mme", _flipped_zip, "damaged in the archive"),
    Damage(
        "zip path escape",
        "mme",
        _zip(lambda a: a.writestr("../../evil.mme", "x")),
        "leads out of the archive",
    ),
    Damage(
        "zip absolute path", "mme", _zip(lambda a: a.writestr("/etc/evil", "x")), "leads out of the archive"
    ),
    Damage("zip link", "mme", _zip(_symlink_member), "a symbolic link in the archive"),
    Damage("zip bomb", "mme", _zip(lambda a: a.writestr("Channel/leg.098", b"0\n" * 10_000_000)), "zip bomb"),
    Damage("csv empty", "csv", _bytes("", lambda _: b""), "is empty"),
    Damage("csv heads only", "csv", _lines("", lambda x: x[:5]), "no samples"),
    Damage(
        "csv truncated",
        "csv",
        _bytes("", lambda x: x[:-20]),
        r"leg\.csv:\d+: \d values where 8 values should be",
    ),
    Damage(
        "csv no unit", "csv", _edit("", r"T1 \[N·m\]", "T1"), r"leg\.csv:5: the column head `T1` has no unit"
    ),
    Damage("csv wrong unit", "csv", _edit("", r"T1 \[N·m\]", "T1 [mm]"), r"leg\.csv:5: T1: unit `mm`"),
    Damage("csv no time", "csv", _edit("", r"time \[s\]", "F1 [N·m]"), r"leg\.csv:5: no column `time"),
    Damage(
        "csv column twice", "csv", _edit("", r"T2 \[", "T1 ["), r"leg\.csv:5: the column `T1` stands twice"
    ),
    Damage(
        "csv NaN",
        "csv",
        _lines("", lambda x: [*x[:90], "nan" + x[90][x[90].index(",") :], *x[91:]]),
        r"leg\.csv:91: `nan`",
    ),
    Damage(
        "csv gap",
        "csv",
        _lines("", lambda x: [*x[:90], re.sub(r",[^,]*", ",", x[90], count=1), *x[91:]]),
        r"leg\.csv:91: a sample is missing",
    ),
    Damage(
        "csv lost line",
        "csv",
        _lines("", lambda x: x[:900] + x[901:]),
        r"leg\.csv:\d+: the sampling is not uniform",
    ),
    Damage(
        "csv time runs back",
        "csv",
        _lines("", lambda x: [*x[:90], x[60], *x[91:]]),
        r"leg\.csv:91: time does not rise",
    ),
    Damage("csv condition", "csv", _edit("", r"293.35 K", "warm"), r"leg\.csv:\d: temperature: `warm`"),
]
