"""A laboratory's file, and the one that it shares with other tests, read together."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from pydantic import ValidationError

from certkit.bench.laboratory_logo import embedded_logo
from certkit.definitions.laboratory import Laboratory
from certkit.definitions.loading.validation import read_bytes, validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.result import InputFile
from certkit.errors import DefinitionError, Problem

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.definitions.channels import ChannelTable

ROLE = "laboratory"
"""Of both files among a result's inputs, the shared one first."""


class LaboratoryFiles(Struct, frozen=True):
    """What a laboratory's file says, together with the one that it shares; its logo; the files themselves."""

    laboratory: Laboratory
    logo: str | None
    inputs: tuple[InputFile, ...]


def read_files(path: Path, channels: ChannelTable | None = None) -> LaboratoryFiles:
    """Read a laboratory's file, and the one that it names as `shared`.

    Raises
    ------
    DefinitionError
        With all problems of a file; also when its logo, or the shared file, cannot be used.
    """
    own = _input(path)
    inputs = [own]
    alone = validate(read_tree(own.text or "", path.name), Laboratory, channels=channels)
    if alone.shared is not None:
        beside = path.parent / alone.shared
        shared = _input(beside)
        common = validate(read_tree(shared.text or "", beside.name), Laboratory, channels=channels)
        if common.shared is not None:
            raise DefinitionError(
                [
                    Problem(
                        beside.name,
                        0,
                        0,
                        "is shared by tests, and cannot share another file itself; write both into one",
                    )
                ]
            )
        inputs.insert(0, shared)
    laboratory = laboratory_of(inputs, channels)
    logo = embedded_logo(laboratory.logo, path.parent) if laboratory.logo else None
    return LaboratoryFiles(laboratory, logo, tuple(inputs))


def laboratory_of(inputs: Sequence[InputFile], channels: ChannelTable | None = None) -> Laboratory:
    """Return what the texts of a laboratory's files say together, the shared one first.

    Raises
    ------
    DefinitionError
        With all problems.
    """
    if len(inputs) == 1:
        return validate(read_tree(inputs[0].text or "", inputs[0].path), Laboratory, channels=channels)
    data: dict[str, Any] = {}
    for item in inputs:
        data = _joined(data, read_tree(item.text or "", item.path).data)
    data.pop("shared", None)
    try:
        return Laboratory.model_validate(data, context={"channels": channels})
    except ValidationError as error:
        names = " with ".join(item.path for item in reversed(inputs))
        said = error.errors(include_url=False)[0]["msg"].removeprefix("Value error, ")
        raise DefinitionError([Problem(names, 0, 0, said)]) from None


def _joined(shared: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
    """Join lists and mappings of two files; anything else is the second one's."""
    found = dict(shared)
    for key, value in own.items():
        before = shared.get(key)
        if isinstance(before, list) and isinstance(value, list):
            found[key] = [*before, *value]
        elif isinstance(before, dict) and isinstance(value, dict):
            found[key] = {**before, **value}
        else:
            found[key] = value
    return found


def _input(path: Path) -> InputFile:
    data = read_bytes(path)
    read_tree(data, path.name)  # refuses what is not UTF-8, with its line
    digest = hashlib.sha256(data).hexdigest()
    return InputFile(role=ROLE, path=path.name, sha256=digest, text=data.decode("utf-8-sig"))
