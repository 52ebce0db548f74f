"""A bibliography: the works that the sources of numbers point into, each with its full entry."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from certkit.definitions.base import Document

if TYPE_CHECKING:
    from collections.abc import Iterable

OWN: frozenset[str] = frozenset({"estimated", "derived"})
"""Confidences of numbers that rest on a judgement or on arithmetic, not on a work that could be opened."""


class Work(Document):
    """A text, program, data set or fit."""

    names: Annotated[
        list[str],
        Field(
            min_length=1, description="Words by which a `source` names it: `UN R127`; in full, as written."
        ),
    ]
    entry: Annotated[
        str, Field(min_length=10, description="Who, what, when, where: as in a list of sources.")
    ]
    read: Annotated[str, Field(min_length=3, description="How much of it was read, and in which copy.")]

    def is_named_in(self, source: str) -> bool:
        """Tell whether a source names this work."""
        return any(re.search(rf"(?<!\w){re.escape(name)}(?!\w)", source) for name in self.names)


class Bibliography(Document):
    """Works by their short names."""

    bibliography: Annotated[str, Field(description="Its name.")]
    title: str
    works: Annotated[dict[str, Work], Field(min_length=1)]
    own_work: Annotated[
        str,
        Field(min_length=10, description="What numbers rest on that name no work: estimates, derivations."),
    ]

    def cited(self, source: str) -> dict[str, Work]:
        """Return the works that a source names; a source in plain words names none."""
        return {key: work for key, work in self.works.items() if work.is_named_in(source)}

    def cited_by(self, sources: Iterable[str]) -> dict[str, Work]:
        """Return the works that any of several sources names, each once, in the order of the bibliography."""
        told = list(sources)
        return {
            key: work for key, work in self.works.items() if any(work.is_named_in(source) for source in told)
        }
