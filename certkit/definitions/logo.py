"""A laboratory's logo: a picture beside its file, checked and turned into text that a page can embed."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

from certkit.errors import DefinitionError, Problem

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES = 300_000
MAX_PIXELS = 4_000

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
        raise _problem(name, "lies outside the laboratory file's folder; put the logo beside the file")
    if not path.is_file():
        raise _problem(name, "there is no such logo beside the laboratory file")
    with path.open("rb") as stream:
        data = stream.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise _problem(name, f"is larger than {MAX_BYTES // 1000} kB; scale the logo down")
    if data.startswith(_PNG) and data[12:16] == b"IHDR":
        if max(int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")) > MAX_PIXELS:
            raise _problem(name, f"is wider or higher than {MAX_PIXELS} pixels; scale the logo down")
        kind = "png"
    elif data.startswith(_JPEG):
        kind = "jpeg"
    else:
        raise _problem(name, "is neither PNG nor JPEG; other formats can carry code")
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"


def _problem(name: str, message: str) -> DefinitionError:
    return DefinitionError([Problem(name, 0, 0, message)])
