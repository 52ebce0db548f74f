"""Look a definition file over: all that is wrong with it, and with what it names."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from certkit.definitions.legform import Legform
from certkit.definitions.loading.catalogue import catalogue
from certkit.definitions.loading.cross_references import disagreements
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.kinds import KINDS, Kind
from certkit.definitions.loading.library import find, neighbours, stores
from certkit.definitions.loading.old_forms import modernised
from certkit.definitions.loading.search_path import Found
from certkit.definitions.loading.validation import read_bytes, validate
from certkit.definitions.loading.yaml_reader import Tree, read_tree
from certkit.definitions.procedure import Procedure
from certkit.errors import DefinitionError, Problem

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.definitions.loading.library import Library

Surveyed = tuple[str, list[Problem]]
"""A file and what is wrong with it."""


def survey(path: Path, library: Library = ()) -> Surveyed:
    """Check a file of any kind; its keys tell which kind it is. What it names may lie beside it."""
    try:
        data = read_bytes(path)
    except DefinitionError as error:
        return str(path), error.problems
    return _survey(Found(path.name, data, str(path)), None, [*stores(library), *neighbours(path)])


def other_name(path: Path) -> str:
    """Return what a file that is found by its name calls itself, where that is another name; else nothing."""
    tree = read_tree(read_bytes(path), str(path))
    kind = kind_in(tree)
    said = str(tree.data[kind.word])
    return said if kind.folder and said != path.stem else ""


def survey_all(library: Library = ()) -> list[Surveyed]:
    """Check everything the library has."""
    found = [
        (KINDS[entry.kind], find(KINDS[entry.kind], entry.name, library))
        for entry in catalogue(None, library)
    ]
    return [_survey(item, kind, library) for kind, item in found]


def kind_in(tree: Tree) -> Kind:
    """Return the kind that a file says it is.

    Raises
    ------
    DefinitionError
        When it has none of the keys that a definition starts with.
    """
    for key in tree.data:
        if key in KINDS:
            return KINDS[key]
    first = next(iter(tree.data), "")
    message = f"`{first}` is no kind of definition; {suggestion(first, list(KINDS))}"
    raise DefinitionError([*tree.problems, tree.problem((first,), message, key=True)])


def _survey(found: Found, kind: Kind | None, library: Library) -> Surveyed:
    try:
        tree = read_tree(found.data, found.file)
        known = kind or kind_in(tree)
        tree, _, _ = modernised(known, tree)
        check = known.check
        document = validate(tree, known.model, partial(check, library=library) if check else None)
    except DefinitionError as error:
        return found.file, error.problems
    if isinstance(document, Legform):
        return found.file, _unspread(document, tree)
    if not isinstance(document, Procedure):
        return found.file, []
    return found.file, disagreements(document, tree, library)


def _unspread(legform: Legform, tree: Tree) -> list[Problem]:
    """Return the parts of a legform whose mass no bar with masses at its ends has."""
    faults = {part: bone.spread_fault() for part, bone in legform.parts.items()}
    return [
        tree.problem(("parts", part, "inertia"), f"{part}: {fault}")
        for part, fault in faults.items()
        if fault
    ]
