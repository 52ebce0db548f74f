"""OpenRadioss' native time history (`…T01`), written for tests in each of its layouts."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

RECORDS_FROM = 3050


@dataclass(frozen=True)
class Group:
    """Objects of one kind: titles by id, and each object's values by variable number."""

    kind: int
    titles: dict[int, str]
    values: dict[int, list[np.ndarray]]


@dataclass(frozen=True)
class History:
    """What a file holds: parts by title with values by variable number; subsets have values alone."""

    time: np.ndarray
    parts: dict[str, dict[int, np.ndarray]]
    groups: list[Group] = field(default_factory=list)
    subset: dict[int, np.ndarray] = field(default_factory=dict)
    globals_: list[np.ndarray] = field(default_factory=list)


def title_length(code: int) -> int:
    """Return what the solver writes: 40, 80 or 100 characters."""
    return 40 if code < 3041 else 80 if code < RECORDS_FROM else 100


def written(
    history: History,
    code: int,
    *,
    factors: tuple[float, float, float] = (1.0, 1e-3, 1e-3),
    further: bool | None = None,
    titles: int | None = None,
) -> bytes:
    """Return a file of a format code; `further` says whether its length of titles and units are told."""
    length = titles or title_length(code)
    told = code >= RECORDS_FROM if further is None else further
    out = [
        record(struct.pack(">i", code) + b"a made-up run".ljust(80)),
        record(b"today, no solver".ljust(80)),
    ]
    if told:
        out += [integers(2), integers(length), record(struct.pack(">3f", *factors))]
    subsets = 1 if history.subset else 0
    out.append(integers(len(history.parts), 1, 1, subsets, len(history.groups), len(history.globals_)))
    if history.globals_:
        out.append(integers(*range(1, len(history.globals_) + 1)))
    for number, (name, values) in enumerate(history.parts.items(), 1):
        out.append(record(titled(number, name, length) + struct.pack(">4i", 0, 1, 1, len(values))))
        out += [integers(*values)] if values else []
    out += [record(titled(1, "material", length)), record(titled(1, "property", length))]
    if subsets:
        out.append(record(struct.pack(">5i", 1, 0, 0, 1, len(history.subset)) + b"all".ljust(length)))
        out += [integers(1), integers(*history.subset)]
    for number, group in enumerate(history.groups, 1):
        head = struct.pack(">5i", number, group.kind, 0, len(group.titles), len(group.values))
        out.append(record(head + b"asked for".ljust(length)))
        out += [record(titled(one, name, length)) for one, name in group.titles.items()]
        out += [integers(*group.values)] if group.values else []
    for row, time in enumerate(history.time):
        blocks = [
            [time],
            [values[row] for values in history.globals_],
            [v[row] for values in history.parts.values() for v in values.values()],
            [v[row] for v in history.subset.values()],
        ]
        blocks += [
            [each[k][row] for k in range(len(group.titles)) for each in group.values.values()]
            for group in history.groups
        ]
        out += [reals(block) for block in blocks if block]
    return b"".join(out)


def record(content: bytes) -> bytes:
    """Put a record's length before and behind it."""
    length = struct.pack(">i", len(content))
    return length + content + length


def integers(*values: int) -> bytes:
    """Return a record of whole numbers."""
    return record(struct.pack(f">{len(values)}i", *values))


def reals(values: list[float]) -> bytes:
    """Return a record of 32-bit numbers."""
    return record(struct.pack(f">{len(values)}f", *values))


def titled(number: int, name: str, length: int) -> bytes:
    """Return an id and a title."""
    return struct.pack(">i", number) + name.encode("latin-1").ljust(length)[:length]
