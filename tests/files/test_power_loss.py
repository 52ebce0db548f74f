"""What is called written outlives a power cut; a cut at any moment leaves the old whole or the new whole."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from support.power_loss import FlushedDisk, PowerLossError

from certkit.files import write_whole
from certkit.files.folder_switch import FolderSwitch

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks into /proc")

OLD = {"result.json": b"old", "report.html": b"old page"}
NEW = {"result.json": b"new", "junit.xml": b"new cases"}


def switch(root: Path) -> None:
    with FolderSwitch(root / "out") as begun:
        begun.stale = OLD
        for name, content in NEW.items():
            (begun.stage / name).write_bytes(content)


def write(root: Path) -> None:
    write_whole(root / "out" / "result.json", b"new", durable=True)


def with_old(root: Path) -> None:
    (root / "out").mkdir()
    for name, content in OLD.items():
        (root / "out" / name).write_bytes(content)


def visible(found: dict[str, object]) -> dict[str, object]:
    """Leave out what the next command removes."""
    return {name: content for name, content in found.items() if not name.startswith(".")}


@pytest.mark.parametrize("old", [False, True])
def test_a_result_that_is_called_written_is_on_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, old: bool
):
    if old:
        with_old(tmp_path)
    disk = FlushedDisk(tmp_path, monkeypatch)
    switch(tmp_path)
    assert visible(disk.found()) == {"out": NEW}


def test_a_file_that_is_called_written_is_on_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    with_old(tmp_path)
    disk = FlushedDisk(tmp_path, monkeypatch)
    write(tmp_path)
    assert disk.found()["out"]["result.json"] == b"new"


def test_the_disk_would_show_a_file_that_nobody_flushed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    with_old(tmp_path)
    disk = FlushedDisk(tmp_path, monkeypatch)
    write_whole(tmp_path / "out" / "result.json", b"new")
    assert disk.found()["out"]["result.json"] == b"old"


@pytest.mark.parametrize("action", [switch, write])
@pytest.mark.parametrize("fails_at", range(1, 8))
def test_a_cut_at_any_moment_leaves_the_old_or_the_new(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, action: Callable[[Path], None], fails_at: int
):
    with_old(tmp_path)
    disk = FlushedDisk(tmp_path, monkeypatch, fails_at)
    with contextlib.suppress(PowerLossError):
        action(tmp_path)
    found = visible(disk.found())["out"]
    assert found in (OLD, NEW) or (action is write and found == {**OLD, "result.json": b"new"})
