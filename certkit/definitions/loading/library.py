"""Find a definition by its name or path, change values in it, and read it into its typed document.

Names are looked for in the folders given with `--library`, in the given order, then among those that come
with certkit. A path (anything with a folder or an ending in it) is read as it stands.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Generic, Literal, TypeVar, cast, overload

from msgspec import Struct
from msgspec.structs import replace
from pydantic import BaseModel

from certkit.definitions.loading.confirmed import confirmation_name, with_confirmation
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.kinds import KINDS, Kind, kind_of, refuse_another_kind
from certkit.definitions.loading.made_before import keep, with_made
from certkit.definitions.loading.old_forms import modernised
from certkit.definitions.loading.overrides import Change, Overrides, change
from certkit.definitions.loading.search_path import (
    DefinitionStore,
    FolderStore,
    Found,
    RememberedStore,
    is_name,
    is_path,
    shipped_store,
    shown_path,
)
from certkit.definitions.loading.validation import read_bytes, validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.errors import DefinitionError, OldFormWarning, UsageError

if TYPE_CHECKING:
    from certkit.definitions.calibration import CalibrationTask
    from certkit.definitions.confirmation import Confirmation
    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.extraction_case import Case
    from certkit.definitions.legform import Legform
    from certkit.definitions.legform_family import Family
    from certkit.definitions.procedure import Procedure
    from certkit.definitions.reference import Reference
    from certkit.definitions.study import Study
    from certkit.definitions.vehicle import Vehicle

D_co = TypeVar("D_co", bound=BaseModel, covariant=True)

Library = str | Path | Sequence[str | Path | DefinitionStore]
"""Folders with own definitions, one or several; searched before the shipped ones, in this order."""


class Loaded(Struct, Generic[D_co], frozen=True):
    """A definition with where it came from.

    Parameters
    ----------
    kind, name : str
        Such as `legform`, `flex-pli-gtr`.
    document : BaseModel
        The typed document, after `overrides`.
    path : str
        The shipped name or the user's path; never absolute, so that it can stand in a result.
    sha256, text : str
        Hash and text of the file as it is, before `overrides`.
    overrides : tuple of Change
        Values that were changed.
    remarks : tuple of str
        Old forms and paths that were read, and what to write instead; confirmations that hold no longer.
    confirmation : Loaded, optional
        By which numbers of it are verified.
    """

    kind: str
    name: str
    document: D_co
    path: str
    sha256: str
    text: str
    overrides: tuple[Change, ...] = ()
    remarks: tuple[str, ...] = ()
    confirmation: Loaded[Confirmation] | None = None


@overload
def load(
    kind: Literal["procedure"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[Procedure]: ...
@overload
def load(
    kind: Literal["corridors"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[CorridorSet]: ...
@overload
def load(
    kind: Literal["legform"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[Legform]: ...
@overload
def load(
    kind: Literal["vehicle"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[Vehicle]: ...
@overload
def load(
    kind: Literal["reference"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[Reference]: ...
@overload
def load(
    kind: Literal["family"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[Family]: ...
@overload
def load(
    kind: Literal["case"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[Case]: ...
@overload
def load(
    kind: Literal["study"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[Study]: ...
@overload
def load(
    kind: Literal["fit"], name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[CalibrationTask]: ...
@overload
def load(
    kind: str, name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[BaseModel]: ...


def load(
    kind: str, name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Loaded[BaseModel]:
    """Load one definition.

    Parameters
    ----------
    kind : str
        Its kind: `procedure`, `corridors`, `legform`, `vehicle`, `reference`.
    name : str or Path
        A name that the library knows, or a path.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first, in order.
    overrides : mapping, optional
        Values to change by their paths, such as `{"rig.hinge.offset": "30 mm"}`; a path starts inside this
        definition.

    Returns
    -------
    Loaded

    Raises
    ------
    UsageError
        When there is no such definition (names the nearest one), or a change does not fit.
    DefinitionError
        With all problems of the file.
    """
    known = kind_of(kind)
    found = find(known, name, library)
    return _with_its_confirmation(parse(known, found, overrides, library), library)


def _with_its_confirmation(loaded: Loaded[BaseModel], library: Library) -> Loaded[BaseModel]:
    """Let the numbers that a library's confirmation covers carry the text that was read."""
    kind = KINDS["confirmation"]
    name = confirmation_name(loaded.kind, loaded.name)
    found = next((found for store in own_stores(library) if (found := store.find(kind, name))), None)
    if found is None or loaded.kind == kind.word:
        return loaded
    confirmation = parse(kind, found)
    document, lost = with_confirmation(loaded.document, cast("Confirmation", confirmation.document))
    return replace(
        loaded,
        document=document,
        remarks=(*loaded.remarks, *lost),
        confirmation=cast("Loaded[Confirmation]", confirmation),
    )


def parse(
    kind: Kind, found: Found, overrides: Overrides | None = None, library: Library = ()
) -> Loaded[BaseModel]:
    """Read a found definition; see `load`."""
    model = kind.model
    tree = read_tree(found.data, found.file)
    refuse_another_kind(kind, tree)
    tree, overrides, remarks = modernised(kind, tree, overrides)
    tree, changes = change(tree, overrides, model, kind.prefix)
    numbered = tuple(entry.remark for entry in changes if entry.remark)
    for remark in numbered:
        warnings.warn(remark, OldFormWarning, stacklevel=2)
    check = kind.check
    document = validate(
        tree,
        model,
        partial(check, library=library) if check else None,
        data=with_made(kind.word, found, tree.data),
    )
    keep(kind.word, found, tree.data, document, changed=bool(changes))
    own = getattr(document, kind.word)
    if kind.word != "laboratory" and not is_name(own):
        # Folders and files are called after it, so it must not lead to any other.
        message = f"`{own}` is no name; use letters, digits, spaces, `-`, `.`"
        raise DefinitionError([tree.problem((kind.word,), message)])
    if found.name is not None and getattr(document, kind.word) != found.name:
        message = f"the file is called `{found.name}`, so its `{kind.word}` has to be `{found.name}` too"
        raise DefinitionError([tree.problem((kind.word,), message)])
    return Loaded(
        kind=kind.word,
        name=getattr(document, kind.word),
        document=document,
        path=found.label,
        sha256=found.sha256,
        text=found.text,
        overrides=changes,
        remarks=(*remarks, *numbered),
    )


def find(kind: Kind, name: str | Path, library: Library = ()) -> Found:
    """Find a definition's file without reading it into a document; see `load`."""
    path = Path(name)
    if isinstance(name, Path) or is_path(name):
        return Found(shown_path(path), read_bytes(path), str(path))
    searched = search_order(library)
    for store in searched:
        found = store.find(kind, str(name))
        if found is not None:
            return found
    names = {known for store in searched for known in store.names(kind)}
    others = [
        other.noun
        for other in KINDS.values()
        if other.folder and any(store.find(other, str(name)) is not None for store in searched)
    ]
    if others:
        raise UsageError(
            f"`{name}` is a {' and a '.join(others)}, no {kind.noun}; {suggestion(str(name), names)}"
        )
    hint = f"; to read the file, write ./{name}" if path.exists() else ""
    raise UsageError(f"there is no {kind.noun} `{name}`; {suggestion(str(name), names)}{hint}")


def search_order(library: Library = ()) -> list[DefinitionStore]:
    """Return the stores that names are looked for in, first to last; see `own_stores`."""
    own, shipped = own_stores(library), shipped_store()
    last = own[-1] if own else None
    known = isinstance(last, RememberedStore) and last.store == shipped
    return own if known else [*own, shipped]


def own_stores(library: Library = ()) -> list[DefinitionStore]:
    """Return the stores of a library.

    Raises
    ------
    UsageError
        When a library folder does not exist.
    """
    own = stores(library)
    for entry in own:
        if isinstance(entry, Path) and not entry.is_dir():
            raise UsageError(f"the library `{entry}` is no folder; check the path")
    known: list[DefinitionStore] = [
        FolderStore(entry, shown_path(entry)) if isinstance(entry, Path) else entry for entry in own
    ]
    for store in known:
        if isinstance(store, FolderStore) and not store.holds_something():
            raise UsageError(
                f"the library `{store.folder}` holds no definitions; name the folder that has `procedures/`, "
                "`corridors/` or `models/` in it, or the files themselves"
            )
    return known


def stores(library: Library) -> tuple[Path | DefinitionStore, ...]:
    """Return the places of a library: one folder is a library too, and strings are paths."""
    entries = (library,) if isinstance(library, (str, Path)) else library
    return tuple(Path(entry) if isinstance(entry, str) else entry for entry in entries)


def folders_of(library: str | Path | Sequence[str | Path]) -> list[Path]:
    """Return the folders of a library that has nothing but folders."""
    return [Path(each) for each in ([library] if isinstance(library, (str, Path)) else library)]


def names(kind: str, library: Library = ()) -> list[str]:
    """Return the names of all definitions of a kind, sorted."""
    known = kind_of(kind)
    return sorted({name for store in search_order(library) for name in store.names(known)})


def neighbours(path: Path) -> list[DefinitionStore]:
    """Return the stores beside a file named by its path: its folder, and the library that it is part of."""
    folder = path.parent
    homes = [Path(kind.folder) for kind in KINDS.values() if kind.lives_in(folder)]
    roots = [folder, *(folder.parents[len(home.parts) - 1] for home in homes)]
    return [FolderStore(root, shown_path(root)) for root in roots]
