"""Folders and zip archives seen as the same thing: names and bytes, nothing outside, nothing endless."""

from __future__ import annotations

import lzma
import os
import stat
import struct
import zipfile
import zlib
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.files.bounded import read_bounded
from certkit.files.limits import (
    MAX_COMPRESSION,
    MAX_CONTAINER_BYTES,
    MAX_MEMBERS,
    MAX_TEXT_BYTES,
    MEGABYTE,
)

if TYPE_CHECKING:
    from collections.abc import Callable

_ENTRY = b"PK\x01\x02"
"""Before each entry of an archive's directory."""

# What the standard library raises on damaged archives, beside `BadZipFile`.
_DAMAGED = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    EOFError,
    OSError,
    OverflowError,
    RuntimeError,  # includes NotImplementedError
    ValueError,
)


class Container(Struct, frozen=True):
    """The files of one test.

    Parameters
    ----------
    label : str
        The folder or archive as the user named it.
    names : tuple of str
        Paths inside it with `/`, sorted.
    read : callable
        Gives the bytes of one of `names`; raises `DataError` when it is too large or damaged.
    """

    label: str
    names: tuple[str, ...]
    read: Callable[[str], bytes]

    def place(self, name: str) -> str:
        """Return how messages name a file inside."""
        return f"{self.label}/{name}"


def open_container(path: Path) -> Container:
    """Open the folder or zip archive of one test.

    Raises
    ------
    DataError
        When it is missing, is neither, leads outside itself, or is too large to be a test.
    """
    if path.is_dir():
        return _folder(path)
    if not path.exists():
        raise DataError(f"{path}: there is no such file or folder; check the name")
    return _archive(path)


def _folder(path: Path) -> Container:
    names = []
    for parent, folders, files in os.walk(path, followlinks=False):
        for name in sorted(folders + files):
            found = Path(parent, name)
            relative = found.relative_to(path).as_posix()
            if found.is_symlink():
                raise DataError(
                    f"{path}/{relative}: a symbolic link, which may lead out of the test; "
                    "put the file itself here"
                )
            if name in files:
                names.append(relative)
        if len(names) > MAX_MEMBERS:
            raise DataError(f"{path}: more than {MAX_MEMBERS} files; name the folder of one test")
    return Container(
        str(path),
        tuple(sorted(names)),
        lambda name: read_bounded(path / name, f"{path}/{name}", largest=MAX_TEXT_BYTES),
    )


def _archive(path: Path) -> Container:
    content = read_bounded(path)
    # Before the directory is read: Python makes half a kilobyte of each entry.
    if content.count(_ENTRY) > MAX_MEMBERS:
        raise DataError(f"{path}: more than {MAX_MEMBERS} files in the archive; pack one test")
    try:
        from io import BytesIO  # noqa: PLC0415  # only for archives

        archive = zipfile.ZipFile(BytesIO(content))
        members = [m for m in archive.infolist() if not m.is_dir() and not m.filename.startswith("__MACOSX/")]
    except _DAMAGED as error:
        raise DataError(f"{path}: not a whole zip archive ({error}); pack the test folder again") from error
    by_name: dict[str, zipfile.ZipInfo] = {}
    for member in members:
        _check_member(path, member)
        if member.filename in by_name:
            raise DataError(f"{path}/{member.filename}: stands twice in the archive; pack the test again")
        by_name[member.filename] = member
    total = sum(member.file_size for member in members)
    if total > MAX_CONTAINER_BYTES:
        raise DataError(
            f"{path}: unpacks to {total / MEGABYTE:.0f} MB; "
            f"refused above {MAX_CONTAINER_BYTES / MEGABYTE:.0f} MB: pack one test"
        )

    def read(name: str) -> bytes:
        # The size in the archive's directory may lie, so reading stops one byte beyond it.
        member = by_name[name]
        try:
            with archive.open(member) as stream:
                data = stream.read(member.file_size + 1)
        except _DAMAGED as error:
            raise DataError(
                f"{path}/{name}: damaged in the archive ({error}); pack the test again"
            ) from error
        if len(data) != member.file_size:
            raise DataError(
                f"{path}/{name}: does not have the size that the archive states; pack the test again"
            )
        return data

    return Container(str(path), tuple(sorted(by_name)), read)


def _check_member(path: Path, member: zipfile.ZipInfo) -> None:
    """Refuse archive entries that lead out of the archive, hide behind a password, or unpack without end."""
    name = member.filename
    place = f"{path}/{name}"
    parts = PurePosixPath(name).parts
    if name.startswith("/") or ".." in parts or "\\" in name or ":" in name or "\0" in member.orig_filename:
        raise DataError(f"{place}: the name leads out of the archive; pack the test folder again")
    if stat.S_ISLNK(member.external_attr >> 16):
        raise DataError(f"{place}: a symbolic link in the archive; pack the file itself")
    if member.flag_bits & 0x1:
        raise DataError(f"{place}: locked with a password; unlock the archive first")
    bomb = member.file_size > MEGABYTE and member.file_size > MAX_COMPRESSION * max(member.compress_size, 1)
    if bomb or member.file_size > MAX_TEXT_BYTES:
        raise DataError(
            f"{place}: unpacks to {member.file_size / MEGABYTE:.0f} MB from {member.compress_size} bytes; "
            "refused as a zip bomb: pack the test folder again"
        )
