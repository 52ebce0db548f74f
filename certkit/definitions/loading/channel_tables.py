"""Channel tables of legforms: of the one that is named, of the shipped one, of all that a library has."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from certkit.definitions.loading.library import load, names
from certkit.errors import CertkitError

if TYPE_CHECKING:
    from pydantic import ValidationInfo

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.loading.library import Library

DEFAULT_LEGFORM = "flex-pli-gtr"
"""The legform whose channels are meant where nothing names one."""


@cache
def default_channels() -> ChannelTable:
    """Return the channel table of the shipped legform."""
    return load("legform", DEFAULT_LEGFORM).document.channel_table


def known_channels(library: Library = ()) -> tuple[ChannelTable, ...]:
    """Return the channel tables of all legforms, the shipped one first, one for each set of channels.

    Legforms that cannot be read are passed over here; whoever names one is told why.
    """
    found = [load("legform", DEFAULT_LEGFORM, library=library).document.channel_table]
    for name in names("legform", library):
        try:
            table = load("legform", name, library=library).document.channel_table
        except CertkitError:
            continue
        if all((table.impactor, table.kinds) != (other.impactor, other.kinds) for other in found):
            found.append(table)
    return tuple(found)


def all_channels(library: Library = ()) -> ChannelTable:
    """Return the channels of all legforms in one table, for files that may be of any of them."""
    tables = known_channels(library)
    kinds = {name: kind for table in reversed(tables) for name, kind in table.kinds.items()}
    return replace(tables[0], kinds=kinds)


def legform_channels(name: object, library: Library = ()) -> ChannelTable:
    """Return the channel table of a legform by its name; the shipped one's where there is no such legform.

    Whoever needs the legform itself is told what is wrong with its name.
    """
    if not isinstance(name, str):
        return default_channels()
    try:
        return load("legform", name, library=library).document.channel_table
    except CertkitError:
        return default_channels()


def channels_in(info: ValidationInfo) -> ChannelTable:
    """Return the table that a document is validated with: of the context, else the shipped legform's."""
    context: Any = info.context
    table: ChannelTable | None = (context or {}).get("channels")
    return table or default_channels()
