"""A laboratory's logo, as a small picture that pages carry in themselves."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

from certkit.errors import DefinitionError, Problem
from certkit.files.bounded import open_plain

if TYPE_CHECKING:
    from pathlib import Path

LOGO_BYTES = 300_000
LOGO_PIXELS = 4_000
"""Largest logo: it is embedded in every page and report."""

_PNG = b"\x89PNG\r\n\x1a\n"
_JPEG = b"\xff\xd8\xff"


def embedded_logo(name: str, folder: Path) -> str:
    """Return the picture as a `data:` address.

    Parameters
    ----------
    name : str
        As written in the laboratory file: a file in or below its folder.
    folder : Path
        That folder.

    Raises
    ------
    DefinitionError
        When it leads out of the folder, is missing, too large, or no PNG or JPEG.
    """
    path = folder / name
    if not path.resolve().is_relative_to(folder.resolve()):
        raise _logo_problem(name, "lies outside the laboratory file's folder; put the logo beside the file")
    if not path.is_file():
        raise _logo_problem(name, "there is no such logo beside the laboratory file")
    with open_plain(path) as stream:
        data = stream.read(LOGO_BYTES + 1)
    if len(data) > LOGO_BYTES:
        raise _logo_problem(name, f"is larger than {LOGO_BYTES // 1000} kB; scale the logo down")
    if data.startswith(_PNG) and data[12:16] == b"IHDR":
        if max(int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")) > LOGO_PIXELS:
            raise _logo_problem(name, f"is wider or higher than {LOGO_PIXELS} pixels; scale the logo down")
        kind = "png"
    elif data.startswith(_JPEG):
        kind = "jpeg"
    else:
        raise _logo_problem(name, "is neither PNG nor JPEG; other formats can carry code")
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"


def _logo_problem(name: str, message: str) -> DefinitionError:
    return DefinitionError([Problem(name, 0, 0, message)])
