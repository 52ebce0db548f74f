"""A first grouping of a finite-element front's parts, from where they are and what their contacts are called.

It is meant to be edited. The rules, each of which leaves its word in the proposal:

- The part of the largest momentum at the start is the impactor.
- A part with a face is fascia or, where its face lies along the car or its name says so, hood; one without is
  engine room.
- A contact or a spring to the ground lies at the parts whose names, or words of them, stand in its own name.
- Faces next to each other in height pull on each other, since they are one sheet.
- A path leads away from the impactor. A part without a known face that the impactor touches is fascia.
- Where no path leads to the ground, what is pushed and leads nowhere stands on it.
- The sheet's end, and a group from which nothing leads on, lean on the nearest group behind that is held.
  One that is held and pushed by none is pushed by the nearest in front.
"""

from __future__ import annotations

import math
import re
from itertools import pairwise
from typing import TYPE_CHECKING

from msgspec import Struct, field

from certkit.errors import DataError
from certkit.exchange.fe.faces import Face

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.exchange.fe import PartHistories

ALONG = 2.0
"""dx/dz of a face beyond which it lies along the car: a grille leans at most so far."""

HOOD = {"hood", "bonnet"}
"""Words of a part's name that make it hood, however steep its edge is."""

JOINED = 0.01
"""m: faces whose ends are nearer than this in height are next to each other."""

_WORDS = re.compile(r"[A-Za-z]{3,}|[A-Za-z]+\d+")


class ProposedPath(Struct, frozen=True):
    """A load path, and why it is there."""

    between: tuple[str, str]
    because: str
    contact: str | None = None
    spring: str | None = None
    tension: bool = False
    law: bool = True


class Proposal(Struct, frozen=True):
    """Groups as (kind, part) by their names, load paths, and contacts and springs that found no place.

    `by_centre` are the fascia groups whose front was not recorded: they move with their centres of gravity.
    """

    groups: dict[str, tuple[str, str]]
    paths: list[ProposedPath] = field(default_factory=list)
    left_over: list[str] = field(default_factory=list)
    by_centre: set[str] = field(default_factory=set)


def propose(histories: PartHistories, faces: Mapping[str, Face]) -> Proposal:
    """Propose groups and load paths.

    Raises
    ------
    DataError
        When no part has a momentum at the start.
    """
    faces = {**_places(histories), **faces}
    moving = {
        name: abs(float(part.momentum[0]))
        for name, part in histories.parts.items()
        if part.momentum is not None
    }
    impactor = max(moving, key=moving.__getitem__, default=None)
    if impactor is None or not moving[impactor]:
        raise DataError(f"{histories.source}: no part moves at the start, so there is no impactor; name one")
    names = _short([name for name in histories.parts if name in moving])
    groups = {names[part]: (_kind(part, impactor, faces), part) for part in names}
    found = Proposal(dict(sorted(groups.items(), key=lambda item: _order(item[1], faces))))
    _add_recorded(found, histories)
    for path in found.paths:
        kind, part = found.groups.get(path.between[1], ("", ""))
        if found.groups[path.between[0]][0] == "impactor" and kind == "engine room":
            found.groups[path.between[1]] = ("fascia", part)
    _add_sheet(found, faces)
    _add_support(found, faces)
    _add_push(found, faces)
    _add_ground(found)
    for group, (kind, part) in found.groups.items():
        moved = histories.parts[part]
        if kind == "fascia" and moved.front is None and moved.displacement is not None:
            found.by_centre.add(group)
    return found


def _places(histories: PartHistories) -> dict[str, Face]:
    """Return parts whose place the solver itself tells, without a face."""
    return {
        name: Face(part.mass or 0.0, centre=(part.start[0], part.start[2]))
        for name, part in histories.parts.items()
        if part.start is not None and part.start[0] is not None and part.start[2] is not None
    }


def _short(parts: Sequence[str]) -> dict[str, str]:
    """Return a group's name by part: the part's first word where that is its own (`F1_spoiler_lip`: F1)."""
    first = [part.partition("_")[0] for part in parts]
    return {
        part: word if word and first.count(word) == 1 else part
        for part, word in zip(parts, first, strict=True)
    }


def _kind(part: str, impactor: str, faces: Mapping[str, Face]) -> str:
    if part == impactor:
        return "impactor"
    face = faces.get(part)
    if face is None or face.low is None:
        return "engine room"
    return "hood" if abs(face.slope or 0.0) > ALONG or _words(part) & HOOD else "fascia"


def _order(group: tuple[str, str], faces: Mapping[str, Face]) -> tuple[int, float]:
    kind, part = group
    face = faces.get(part)
    return ("impactor", "fascia", "hood", "engine room").index(kind), (face and face.low) or 0.0


def _words(name: str) -> set[str]:
    return {word.lower() for word in _WORDS.findall(name)}


def _named(found: Proposal, record: str) -> list[str]:
    """Return the groups whose part, or a word of it that no other part has, stands in a record's name."""
    whole = [group for group, (_, part) in found.groups.items() if part in record]
    rest = record
    for group in whole:
        rest = rest.replace(found.groups[group][1], " ")
    words = _words(rest)
    for group, (kind, part) in found.groups.items():
        others = {w for name, (_, p) in found.groups.items() if name != group for w in _words(p)}
        own = _words(part) - others
        if group not in whole and (own & words or (kind == "impactor" and kind in words)):
            whole.append(group)
    return whole


def _add_recorded(found: Proposal, histories: PartHistories) -> None:
    kinds = {group: kind for group, (kind, _) in found.groups.items()}
    reached = {group for group, kind in kinds.items() if kind == "impactor"}
    for contact in _from_impactor(found, histories):
        ends = sorted(_named(found, contact), key=list(found.groups).index)
        if len(ends) != 2 or any(set(path.between) == set(ends) for path in found.paths):
            found.left_over.append(f"contact {contact}")
            continue
        if ends[1] in reached and ends[0] not in reached:
            ends.reverse()
        reached |= set(ends) if ends[0] in reached else set()
        touches = kinds[ends[0]] == "impactor"
        because = "recorded contact" + ("; the impactor touches freely" if touches else "")
        found.paths.append(ProposedPath((ends[0], ends[1]), because, contact=contact, law=not touches))
    for spring in histories.springs:
        ends = [group for group, (_, part) in found.groups.items() if part == spring] or [
            group for group in found.groups if spring.partition("_")[0] == group
        ]
        if len(ends) != 1 or any(path.between == (ends[0], "ground") for path in found.paths):
            found.left_over.append(f"spring {spring}")
            continue
        found.paths.append(ProposedPath((ends[0], "ground"), "recorded spring", spring=spring, tension=True))


def _from_impactor(found: Proposal, histories: PartHistories) -> list[str]:
    """Return the contacts in the order in which they are reached from the impactor."""
    waiting = {contact: set(_named(found, contact)) for contact in histories.contacts}
    reached = {group for group, (kind, _) in found.groups.items() if kind == "impactor"}
    order: list[str] = []
    while waiting:
        near = [contact for contact, ends in waiting.items() if ends & reached] or list(waiting)
        order += near
        for contact in near:
            reached |= waiting.pop(contact)
    return order


def _add_sheet(found: Proposal, faces: Mapping[str, Face]) -> None:
    for kind in ("fascia", "hood"):
        row = [
            group
            for group, (own, part) in found.groups.items()
            if own == kind and part in faces and faces[part].low is not None
        ]
        for lower, upper in pairwise(row):
            below, above = (faces[found.groups[group][1]] for group in (lower, upper))
            near = abs((above.low or 0.0) - (below.high or 0.0)) <= JOINED
            because = (
                "next to each other" if near else "neighbours in height, with a gap: are they one sheet?"
            )
            found.paths.append(ProposedPath((lower, upper), because, tension=True))


def _add_support(found: Proposal, faces: Mapping[str, Face]) -> None:
    """Let what leads nowhere lean on the nearest group behind it that leads to the ground."""
    grounded = {path.between[0] for path in found.paths if path.between[1] == "ground"}
    leading = True
    while leading:
        new = {p.between[0] for p in found.paths if p.between[1] in grounded} - grounded
        leading = bool(new)
        grounded |= new
    top = next((g for g, (kind, _) in reversed(found.groups.items()) if kind == "fascia"), None)
    for group, (kind, part) in found.groups.items():
        held = group in grounded and group != top
        if kind == "impactor" or (kind == "fascia" and group != top) or held or part not in faces:
            continue
        behind = {
            other: _distance(faces[part], faces[found.groups[other][1]])
            for other in grounded
            if found.groups[other][0] == ("engine room" if kind == "fascia" else found.groups[other][0])
            if found.groups[other][1] in faces and found.groups[other][0] != "fascia"
        }
        because = "the sheet's end" if kind == "fascia" else "nothing else leads on from it"
        _add_nearest(found, group, behind, f"{because}; the nearest group behind that is held", away=True)


def _add_push(found: Proposal, faces: Mapping[str, Face]) -> None:
    """Let what is held, and pushed by nothing, be pushed by the nearest group in front of it."""
    pushed = {path.between[1] for path in found.paths}
    for group, (kind, part) in found.groups.items():
        if kind != "engine room" or group in pushed or part not in faces:
            continue
        before = {
            other: _distance(faces[own], faces[part])
            for other, (_, own) in found.groups.items()
            if other != group and own in faces
        }
        _add_nearest(found, group, before, "nothing else pushes it; the nearest group in front", away=False)


def _add_ground(found: Proposal) -> None:
    """Let what is pushed and leads nowhere stand on the ground, where no path leads there."""
    if any(path.between[1] == "ground" for path in found.paths):
        return
    leading = {path.between[0] for path in found.paths}
    for group in dict.fromkeys(path.between[1] for path in found.paths):
        if group not in leading:
            because = "nothing else takes up what it is given; give the spring, or leave it"
            found.paths.append(ProposedPath((group, "ground"), because, law=False))


def _add_nearest(
    found: Proposal, group: str, distances: Mapping[str, float], because: str, *, away: bool
) -> None:
    """Add a path from a group to the nearest other one, or from that to it."""
    near = min(distances, key=distances.__getitem__, default=None)
    if near is None or math.isinf(distances[near]):
        return
    between = (group, near) if away else (near, group)
    if not any(set(between) == set(path.between) for path in found.paths):
        found.paths.append(ProposedPath(between, because, tension=True))


def _distance(first: Face, second: Face) -> float:
    """Return the distance of two parts' middles, without end where one is not known or lies in front."""
    if first.centre is None or second.centre is None:
        return math.inf
    (x, z), (u, w) = first.centre, second.centre
    return math.hypot(u - x, w - z) if u >= x else math.inf
