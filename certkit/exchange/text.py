"""Text of unknown encoding: a ladder of encodings, and a clear word when a file mixes two."""

from __future__ import annotations

import codecs
import re

from certkit.errors import DataError
from certkit.files.limits import MAX_LINES, MAX_TEXT_BYTES, MEGABYTE
from certkit.plain_text import odd_character

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def decode(data: bytes, place: str) -> tuple[str, str]:
    r"""Decode a text file.

    The ladder: a byte order mark decides; else plain ASCII; else UTF-8; else Windows-1252, which reads the
    text of ISO 8859-1 as well.

    Returns
    -------
    (str, str)
        The text with `\\n` line ends, and the encoding found.

    Raises
    ------
    DataError
        For binary content, and where lines of two encodings stand in one file.
    """
    if len(data) > MAX_TEXT_BYTES or data.count(b"\n") + data.count(b"\r") > 2 * MAX_LINES:
        raise DataError(
            f"{place}: more than {MAX_LINES} lines or {MAX_TEXT_BYTES // MEGABYTE} MB of text are refused; "
            "cut the recording to the test"
        )
    found = next((name for mark, name in _MARKS if data.startswith(mark)), None)
    if found is None and b"\0" in data:
        line = data[: data.index(b"\0")].count(b"\n") + 1
        raise DataError(
            f"{place}:{line}: a zero byte; this is no text file; name the table that was exported from it"
        )
    if found is None:
        found = "ascii" if data.isascii() else "utf-8"
    try:
        text = data.decode(found)
    except UnicodeDecodeError as error:
        if found != "utf-8":
            line = data[: error.start].count(b"\n") + 1
            raise DataError(
                f"{place}:{line}: not {found} text, as the start of the file says; save it again "
                "in one encoding"
            ) from error
        text, found = _windows(data, place), "cp1252"
    text = _with_plain_line_ends(text).removesuffix("\x1a")  # DOS ends a file so
    odd = odd_character(text)
    if odd is not None:
        line = text[: text.index(odd)].count("\n") + 1
        raise DataError(
            f"{place}:{line}: the control character U+{ord(odd):04X}, which hides columns; remove it"
        )
    return text, found


def _with_plain_line_ends(text: str) -> str:
    r"""Bring line ends to `\\n`: of DOS, of old Macs, and `\\r\\r\\n` of files translated twice."""
    if "\r" not in text:
        return text
    return re.sub(r"\r+\n", "\n", text).replace("\r", "\n")


def _windows(data: bytes, place: str) -> str:
    """Decode as Windows-1252 after making sure that no line is UTF-8."""
    for number, line in enumerate(data.split(b"\n"), 1):
        if line.isascii():
            continue
        try:
            line.decode("utf-8")
        except UnicodeDecodeError:
            continue
        raise DataError(
            f"{place}:{number}: UTF-8 here, another encoding elsewhere in the file; save it in one encoding"
        )
    try:
        return data.decode("cp1252")
    except UnicodeDecodeError as error:
        line_number = data[: error.start].count(b"\n") + 1
        raise DataError(
            f"{place}:{line_number}: neither UTF-8 nor Windows-1252 text; save it as UTF-8"
        ) from error
