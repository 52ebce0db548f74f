"""What Windows lacks is not missed: locks, worker processes, encodings, line ends, paths with drives."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path, PureWindowsPath

import pytest

from certkit.cli.output_streams import OutputStream
from certkit.definitions.loading.search_path import is_name, is_path
from certkit.files.folder_switch import _is_inside

TESTS = Path(__file__).parents[1]
WORLD = TESTS / "support" / "windows_like"
PARTS = (
    "bench/test_result_folder.py",
    "definitions/loading/test_old_forms.py",
    "exchange/test_channels_csv.py",
    "exchange/test_spreadsheets.py",
    "studies/test_runs.py::test_two_processes_give_the_bits_of_one",
)
"""Tests that meet files, folders, locks, definitions, tables, and worker processes."""


def there(tmp_path: Path) -> dict[str, str]:
    path = os.pathsep.join([str(WORLD), *filter(None, [os.environ.get("PYTHONPATH")])])
    return {**os.environ, "PYTHONPATH": path, "PYTEST_ADDOPTS": "", "HOME": str(tmp_path)}


def test_that_world_lacks_what_windows_lacks(tmp_path: Path):
    code = (
        "import os, signal\ntry:\n    import fcntl\nexcept ImportError:\n    print(hasattr(os, 'fork'), "
        "hasattr(signal, 'SIGHUP'))\nopen('a', 'w').write('ü\\n')"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, env=there(tmp_path), capture_output=True, check=True
    )
    assert done.stdout.split() == [b"False", b"False"]
    assert (tmp_path / "a").read_bytes() == b"\xfc\r\n"


@pytest.mark.slow
def test_the_suite_passes_where_files_and_processes_are_those_of_windows(tmp_path: Path):
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--basetemp", tmp_path / "t"]
    environment = there(tmp_path) | {
        "CERTKIT_CACHE": os.environ.get("CERTKIT_CACHE", str(tmp_path / "cache"))
    }
    done = subprocess.run(
        [*command, *PARTS], cwd=TESTS, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout[-3000:]


@pytest.mark.parametrize("text", [r"C:\legs\my leg", r"C:my-leg", r"legs\mine", "legs/mine", "mine.yaml"])
def test_a_path_is_told_from_a_name_with_drives_and_either_slash(text: str):
    assert is_path(text, PureWindowsPath)
    assert not is_path("my-leg 2.1", PureWindowsPath)


@pytest.mark.parametrize("text", ["C:x", "C:/x", "..\\x", "\\\\server\\x", "/x", "../x", "a:b"])
def test_a_list_of_files_leads_to_no_other_folder_or_drive(text: str):
    assert not _is_inside(text)
    assert not is_name(text)


def test_a_file_that_a_command_is_redirected_to_is_utf_8_on_windows(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.delenv("PYTHONIOENCODING", raising=False)
    for platform, bytes_ in (("win32", "N·m ✓".encode()), ("linux", "N·m ?".encode("cp1252"))):
        monkeypatch.setattr(sys, "platform", platform)
        raw = io.BytesIO()
        stream = OutputStream(io.TextIOWrapper(raw, encoding="cp1252"), "standard output", plain=True)
        stream.write("N·m ✓")
        stream.flush()
        assert raw.getvalue() == bytes_
