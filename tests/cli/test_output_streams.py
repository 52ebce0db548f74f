"""A verdict does not depend on who reads it: any encoding, any reader, a full disk, a closed stream."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.command import Command

from certkit.cli.output_streams import OutputStream
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.result import Result
from certkit.errors import DataError, DefinitionError
from certkit.exchange.text import decode
from certkit.plain_text import odd_character, odd_character_in_json, without_odd_characters

RUN = (sys.executable, "-m", "certkit", "run", "inverse", "--format", "junit", "--out")
ESCAPE = "\x1b[2K\x1b]0;x\x07"


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp437", "utf-16", "latin-1"])
def test_a_verdict_is_told_in_any_encoding(tmp_path: Path, encoding: str):
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    done = subprocess.run([*RUN, tmp_path], capture_output=True, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    assert "PASS" in done.stdout.decode(encoding)


def test_help_is_told_where_there_is_no_locale(certkit: Command):
    done = certkit("--help", LC_ALL="POSIX", PYTHONCOERCECLOCALE="0", PYTHONUTF8="0")
    assert (done.returncode, "Traceback" in done.stderr) == (0, False)


def test_a_reader_that_goes_away_does_not_change_the_verdict(tmp_path: Path):
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run([*RUN, tmp_path], stdout=write, stderr=subprocess.PIPE, text=True, check=False)
    os.close(write)
    assert (done.returncode, "Traceback" in done.stderr) == (0, False)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_full_disk_behind_standard_output_is_told_and_the_verdict_holds(tmp_path: Path):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run([*RUN, tmp_path], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 0
    assert "standard output: No space left on device; the files are written" in done.stderr


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda path: path.touch(), "a file stands where a folder should be"),
        (lambda path: (path.mkdir(), (path / "inverse").touch()), "a file stands where a folder should be"),
    ],
    ids=["file", "file inside"],
)
def test_a_place_that_cannot_be_written_is_one_line(tmp_path: Path, make: object, message: str):
    make(tmp_path / "out")
    out = tmp_path / "out" / ("" if (tmp_path / "out").is_file() else "inverse")
    done = subprocess.run([*RUN, out], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    (line,) = [line for line in done.stderr.splitlines() if line.startswith("error")]
    assert message in line
    assert str(out) in line


def test_a_name_that_is_too_long_is_one_line(tmp_path: Path):
    done = subprocess.run([*RUN, tmp_path / ("y" * 300)], capture_output=True, text=True, check=False)
    assert (done.returncode, "take a shorter name" in done.stderr) == (2, True)


def test_a_pipe_sees_no_character_that_steers_a_terminal():
    held = io.StringIO()
    OutputStream(held, "standard output", plain=True).write(f"title {ESCAPE}\tvalue\n")
    assert odd_character(held.getvalue()) is None
    assert held.getvalue().endswith("\tvalue\n")


def test_github_obeys_no_line_but_our_own():
    held = io.StringIO()
    stream = OutputStream(held, "standard output", plain=True, commands=True)
    stream.write("::add-mask::pass\n  ##[group]x\nplain\n")
    stream.command("::error title=T1::too high")
    lines = held.getvalue().splitlines()
    assert [line for line in lines if line.startswith(("::", "##["))] == ["::error title=T1::too high"]
    assert "plain" in lines


def test_a_stream_that_fails_once_is_left_alone_and_told_at_the_end():
    class Full(io.StringIO):
        calls = 0

        def write(self, text: str) -> int:
            del text
            self.calls += 1
            raise OSError(28, "No space left on device")

    full = Full()
    stream = OutputStream(full, "standard output", plain=True)
    stream.write("a")
    stream.write("b")
    assert full.calls == 1
    assert stream.end() == "standard output: No space left on device"


@pytest.mark.parametrize("odd", ["\\x1b[1A", "\\x07", "\\u202e", "\\x00", "\\uFFFE", "\\x9b"])
def test_a_definition_with_such_a_character_is_refused_with_its_place(odd: str):
    tree = read_tree(f'procedure: x\ntitle: "Our {odd} test"\n', "mine.yaml")
    assert [(p.line, p.column) for p in tree.problems] == [(2, 8)]
    assert "control character U+" in tree.problems[0].message


def test_a_key_with_such_a_character_is_refused():
    (problem,) = read_tree('"pro\\x1bcedure": x\n', "mine.yaml").problems
    assert "U+001B" in problem.message


def test_a_document_with_such_a_character_was_changed():
    for odd in ("\\u001b", "\\u202E", "\\ufffe", "\u009b"):
        with pytest.raises(DataError, match="certkit writes none"):
            Result.from_json(f'{{"title": "{odd}"}}')


def test_what_only_looks_like_an_escape_is_plain():
    assert (
        odd_character_in_json(r'{"a": "\\u001b", "b": "\n\t\"", "c": "\ud83d\ude00", "d": "µ ≤ 3"}') is None
    )


def test_a_measured_file_with_such_a_character_is_refused_with_its_line():
    with pytest.raises(DataError, match=r"leg.csv:2: the control character U\+0008.*remove it"):
        decode(b"time,T1\n0,\b1\n", "leg.csv")
    assert decode(b"time,T1\r\n0,1\r\n\x1a", "leg.csv")[0] == "time,T1\n0,1\n"


def test_replacing_leaves_nothing_odd():
    everything = "".join(map(chr, range(0x300))) + "\ud800\ufffe"
    assert odd_character(without_odd_characters(everything)) is None
    with pytest.raises(DefinitionError):
        read_tree(b"\x00", "x.yaml")


def test_every_character_that_is_replaced_is_found():
    texts = [f"a{chr(code)}" for code in range(0x10000)]
    assert [
        text for text in texts if (odd_character(text) is None) != (without_odd_characters(text) == text)
    ] == []
