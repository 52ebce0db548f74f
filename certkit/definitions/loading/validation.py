"""From a YAML file's tree to a typed document, with every problem of the file in one error."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any, TypeVar

from pydantic import BaseModel, ValidationError

from certkit.definitions.loading.error_messages import problems
from certkit.definitions.loading.yaml_reader import Tree, read_tree
from certkit.errors import DefinitionError, Problem
from certkit.files.bounded import open_plain
from certkit.files.limits import MAX_DEFINITION_BYTES

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.definitions.channels import ChannelTable

D = TypeVar("D", bound=BaseModel)

Check = Callable[[Tree], list[Problem]]
"""Looks at a whole file for what no single value can show."""


def validate(
    tree: Tree,
    model: type[D],
    check: Check | None = None,
    channels: ChannelTable | None = None,
    data: Any = None,  # noqa: ANN401  # data with parts of the document
) -> D:
    """Make the document of a tree.

    Parameters
    ----------
    tree : Tree
        As read; its own problems are reported with the others.
    model : type
        The document's class.
    check : callable, optional
        Finds problems between values; runs also when single values are wrong.
    channels : ChannelTable, optional
        Channels that the file may name; the shipped legform's when missing.
    data : any, optional
        The tree's data with parts of the document in it that were made before, of the same data.

    Raises
    ------
    DefinitionError
        With all problems of the file, sorted by place.
    """
    found = list(tree.problems)
    document = data if isinstance(data, model) else None  # all of it was made before
    if document is None and data is not None:
        with suppress(ValidationError):  # which is told of the plain data, with its places
            document = model.model_validate(data, context={"channels": channels})
    if document is None:
        try:
            document = model.model_validate(tree.data, context={"channels": channels})
        except ValidationError as error:
            found += problems(error, tree, model)
    if check is not None:
        found += check(tree)
    if found or document is None:
        raise DefinitionError(list(dict.fromkeys(found)))
    return document


def read_document(path: Path, model: type[D], channels: ChannelTable | None = None) -> D:
    """Read a file that is no part of the library, such as a laboratory's or a case's.

    Raises
    ------
    DefinitionError
        When it is missing or cannot be read, and with all problems that it has.
    """
    return validate(read_tree(read_bytes(path), str(path)), model, channels=channels)


def read_bytes(path: Path) -> bytes:
    """Return a file's bytes, no more than show that it is too large; raise `DefinitionError` without them."""
    try:
        with open_plain(path) as stream:
            return stream.read(MAX_DEFINITION_BYTES + 1)
    except OSError as error:
        reason = {FileNotFoundError: "does not exist", IsADirectoryError: "is a folder"}.get(type(error))
        message = reason or f"cannot be read ({error.strerror})"
        raise DefinitionError([Problem(str(path), 0, 0, message)]) from None
