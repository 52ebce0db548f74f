"""Names that look like others: letters of another script, other case, other marks between the words."""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

LETTERS = str.maketrans(
    "авекмнорстухіјѕԁһӏԛԝ" + "αβεικνορτυχ" + "01ı",  # Cyrillic, Greek
    "abekmhopctyxijsdhlqw" + "abeikvoptyx" + "oli",
)
"""Letters and digits that are drawn, or nearly, as the Latin letters below them."""


def skeleton(name: str) -> str:
    """Return what is left of a name when what looks alike is the same."""
    plain = unicodedata.normalize("NFKD", name).casefold().translate(LETTERS).replace("l", "i")
    return "".join(mark for mark in plain if mark.isalnum())


def look_alike(name: str, known: Iterable[str]) -> str | None:
    """Return the known name that another one looks like, if it is not that very name."""
    mine = skeleton(name)
    return next((each for each in known if each != name and skeleton(each) == mine), None)
