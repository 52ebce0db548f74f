"""What definitions there are, by kind and name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.definitions.loading.kinds import KINDS, Kind, kind_of
from certkit.definitions.loading.library import find, names
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.errors import DefinitionError

if TYPE_CHECKING:
    from certkit.definitions.loading.library import Library


class CatalogueEntry(Struct, frozen=True):
    """One definition of the library.

    Parameters
    ----------
    kind, name : str
        What it is named by.
    title : str
        In its own words; says so when the file has errors.
    path : str
        Shipped name or the user's path.
    """

    kind: str
    name: str
    title: str
    path: str


def catalogue(kind: str | None = None, library: Library = ()) -> list[CatalogueEntry]:
    """List the definitions of one kind, or of all, by kind and name."""
    kinds = [known for known in KINDS.values() if known.folder] if kind is None else [kind_of(kind)]
    return [_entry(known, name, library) for known in kinds for name in names(known.word, library)]


def _entry(kind: Kind, name: str, library: Library) -> CatalogueEntry:
    found = find(kind, name, library)
    try:
        title = str(read_tree(found.data, found.file).data.get("title", ""))
    except DefinitionError:
        title = f"(cannot be read; run `certkit validate {found.file}`)"
    return CatalogueEntry(kind.word, name, title, found.label)
