"""Which parts a case's groups consist of: by name, by id, or by where their centres are at the start."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.part_selection import AXES, ids_of
from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from certkit.definitions.extraction_case import Case, CaseGroup
    from certkit.definitions.loading.faults import Fault, Steps
    from certkit.definitions.part_selection import Box
    from certkit.exchange.fe import Face, PartHistories
    from certkit.exchange.fe.histories import Place

FORGOTTEN = 0.02
"""Share of the impactor's momentum by which that of a part in no group may change before it is warned of."""


class GroupingError(DataError):
    """Groups that do not fit their run, each fault with the steps that lead to it in the case."""

    def __init__(self, faults: list[Fault]) -> None:
        """Keep the faults."""
        self.faults = tuple(faults)
        super().__init__("; ".join(message for _, message in faults))


def part_groups(case: Case, histories: PartHistories) -> dict[str, tuple[str, ...]]:
    """Return the parts of each group.

    Raises
    ------
    GroupingError
        For names, ids and boxes that no part fits, parts without momentum, and a part in two groups.
    """
    faults: list[Fault] = []
    owner: dict[str, tuple[str, Steps]] = {}
    groups: dict[str, tuple[str, ...]] = {}
    for name, group in case.groups.items():
        chosen: dict[str, Steps] = {}
        for steps, parts, fault in _chosen(group, histories):
            place = ("groups", name, *steps)
            if fault:
                faults.append((place, f"group `{name}`: {fault}"))
            for part in parts:
                chosen.setdefault(part, place)
        for part, place in chosen.items():
            if histories.parts[part].momentum is None:
                faults.append((place, _no_momentum(name, part, histories)))
            elif part in owner:
                other, where = owner[part]
                both = f"`{other}` ({_word(where)}) and `{name}` ({_word(place)})"
                said = f"part `{part}` is in the groups {both}; leave it out of one, or make a box smaller"
                faults.append((place, said))
            else:
                owner[part] = (name, place)
        groups[name] = tuple(chosen)
    if faults:
        raise GroupingError(faults)
    return groups


def left_over(
    groups: Mapping[str, tuple[str, ...]], histories: PartHistories, faces: Mapping[str, Face]
) -> tuple[list[str], list[str]]:
    """Return warnings and notes on parts that move and are in no group.

    One with a face is warned of however light it is: the leg would meet nothing where it stands.
    """
    taken = {part for parts in groups.values() for part in parts}
    changes = {
        name: float(np.ptp(part.momentum))
        for name, part in histories.parts.items()
        if part.momentum is not None
    }
    largest = max(changes.values(), default=0.0)
    warnings: list[str] = []
    notes: list[str] = []
    for name, change in changes.items():
        if name in taken or not change > 0:
            continue
        share = 100.0 * change / largest
        said = f"part `{name}` is in no group; its momentum changes by {share:.1f} % of the largest"
        faced = name in faces and faces[name].position is not None
        (warnings if share > 100 * FORGOTTEN or faced else notes).append(
            f"{said}{', and the leg meets nothing at its face' if faced else ''}"
        )
    return warnings, notes


def nodes_in(box: Box, histories: PartHistories, group: str) -> list[str]:
    """Return the recorded nodes that lie in a group's box at the start.

    Raises
    ------
    GroupingError
        When there are none, or the file does not tell where nodes are.
    """
    steps = ("groups", group, "moves with box")
    places = {name: place for name, place in histories.node_places.items() if name in histories.nodes}
    if not places:
        said = f"{histories.source} does not tell where its nodes are; name them under `moves with`"
        raise GroupingError([(steps, f"group `{group}`: {said}")])
    found = [name for name, place in places.items() if box.holds(place)]
    if not found:
        raise GroupingError([(steps, f"group `{group}`: no node lies in this box; {_nearest(box, places)}")])
    return found


def _chosen(group: CaseGroup, histories: PartHistories) -> Iterator[tuple[Steps, list[str], str | None]]:
    """Yield where a choice stands in the group, the parts that it fits, and what is wrong with it."""
    known = list(histories.parts)
    for k, pattern in enumerate(group.parts):
        try:
            part = histories.part(pattern)
        except DataError as error:
            yield ("parts", k), [], str(error)
        else:
            yield ("parts", k), [next(n for n in known if histories.parts[n] is part)], None
    numbers = {name: _number(name, histories) for name in known}
    for k, text in enumerate(group.ids):
        found = [name for name, number in numbers.items() if number is not None and number in ids_of(text)]
        yield ("ids", k), found, None if found else _no_id(text, numbers, histories.source)
    places = {name: part.start for name, part in histories.parts.items() if part.start is not None}
    for k, box in enumerate(group.boxes):
        found = [name for name, place in places.items() if box.holds(place)]
        fault = None
        if not found:
            fault = f"no part's centre lies in this box; {_nearest(box, places)}"
        yield ("boxes", k), found, fault


def _number(name: str, histories: PartHistories) -> int | None:
    own = histories.parts[name].id
    return own if own is not None else int(name) if name.isdigit() else None


def _no_id(text: str, numbers: Mapping[str, int | None], source: str) -> str:
    known = sorted(number for number in numbers.values() if number is not None)
    if not known:
        return f"{source}: its parts have no ids; name them under `parts`, or use `boxes`"
    listed = ", ".join(map(str, known[:12])) + (" …" if len(known) > 12 else "")
    return f"no part has an id of `{text}`; there are {listed}"


def _nearest(box: Box, places: Mapping[str, Place]) -> str:
    """Say what lies nearest to a box, and where."""
    if not places:
        return "no file tells where they are: ask for XCG, YCG, ZCG or give a `table` with cg_x0_mm, cg_z0_mm"

    def outside(place: Place) -> float:
        """Return how far a place is from the box, m; a coordinate that is not known is infinitely far."""
        at = dict(zip(AXES, place, strict=True))
        gaps = [
            math.inf if at[axis] is None else max(low - (at[axis] or 0.0), (at[axis] or 0.0) - high, 0.0)
            for axis, (low, high) in box.bounds.items()
        ]
        return math.hypot(*gaps)

    name = min(places, key=lambda n: outside(places[n]))
    if math.isinf(outside(places[name])):
        lacking = [a for a in box.bounds if all(p[AXES.index(a)] is None for p in places.values())]
        return f"{' and '.join(lacking)} of none is known: leave that axis out"
    at = ", ".join(f"{a} {1e3 * v:.4g} mm" for a, v in zip(AXES, places[name], strict=True) if v is not None)
    return f"the nearest is `{name}` ({at})"


def _no_momentum(group: str, part: str, histories: PartHistories) -> str:
    return (
        f"{histories.source}: group `{group}`: part `{part}` has no momentum; if it is a rigid body, "
        "describe it under `rigid bodies` (its mass and main node); a part of a table needs `momentum`, or "
        "`velocity` and a mass"
    )


def _word(steps: Steps) -> str:
    """Return how a part was chosen: `box 2`, `ids 1`."""
    kind, number = str(steps[-2]), int(steps[-1]) + 1
    return f"{ {'boxes': 'box', 'parts': 'parts'}.get(kind, kind) } {number}"
