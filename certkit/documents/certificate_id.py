"""The certificate's id: a short hash of what the document says, without clock and machine."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.documents.result import Result

LEFT_OUT: dict[str, bool | set[str]] = {"id": True, "quality": {"solver_seconds"}, "provenance": {"packages"}}
LENGTH = 16
GROUP = 4


def canonical(result: Result) -> bytes:
    """Return the bytes that are hashed: JSON in the schema's order, without what depends on clock or machine.

    Left out are the id itself, the solver's time and the versions of other packages. Two runs with the same
    inputs and the same version of certkit have the same bytes. Fields with their default value are left out
    too, so that a later certkit, whose document has more fields, comes to the same id.
    """
    return result.model_dump_json(exclude=LEFT_OUT, exclude_defaults=True).encode()


def certificate_id(result: Result) -> str:
    """Return the id, such as `3F9A-1C07-8B2E-44D1`: the first 64 bits of a SHA-256."""
    digest = hashlib.sha256(canonical(result)).hexdigest()[:LENGTH].upper()
    return "-".join(digest[i : i + GROUP] for i in range(0, LENGTH, GROUP))


def with_id(result: Result) -> Result:
    """Return the result with its id filled in."""
    return result.model_copy(update={"id": certificate_id(result)})
