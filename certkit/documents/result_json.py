"""The result document as a file: one JSON, a line for each part and each criterion, always the same bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import ValidationError

from certkit.documents.result import Part, Result
from certkit.errors import DataError
from certkit.files import write_whole

if TYPE_CHECKING:
    from pathlib import Path

LARGEST = 200_000_000
"""Bytes; a test of 20 channels with 200,000 samples each takes 50 million."""


def to_json(result: Result) -> str:
    """Return the document as JSON text, in the schema's order, ending with a line feed.

    Numbers carry seven significant digits. Lists of objects have one object a line, everything else one
    line a part, so that the text can be read, searched and compared line by line though it holds whole
    channels.
    """
    lines = []
    for name in Result.model_fields:
        part = getattr(result, name)
        if isinstance(part, list) and part and isinstance(part[0], Part):
            rows = ",\n".join(f"    {row.model_dump_json()}" for row in part)
            lines.append(f'  "{name}": [\n{rows}\n  ]')
        else:
            lines.append(f"  {result.model_dump_json(include={name})[1:-1]}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def from_json(text: str | bytes, name: str = "result.json") -> Result:
    """Read a result document.

    Raises
    ------
    DataError
        When it is too large, no JSON, or no result of a schema that this version knows: says what and where.
    """
    if len(text) > LARGEST:
        raise DataError(f"{name}: {len(text)} bytes are more than a result document can have ({LARGEST})")
    try:
        return Result.model_validate_json(text)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        if first["type"] == "json_invalid":
            raise DataError(f"{name}: damaged: {first['msg']}; make it again with `certkit run`") from error
        place = ".".join(str(step) for step in first["loc"]) or "the document"
        more = f" (and {error.error_count() - 1} more)" if error.error_count() > 1 else ""
        raise DataError(f"{name}: not a certkit result: {place}: {first['msg']}{more}") from error


def write_result(result: Result, path: Path) -> None:
    """Write the document; nobody ever sees half of it."""
    write_whole(path, to_json(result))


def read_result(path: Path) -> Result:
    """Read the document from a file.

    Raises
    ------
    DataError
        When it is missing, cannot be read, or is damaged.
    """
    try:
        if path.stat().st_size > LARGEST:
            raise DataError(
                f"{path}: {path.stat().st_size} bytes are more than a result document can have ({LARGEST})"
            )
        content = path.read_bytes()
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read: {error.strerror}; name a result.json that `certkit run` wrote"
        ) from error
    return from_json(content, str(path))
