"""The works behind a result: what its sources point into, each once, as a list of sources prints it."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from certkit.definitions.bibliography import OWN, Bibliography
from certkit.definitions.loading.library import load

if TYPE_CHECKING:
    from certkit.definitions.bibliography import Work
    from certkit.documents.result import Result


@lru_cache(maxsize=1)
def bibliography() -> Bibliography:
    """Return the bibliography that comes with certkit."""
    return Bibliography.model_validate(load("bibliography", "works").document)


def works_cited(result: Result) -> dict[str, Work]:
    """Return the works that the sources of a result's corridors, scores and numbers name, by short name."""
    sources = [c.source for c in result.criteria] + [s.source for s in result.scores]
    return bibliography().cited_by({*sources, *(p.source for p in result.parameters)})


def own_work(result: Result) -> str:
    """Return what numbers of a result rest on that name no work; empty where there are none."""
    cited = bibliography().cited
    own = any(p.confidence in OWN and not cited(p.source) for p in result.parameters)
    return bibliography().own_work if own else ""
