"""A disk that keeps only what was flushed: a file's content and a folder's names at their last fsync."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

Tree = dict[str, Any]


class PowerLossError(Exception):
    """The current fails."""


class FlushedDisk:
    """What would be found after a power cut.

    Parameters
    ----------
    root : Path
        Folder that is watched; what stands in it now is on the disk.
    fails_at : int, optional
        Number of the fsync at which the current fails.
    """

    def __init__(self, root: Path, monkeypatch: pytest.MonkeyPatch, fails_at: int | None = None) -> None:
        self.root = root
        self.fails_at = fails_at
        self.count = 0
        self.files: dict[int, bytes] = {}
        self.folders: dict[int, dict[str, int]] = {}
        self._real = os.fsync
        self._note(root)
        monkeypatch.setattr(os, "fsync", self._fsync)

    def _note(self, path: Path) -> None:
        if path.is_dir():
            self.folders[path.stat().st_ino] = {each.name: each.stat().st_ino for each in path.iterdir()}
            for each in path.iterdir():
                self._note(each)
        else:
            self.files[path.stat().st_ino] = path.read_bytes()

    def _fsync(self, descriptor: int) -> None:
        self.count += 1
        if self.count == self.fails_at:
            raise PowerLossError
        self._real(descriptor)
        place = Path(f"/proc/self/fd/{descriptor}").readlink()
        number = os.fstat(descriptor).st_ino
        if place.is_dir():
            self.folders[number] = {each.name: each.stat().st_ino for each in place.iterdir()}
        else:
            self.files[number] = place.read_bytes()

    def found(self) -> Tree:
        """Return what is there after the cut: contents by name; None for a file that was never flushed."""
        return self._tree(self.root.stat().st_ino)

    def _tree(self, folder: int) -> Tree:
        return {
            name: self._tree(number) if number in self.folders else self.files.get(number)
            for name, number in self.folders.get(folder, {}).items()
        }
