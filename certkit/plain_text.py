"""Characters that no text from a file may bring along: they steer terminals, break XML or hide things."""

from __future__ import annotations

import re

_CONTROL = "\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f"  # all but tab and line ends: terminals obey them
_DIRECTION = "\u200e\u200f\u202a-\u202e\u2066-\u2069"  # turn the direction of reading
_NO_TEXT = "\ud800-\udfff\ufffe\uffff"  # no characters of XML
_ODD = re.compile(f"[{_CONTROL}{_DIRECTION}{_NO_TEXT}]")

_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|.)")


def odd_character(text: str) -> str | None:
    """Return the first character of a text that has no place in one; None where all is plain."""
    if text.isprintable():
        return None  # as nearly all is, and known in a third of the time
    found = _ODD.search(text)
    return None if found is None else found.group()


def odd_character_in_json(text: str) -> str | None:
    """Return the same for JSON, in which such a character may stand as an escape (a pair may be emoji)."""
    if "\\u" in text:
        codes = (int(code, 16) for code in _ESCAPE.findall(text) if code)
        for code in codes:
            if not 0xD800 <= code < 0xE000 and (odd := odd_character(chr(code))):
                return odd
    return odd_character(text.replace("\n", ""))


def without_odd_characters(text: str) -> str:
    """Return a text with `\N{REPLACEMENT CHARACTER}` for every such character."""
    return _ODD.sub("\N{REPLACEMENT CHARACTER}", text)
