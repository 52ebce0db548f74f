"""Step 1: parts become groups, and groups a graph of load paths.

Momentum flows through the graph: a path passes it on from its first group to its second. `ground` takes up
whatever arrives and has no balance of its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.identification.part_groups import part_groups

if TYPE_CHECKING:
    from certkit.definitions.extraction_case import Case, Path
    from certkit.exchange.fe import PartHistories

GROUND = "ground"


class Link(Struct, frozen=True):
    """One load path of the graph.

    Parameters
    ----------
    name : str
        `F4 – E2`.
    source, target : str
        The groups momentum comes from and goes to.
    contacts, springs : tuple of str
        The model's names of the contacts or ground springs whose histories were recorded in this path.
    tension : bool
        Whether it can also pull.
    law : bool
        Whether a stiffness is wanted.
    start : float or None
        Initial clearance in m where the geometry tells it.
    """

    name: str
    source: str
    target: str
    contacts: tuple[str, ...] = ()
    springs: tuple[str, ...] = ()
    tension: bool = False
    law: bool = True
    start: float | None = None


class Graph(Struct, frozen=True):
    """Groups as lists of parts, and the load paths between them."""

    groups: dict[str, tuple[str, ...]]
    links: tuple[Link, ...]


def build_graph(case: Case, histories: PartHistories) -> Graph:
    """Resolve the case's part names and check that every path connects groups that exist.

    Raises
    ------
    DataError
        For a part that is missing or in two groups, an unknown group, a path twice, a group that no path
        reaches.
    """
    if len(case.groups) < 2 or not case.paths:
        raise DataError(
            f"the case {case.case} has no groups and paths yet; `certkit extract CASE.yaml --propose` "
            "writes a first grouping to edit"
        )
    if GROUND in case.groups:
        raise DataError(
            "a group cannot be called `ground`: that is the car's body, which takes up what arrives"
            "; give it another name"
        )
    groups = part_groups(case, histories)
    links: dict[str, Link] = {}
    for path in case.paths:
        if path.name in links:
            raise DataError(f"path {path.name} stands there twice; join them into one")
        links[path.name] = _link(path, groups)
    reached = {end for link in links.values() for end in (link.source, link.target)}
    for name in groups:
        if name not in reached:
            raise DataError(f"no path reaches group `{name}`; add one or leave the group out")
    return Graph(groups, tuple(links.values()))


def _link(path: Path, groups: dict[str, tuple[str, ...]]) -> Link:
    source, target = path.between
    for end in (source, target):
        if end != GROUND and end not in groups:
            known = ", ".join([*groups, GROUND])
            raise DataError(f"path {path.name}: there is no group `{end}`; there are {known}")
    if source == target:
        raise DataError(f"path {path.name} leads back to its own group; correct `between`")
    if path.spring is not None and target != GROUND:
        raise DataError(f"path {path.name}: a recorded spring leads to the ground; write [{source}, ground]")
    start = None if path.start is None else float(path.start)
    contacts, springs = _names(path.contact), _names(path.spring)
    return Link(path.name, source, target, contacts, springs, path.tension, path.law, start)


def _names(given: list[str] | str | None) -> tuple[str, ...]:
    return (given,) if isinstance(given, str) else tuple(given or ())
