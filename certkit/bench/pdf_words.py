"""Words that a PDF holds outside its pages: properties, bookmarks, labels, what is read aloud, metadata."""

from __future__ import annotations

import re
import zlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

MOST_UNPACKED = 64_000_000
"""Bytes of unpacked objects that are looked through."""

_STREAM = re.compile(rb"stream\r?\n")
_BEGIN = re.compile(rb"\(|<<|<")
_PARENTHESIS = re.compile(rb"[()\\]")
_ESCAPED = re.compile(rb"\\([0-7]{1,3}|\r\n|.)", re.DOTALL)
_LETTERS = {
    b"n": b"\n",
    b"r": b"\r",
    b"t": b"\t",
    b"b": b"\b",
    b"f": b"\f",
    b"\n": b"",
    b"\r\n": b"",
    b"\r": b"",
}
_WRITERS_OWN = re.compile(rb"/(?:Producer|CreationDate|ModDate)\s*$")
_IDENTIFIER = re.compile(rb"/ID\s*\[\s*(?:(?:<[^>]*>|\((?:\\.|[^\\)])*\))\s*){2}\]", re.DOTALL)
"""What every program that writes a file puts there by itself."""

_XML_OWN = re.compile(
    r"<(\w+:(?:Producer|CreatorTool|\w+Date|\w*ID))\b[^>]*>[^<]*</\1>|\s(?:xmlns:|rdf:)\w+=\S+"
)
_XML_WORDS = re.compile(r">([^<]+)<|=\"([^\"]*)\"")
_WORD = re.compile(r"[^\W\d_]{2}")


def plain_objects(content: bytes) -> bytes:
    """Return all dictionaries of a file: those between its streams, and those packed in object streams."""
    joined = b"\n".join(part for part, is_metadata in _parts(content) if not is_metadata)
    return re.sub(rb"#([0-9A-Fa-f]{2})", lambda found: bytes([int(found[1], 16)]), joined)


def words_outside_pages(content: bytes) -> frozenset[str]:
    """Return every text that stands in a dictionary or in the metadata, but what each writer puts there."""
    found: set[str] = set()
    for part, is_metadata in _parts(content):
        if is_metadata:
            text = _XML_OWN.sub("", part.decode("utf-8", errors="replace"))
            found |= {" ".join((match[1] or match[2] or "").split()) for match in _XML_WORDS.finditer(text)}
        else:
            found |= {_decoded(string) for string in _strings(part)}
    return frozenset(text for text in found if _WORD.search(text))


def _parts(content: bytes) -> Iterator[tuple[bytes, bool]]:
    """Yield what is between the streams, what is packed in object streams, and metadata (then True)."""
    place, room = 0, MOST_UNPACKED
    for match in _STREAM.finditer(content):
        if match.start() < place:
            continue
        head = content[place : match.start()]
        yield head, False
        end = content.find(b"endstream", match.end())
        end = len(content) if end < 0 else end
        tail = head[head.rfind(b" obj") :][-2000:]
        metadata = b"/Metadata" in tail and b"/Catalog" not in tail
        if (b"/ObjStm" in tail or metadata) and room > 0:
            data = content[match.end() : end]
            unpacked = _inflated(data, room) if b"/FlateDecode" in tail else data
            room -= len(unpacked)
            yield unpacked, metadata
        place = end + len(b"endstream")
    yield content[place:], False


def _strings(part: bytes) -> Iterator[bytes]:
    """Yield the strings of some dictionaries, as they are written between their marks."""
    part = _IDENTIFIER.sub(b"", part)
    place = 0
    for match in _BEGIN.finditer(part):
        if match.start() < place or match[0] == b"<<":
            continue
        if match[0] == b"<":
            place = part.find(b">", match.end())
            place = len(part) if place < 0 else place + 1
            digits = re.sub(rb"[^0-9A-Fa-f]", b"", part[match.end() : place])
            string = bytes.fromhex((digits + b"0" * (len(digits) % 2)).decode())
        else:
            place = _end(part, match.end())
            string = _ESCAPED.sub(_unescaped, part[match.end() : place - 1])
        if not _WRITERS_OWN.search(part[max(0, match.start() - 40) : match.start()]):
            yield string


def _end(part: bytes, place: int) -> int:
    """Return where a string ends whose opening parenthesis is just before a place."""
    depth = 1
    while depth:
        found = _PARENTHESIS.search(part, place)
        if found is None:
            return len(part) + 1
        place = found.end() + (found[0] == b"\\")
        depth += {b"(": 1, b")": -1}.get(found[0], 0)
    return place


def _unescaped(found: re.Match[bytes]) -> bytes:
    mark = found[1]
    if mark[:1].isdigit():
        return bytes([int(mark, 8) & 0xFF])
    return _LETTERS.get(mark, mark)


def _decoded(string: bytes) -> str:
    if string.startswith(b"\xfe\xff"):
        return string[2:].decode("utf-16-be", errors="replace")
    if string.startswith(b"\xef\xbb\xbf"):
        return string[3:].decode("utf-8", errors="replace")
    return string.decode("latin-1")


def _inflated(data: bytes, most: int) -> bytes:
    try:
        return zlib.decompressobj().decompress(data, most)
    except zlib.error:
        return b""
