"""A family of legs: many sets of numbers for one legform, each of which passes the certification tests.

The tests do not determine the leg. A prediction over a family says how much of a value is the leg's own
freedom.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from certkit.definitions.base import Document, Section


class Member(Document):
    """One leg of the family: what it has different from the base legform."""

    id: str
    values: Annotated[
        dict[str, str],
        Field(min_length=1, description="Quantity by its path in the legform: `parts.femur.length`."),
    ]
    rigs: Annotated[
        dict[str, dict[str, str]],
        Field(
            description="By procedure, what its rig has different: `rig.hinge.offset`, which no text gives."
        ),
    ] = {}

    def overrides(self, procedure: str) -> dict[str, str]:
        """Return what the member changes in a procedure: value by path."""
        own = {f"legform.{path}": value for path, value in self.values.items()}
        return own | self.rigs.get(procedure, {})


class Family(Section):
    """Legs that all pass the same procedures, each as changes of one base legform."""

    family: Annotated[str, Field(description="Its name: by custom the base legform's.")]
    title: str
    legform: Annotated[str, Field(description="Name of the base legform.")]
    procedures: Annotated[list[str], Field(description="What every member was shown to pass.")] = []
    members: Annotated[list[Member], Field(min_length=2, max_length=10_000)]

    @model_validator(mode="after")
    def _distinct(self) -> Family:
        ids = [member.id for member in self.members]
        twice = sorted({name for name in ids if ids.count(name) > 1})
        if twice:
            raise ValueError(f"two members are called `{twice[0]}`; give each its own id")
        return self
