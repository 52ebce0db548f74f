"""The filters that a criterion can name, and that a recorded channel may have seen: one line each.

How they filter, and what they take a channel for before its first and after its last sample, stands in
`certkit.signals.cfc`. The two are apart because procedures are read and checked without filtering anything.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Literal

from msgspec import Struct


class FilterKind(Struct, frozen=True):
    """A channel frequency class of ISO 6487.

    Parameters
    ----------
    frequency_class : float
        Hz.
    letter : str
        The last letter of the ISO-MME code of a channel that has seen it; empty where it has none of its own.
    """

    frequency_class: float
    letter: str = ""


FILTERS = MappingProxyType(
    {
        "CFC 60": FilterKind(60.0, "D"),
        "CFC 180": FilterKind(180.0, "C"),
        "CFC 600": FilterKind(600.0, "B"),
        "CFC 1000": FilterKind(1000.0, "A"),
    }
)

if TYPE_CHECKING:
    Filter = str
else:
    Filter = Literal[("none", *FILTERS)]
