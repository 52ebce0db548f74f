"""Replacing what a folder holds as a whole: written beside it, flushed to the disk, switched in one step.

The new files are written into a folder beside the old one, which what stays of the old one is linked into.
Then the two names are exchanged, which the system does at once or not at all. Where it has no such call, or
the folder is no plain one of the user's own, the new files go into the folder as `.certkit-switch`, with a
list of what is to be done; from then on they count, and whoever opens the folder next finishes what a killed
process has begun. What belongs to somebody else stays in either case.
"""

from __future__ import annotations

import errno
import hashlib
import json
import os
import shutil
import sys
from contextlib import ExitStack
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Self

from certkit.files.process_lock import locked
from certkit.files.whole_file import sync_folder, sync_tree

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

SWITCH = ".certkit-switch"
LIST = ".certkit-files.json"
_LONGEST = 100  # characters of a folder's name in the names beside it; a file system takes 255 bytes
_MOST_LINKS = 100  # of files that are not replaced; a folder with more of them is somebody else's
_EXCHANGE = 2  # RENAME_EXCHANGE of Linux
_HERE = -100  # AT_FDCWD


class FolderSwitch:
    """A folder whose content is being replaced: a context that commits at its end, but not after an error.

    Attributes
    ----------
    folder : Path
        Without symbolic links.
    stage : Path
        Folder for the new files; what is in it at the end replaces files of the same name.
    stale : collection of str
        Names in the folder that are removed with the switch. All others stay.

    Raises
    ------
    OSError
        On entering or leaving: with the folder as its file name.
    """

    def __init__(self, folder: Path, waiting: Callable[[], None] = lambda: None) -> None:
        """Touch nothing yet; `waiting` is called when another process is at work in the folder."""
        self.folder = folder.resolve()
        self.stale: Collection[str] = ()
        self._waiting = waiting
        self._stack = ExitStack()
        parent, name = self.folder.parent, _short(self.folder.name)
        self._made = [each for each in (parent, *parent.parents) if not each.exists()]
        beside = name and not os.path.ismount(self.folder) and (self._made or os.access(parent, os.W_OK))
        self._lock = parent / f".{name}.lock" if beside else self.folder / ".certkit.lock"
        self.stage = parent / f".{name}.new" if beside else self.folder / ".certkit-new"

    def __enter__(self) -> Self:
        """Wait for the lock, finish or remove what a killed process left, and make the stage."""
        try:
            if self.folder.exists() and not self.folder.is_dir():
                raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), str(self.folder))
            self._lock.parent.mkdir(parents=True, exist_ok=True)
            self._stack.enter_context(locked(self._lock, self._waiting))
            self._clean()
            self.stage.mkdir()
        except OSError as error:
            self._leave()
            raise self._named(error) from error
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, *_: object) -> None:
        """Commit, or leave the folder as it was."""
        try:
            if kind is None:
                self._commit()
        except OSError as failed:
            raise self._named(failed) from failed
        finally:
            shutil.rmtree(self.stage, ignore_errors=True)
            self._leave()
        if isinstance(error, OSError) and (
            error.filename is None or str(error.filename).startswith(str(self.stage))
        ):
            raise self._named(error) from error

    def _leave(self) -> None:
        self._stack.close()
        for folder in self._made:  # parents that turned out to be of no use
            try:
                folder.rmdir()
            except OSError:
                break

    def _named(self, error: OSError) -> OSError:
        """Return the error about the folder that the user named."""
        if str(self.folder) in str(error.filename) and not str(error.filename).startswith(str(self.stage)):
            return error
        return OSError(error.errno, error.strerror, str(self.folder))

    def _clean(self) -> None:
        finish(self.folder)
        if self.stage.is_symlink():
            self.stage.unlink()
        elif self.stage.exists():
            shutil.rmtree(self.stage)

    def _commit(self) -> None:
        sync_tree(self.stage)
        if not self.folder.exists():
            self.stage.rename(self.folder)
            sync_folder(self.folder.parent)
        elif not (self._can_be_exchanged() and self._exchange()):
            self._switch_in_place()

    def _can_be_exchanged(self) -> bool:
        """Tell whether the folder may be another one afterwards; link what stays into the stage."""
        if self.stage.parent == self.folder or Path.cwd().is_relative_to(self.folder):
            return False
        old, new = self.folder.stat(), self.stage.stat()
        if (old.st_uid, old.st_gid) != (new.st_uid, new.st_gid):
            return False
        links: list[Path] = []
        try:
            _link_rest(self.folder, self.stage, self.stale, links)
        except OSError:  # no links here, or too much that is somebody else's
            for link in links:
                link.unlink()
            return False
        for parent in {link.parent for link in links}:
            sync_folder(parent)
        return True

    def _exchange(self) -> bool:
        """Exchange stage and folder in one step; False where the system has no such call."""
        if not sys.platform.startswith("linux"):
            return False
        import ctypes  # noqa: PLC0415  # only here

        call = getattr(ctypes.CDLL(None), "renameat2", None)
        shutil.copymode(self.folder, self.stage)
        if call is None or call(_HERE, os.fsencode(self.stage), _HERE, os.fsencode(self.folder), _EXCHANGE):
            return False
        sync_folder(self.folder.parent)
        _move_rest(self.stage, self.folder, self.stale)
        return True

    def _switch_in_place(self) -> None:
        files = sorted(p.relative_to(self.stage).as_posix() for p in self.stage.rglob("*") if p.is_file())
        plan = self.stage / LIST
        plan.write_text(json.dumps({"files": files, "stale": sorted(self.stale)}), encoding="utf-8")
        sync_tree(self.stage)
        self.stage.rename(self.folder / SWITCH)
        sync_folder(self.folder)
        finish(self.folder)


def finish(folder: Path) -> None:
    """Finish a switch that has begun in a folder; see `FolderSwitch`. Without one, do nothing."""
    switch = folder / SWITCH
    if not switch.is_dir() or switch.is_symlink():
        return
    try:
        plan = json.loads((switch / LIST).read_text(encoding="utf-8"))
        files, stale = (
            [str(name) for name in plan[key] if _is_inside(str(name))] for key in ("files", "stale")
        )
    except (OSError, ValueError, KeyError, TypeError):
        files, stale = [], []  # not of our making, or all but removed
    for name in set(stale) - set(files):
        if (folder / name).is_file():
            (folder / name).unlink()
    for name in files:
        if (switch / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (switch / name).replace(folder / name)
    for parent in {(folder / name).parent for name in files} | {folder}:
        if parent.is_dir():
            sync_folder(parent)
    shutil.rmtree(switch)


def _link_rest(old: Path, new: Path, stale: Collection[str], links: list[Path]) -> None:
    """Link what is in one folder and not in the other into that one, but what is stale; note the links.

    Raises
    ------
    OSError
        When the system does not link, or there are folders of somebody else's or many files.
    """
    for path in old.iterdir():
        target = new / path.name
        if path.is_dir() and not path.is_symlink():
            if not target.is_dir():
                raise OSError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
            shutil.copystat(path, target)
            _link_rest(path, target, (), links)
        elif path.name not in stale and not os.path.lexists(target):
            if len(links) == _MOST_LINKS:
                raise OSError(errno.EMLINK, os.strerror(errno.EMLINK), str(old))
            os.link(path, target, follow_symlinks=False)
            links.append(target)


def _move_rest(old: Path, new: Path, stale: Collection[str]) -> None:
    """Move what somebody has put into the old folder while the new one was made ready."""
    for path in old.iterdir():
        if path.name not in stale and not os.path.lexists(new / path.name):
            path.rename(new / path.name)


def _is_inside(name: str) -> bool:
    """Tell whether a name stays in the folder: the list could be somebody else's."""
    path = PurePosixPath(name)
    plain = not {"\\", ":"} & set(name)  # no way elsewhere on Windows: `C:name` is on that drive
    return plain and bool(path.parts) and not path.is_absolute() and ".." not in path.parts


def _short(name: str) -> str:
    """Return a folder's name, or as much of it as leaves room for an ending."""
    if len(name) <= _LONGEST:
        return name
    return f"{name[:_LONGEST]}-{hashlib.sha256(name.encode()).hexdigest()[:8]}"
