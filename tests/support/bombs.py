"""Files that are small or look harmless, and would take all memory or all time if they were believed."""

from __future__ import annotations

import gzip
import io
import os
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path

HEAD = (
    "Number of samples :{count}\nSampling interval :5e-5\nTime of first sample :0\nUnit :Nm\n"
    "Channel code :D1TIBIMI00PFMOXP\nData status :OK\n"
)
MASTER = "Data format edition number :1.6\n"
LIST = "Number of channels :1\nName of channel 001 :D1TIBIMI00PFMOXP\n"


def archive(path: Path, channel: bytes, method: int = zipfile.ZIP_DEFLATED) -> Path:
    with zipfile.ZipFile(path, "w", method) as made:
        made.writestr("t.mme", MASTER)
        made.writestr("Channel/t.chn", LIST)
        made.writestr("Channel/t.001", channel)
    return path


def samples(count: int, text: str = "12.34\n") -> bytes:
    return HEAD.format(count=count).encode() + text.encode() * count


def zip_of_zeros(folder: Path) -> Path:
    return archive(folder / "zeros.zip", b"0" * 400_000_000)


def zip_of_samples(folder: Path) -> Path:
    """Return an archive whose text packs no better than real samples do."""
    lines = "".join(f"{(7919 * n) % 100003}.{n % 97}\n" for n in range(100_000)).encode()
    return archive(folder / "samples.zip", HEAD.format(count=9_000_000).encode() + 90 * lines)


def zip_of_short_lines(folder: Path) -> Path:
    return archive(
        folder / "short.zip", HEAD.format(count=15_000_000).encode() + os.urandom(8) + b"1\n" * 15_000_000
    )


def zip_by_bzip2(folder: Path) -> Path:
    return archive(folder / "bzip2.zip", b"0" * 300_000_000, zipfile.ZIP_BZIP2)


def zip_that_lies_about_its_size(folder: Path) -> Path:
    path = archive(folder / "lies.zip", b"0" * 300_000_000)
    data = bytearray(path.read_bytes())
    size = struct.pack("<I", 300_000_000)
    at = data.find(size)
    while at >= 0:
        data[at : at + 4] = struct.pack("<I", 1000)
        at = data.find(size, at + 4)
    path.write_bytes(data)
    return path


def zip_of_many_members(folder: Path) -> Path:
    with zipfile.ZipFile(folder / "many.zip", "w") as made:
        for number in range(300_000):
            made.writestr(f"{number}", b"")
    return folder / "many.zip"


def zip_in_a_zip(folder: Path) -> Path:
    inner = io.BytesIO()
    with zipfile.ZipFile(inner, "w", zipfile.ZIP_DEFLATED) as made:
        made.writestr("deeper.zip", b"0" * 100_000_000)
    with zipfile.ZipFile(folder / "nested.zip", "w") as made:
        made.writestr("test.zip", inner.getvalue())
    return folder / "nested.zip"


def csv_of_one_line(folder: Path) -> Path:
    (folder / "line.csv").write_bytes(b"time [s],T1 [N\xc2\xb7m]\n" + b"1" * 60_000_000)
    return folder / "line.csv"


def csv_of_many_columns(folder: Path) -> Path:
    head = "time [s]" + ",T1 [N·m]" * 10_000
    (folder / "columns.csv").write_text(f"{head}\n" + ("1," * 10_000 + "1\n") * 400)
    return folder / "columns.csv"


def csv_of_many_lines(folder: Path) -> Path:
    (folder / "lines.csv").write_bytes(b"time [s],T1 [N\xc2\xb7m]\n" + b"\n" * 31_000_000)
    return folder / "lines.csv"


def csv_of_many_values(folder: Path) -> Path:
    head = "time [s]" + "".join(f",c{n}" for n in range(29))
    (folder / "values.csv").write_text(head + "\n" + (",".join(["x"] * 30) + "\n") * 500_000)
    return folder / "values.csv"


def csv_of_wide_characters(folder: Path) -> Path:
    (folder / "wide.csv").write_text("time [s],T1 [N·m] 😀\n" + "0,12\n" * 590_000 + "# " + "x" * 25_000_000)
    return folder / "wide.csv"


def device(folder: Path) -> Path:
    (folder / "zero.csv").symlink_to("/dev/zero")
    return folder / "zero.csv"


def pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe.csv")
    return folder / "pipe.csv"


def large_and_hollow(folder: Path) -> Path:
    with (folder / "hollow.csv").open("wb") as stream:
        stream.truncate(50_000_000_000)
    return folder / "hollow.csv"


GRADED: tuple[Callable[[Path], Path], ...] = (
    zip_of_zeros,
    zip_of_samples,
    zip_of_short_lines,
    zip_by_bzip2,
    zip_that_lies_about_its_size,
    zip_of_many_members,
    zip_in_a_zip,
    csv_of_one_line,
    csv_of_many_columns,
    csv_of_many_lines,
    csv_of_many_values,
    csv_of_wide_characters,
    device,
    pipe,
    large_and_hollow,
)


def document(name: str, content: Callable[[], str]) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        (folder / f"{name}.json").write_text('{"schema": "certkit-result/1", ' + content() + "}")
        return folder / f"{name}.json"

    make.__name__ = f"document_of_{name}"
    return make


REPORTED: tuple[Callable[[Path], Path], ...] = (
    document("numbers", lambda: '"notes": [' + "0," * 20_000_000 + "0]"),
    document("few_numbers", lambda: '"notes": [' + "0," * 790_000 + "0]"),
    document("lists", lambda: '"notes": [' + "[]," * 190_000 + "[]]"),
    document("mappings", lambda: '"notes": [' + '{"a":1},' * 130_000 + "[]]"),
    document("words", lambda: '"notes": [' + '"ab",' * 390_000 + '"ab"]'),
    document("depth", lambda: '"notes": ' + "[" * 3_000_000),
    document("one_word", lambda: '"title": "' + "😀" * 11_000_000 + '"'),
    document("keys", lambda: '"specimen": {' + ",".join(f'"{n}":""' for n in range(390_000)) + "}"),
    device,
    pipe,
    large_and_hollow,
)


def yaml_of_aliases(folder: Path) -> Path:
    lines = ["procedure: bomb", "a0: &a0 [1,1,1,1,1,1,1,1,1,1]"]
    lines += [f"a{n}: &a{n} [" + ",".join([f"*a{n - 1}"] * 10) + "]" for n in range(1, 12)]
    (folder / "aliases.yaml").write_text("\n".join(lines))
    return folder / "aliases.yaml"


def yaml_of_values(folder: Path) -> Path:
    (folder / "values.yaml").write_text("procedure: bomb\nnotes: [" + "1," * 980_000 + "1]")
    return folder / "values.yaml"


def yaml_of_depth(folder: Path) -> Path:
    (folder / "depth.yaml").write_text("procedure: bomb\nnotes: " + "[" * 1_900_000)
    return folder / "depth.yaml"


def yaml_of_one_word(folder: Path) -> Path:
    (folder / "word.yaml").write_text("procedure: " + "x" * 1_900_000)
    return folder / "word.yaml"


def yaml_of_keys(folder: Path) -> Path:
    (folder / "keys.yaml").write_text("procedure: bomb\n" + "".join(f"k{n}: 1\n" for n in range(150_000)))
    return folder / "keys.yaml"


def yaml_pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe.yaml")
    return folder / "pipe.yaml"


def yaml_device(folder: Path) -> Path:
    (folder / "zero.yaml").symlink_to("/dev/zero")
    return folder / "zero.yaml"


VALIDATED: tuple[Callable[[Path], Path], ...] = (
    yaml_of_aliases,
    yaml_of_values,
    yaml_of_depth,
    yaml_of_one_word,
    yaml_of_keys,
    yaml_pipe,
    yaml_device,
)


def _case(folder: Path, form: str, file: str) -> Path:
    (folder / "case.yaml").write_text(
        "case: bomb\ntitle: Bomb\nvehicle: bomb\norigin: {source: made up, confidence: estimated}\n"
        f"histories: {{format: {form}, files: [{file}], units: kg mm ms}}\n"
        "groups:\n  impactor: {kind: impactor, parts: [x]}\n"
        "  beam: {kind: engine room, parts: [y]}\n"
        "paths:\n  - {between: [impactor, beam]}\n"
    )
    return folder / file


def gz_of_zeros(folder: Path) -> Path:
    path = _case(folder, "openradioss native", "h.T01.gz")
    with gzip.open(path, "wb", 9) as stream:
        for _ in range(1000):
            stream.write(bytes(1_000_000))
    return path


def gz_of_records(folder: Path) -> Path:
    """Return a history of sound but empty records without end."""
    path = _case(folder, "openradioss native", "h.T01.gz")
    title = struct.pack(">i", 3040) + b" " * 80
    records = [title, b" " * 80, struct.pack(">6i", 0, 0, 0, 0, 0, 1), struct.pack(">i", 1)]
    data = b"".join(struct.pack(">i", len(r)) + r + struct.pack(">i", len(r)) for r in records)
    one = struct.pack(">ifi", 4, 0.0, 4)
    with gzip.open(path, "wb", 9) as stream:
        stream.write(data + one * 5_000_000)
    return path


def gz_of_cells(folder: Path) -> Path:
    path = _case(folder, "openradioss csv", "h.csv.gz")
    with gzip.open(path, "wb", 9) as stream:
        stream.write(b"time,x XMOM\n" + b"10,20\n" * 10_000_000)
    return path


def csv_of_one_cell(folder: Path) -> Path:
    path = _case(folder, "openradioss csv", "h.csv")
    path.write_bytes(b"time,x XMOM\n" + b"1" * 60_000_000)
    return path


EXTRACTED: tuple[Callable[[Path], Path], ...] = (gz_of_zeros, gz_of_records, gz_of_cells, csv_of_one_cell)
