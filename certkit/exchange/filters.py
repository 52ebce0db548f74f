"""Filter classes: the letter at the end of an ISO-MME code and the words of the procedures."""

from __future__ import annotations

from types import MappingProxyType

FILTER_OF_LETTER = MappingProxyType(
    {"0": "", "P": "", "Q": "", "A": "CFC 1000", "B": "CFC 600", "C": "CFC 180", "D": "CFC 60"}
)
LETTER_OF_FILTER = MappingProxyType({"": "0", "CFC 1000": "A", "CFC 600": "B", "CFC 180": "C", "CFC 60": "D"})
