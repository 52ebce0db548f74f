"""Reference data: measured or computed values that a result is compared with, such as the paper's Table 1."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from certkit.definitions.base import Sourced


class Reference(Sourced):
    """Values by criterion id. The error rule is (simulation − test) / test."""

    reference: Annotated[str, Field(description="Its name.")]
    title: str
    values: Annotated[
        dict[str, str], Field(min_length=1, description="Quantity by criterion id, such as `F3: 81 N·m`.")
    ]
    published: Annotated[
        dict[str, str], Field(description="Another simulation's values beside them, for the same criteria.")
    ] = {}
    notes: list[str] = []

    def lines(self) -> dict[str, str]:
        """Return each value, with the published simulation's beside it."""
        return {
            f"values.{name}": f"{value} (published: {self.published[name]})"
            if name in self.published
            else value
            for name, value in self.values.items()
        }
