"""Several things wrong inside one value, each with the steps that lead from the value to it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

Steps = tuple[str | int, ...]
"""Keys and indices that lead through a document to a value."""

Fault = tuple[Steps, str]
"""Where, seen from the value, and what is wrong and what to do."""


class Faults(ValueError):  # noqa: N818  # several at once
    """Raised inside a pydantic validator; `loading.error_messages` gives each fault its place."""

    def __init__(self, faults: Sequence[Fault]) -> None:
        """Keep the faults."""
        self.faults = tuple(faults)
        super().__init__("; ".join(message for _, message in faults))
