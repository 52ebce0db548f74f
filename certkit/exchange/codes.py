"""Channel codes: from the sixteen characters of ISO/TS 13499 to a channel of a legform and back."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.definitions.channel_mapping import Condition, Mapping, MmeTable
from certkit.definitions.filters import FILTERS
from certkit.definitions.loading.channel_tables import default_channels
from certkit.definitions.loading.validation import validate
from certkit.definitions.loading.yaml_reader import read_tree

FILTER_OF_LETTER = MappingProxyType(
    {"0": "", "P": "", "Q": "", **{kind.letter: words for words, kind in FILTERS.items() if kind.letter}}
)
"""Filter that the last letter of a code stands for."""

LETTER_OF_FILTER = MappingProxyType(
    {"": "0", **{words: kind.letter for words, kind in FILTERS.items() if kind.letter}}
)
"""And back; any other filter is written as `S`."""

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from certkit.definitions.channels import ChannelTable


class CodeTable(Struct, frozen=True):
    """Codes of a legform and of the rig, with a laboratory's own entries laid over them.

    Parameters
    ----------
    codes : dict of str to tuple of str
        Patterns by channel; the first is the one that is written.
    signs : dict of str to int
        Polarity by channel where it is turned.
    conditions : dict of str to Condition
        By the word of the condition.
    """

    codes: dict[str, tuple[str, ...]]
    signs: dict[str, int]
    conditions: dict[str, Condition]

    def channel(self, code: str) -> str | None:
        """Return the channel's short name for a code, or None when the code is of something else."""
        return next((name for name, known in self.codes.items() if any(_fits(p, code) for p in known)), None)

    def code(self, name: str, filtered: str) -> str:
        """Return the code under which a channel with this filter state is written."""
        own = self.codes[name][0].replace("?", "0")
        return own[:-1] + LETTER_OF_FILTER.get(filtered, "S")


def table_of_codes(codes: Iterable[str], tables: Sequence[ChannelTable]) -> ChannelTable:
    """Return the legform that most of the codes belong to, by their fine location 3; the first of equals."""
    seen = [code[10:12] for code in codes]
    return max(tables, key=lambda table: seen.count(table.fine_location))


def _fits(pattern: str, code: str) -> bool:
    """Tell whether a pattern, with `?` for any character, fits a code."""
    return len(pattern) == len(code) and all(p in {"?", c} for p, c in zip(pattern, code, strict=True))


@cache
def shipped_table() -> Mapping:
    """Read the shipped table of conditions."""
    source = files("certkit.exchange") / "condition-descriptors.yaml"
    return validate(read_tree(source.read_bytes(), source.name), Mapping)


def code_table(mapping: Mapping | None = None, channels: ChannelTable | None = None) -> CodeTable:
    """Lay a laboratory's entries over those of a legform and of the rig; the laboratory's win.

    Parameters
    ----------
    mapping : Mapping, optional
        The laboratory's.
    channels : ChannelTable, optional
        The legform's; those of the shipped one when missing.
    """
    table = channels or default_channels()
    shipped, own = shipped_table().mme, mapping.mme if mapping else MmeTable()
    known = {kind.name: kind.codes for kind in table.kinds.values() if kind.codes}
    codes: dict[str, tuple[str, ...]] = {}
    for entries in (own.codes, known):
        for name, patterns in entries.items():
            located = (pattern.replace("##", table.fine_location) for pattern in patterns)
            codes[name] = (*codes.get(name, ()), *located)
    return CodeTable(codes, {**shipped.signs, **own.signs}, {**shipped.conditions, **own.conditions})
