"""The certificate's id: a short hash of what the document says, without clock and machine."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from certkit.grading.result import Result

LENGTH = 16
GROUP = 4


def canonical(result: Result) -> bytes:
    """Return the bytes that are hashed: the JSON with sorted keys, without id, solver time and package versions.

    Two runs with the same inputs and the same version of certkit have the same bytes.
    """
    tree: dict[str, Any] = json.loads(result.model_dump_json())
    del tree["id"]
    del tree["provenance"]["packages"]
    if tree["quality"] is not None:
        del tree["quality"]["solver_seconds"]
    return json.dumps(tree, sort_keys=True, ensure_ascii=False, separators=(",", ":")).encode()


def certificate_id(result: Result) -> str:
    """Return the id, such as `3F9A-1C07-8B2E-44D1`: the first 64 bits of a SHA-256."""
    digest = hashlib.sha256(canonical(result)).hexdigest()[:LENGTH].upper()
    return "-".join(digest[i : i + GROUP] for i in range(0, LENGTH, GROUP))


def with_id(result: Result) -> Result:
    """Return the result with its id filled in."""
    return result.model_copy(update={"id": certificate_id(result)})
