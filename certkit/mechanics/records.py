"""Records: what compiled code reads and writes by name, declared as classes.

A record class lists its fields once. Python makes single rows of it, numpy tables (structured arrays), and
compiled code reads the same table row by row: `cable = cables[i]`, then `cable.stiffness`. Every field takes
eight bytes, so that a table can also be seen as plain numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]
    Integers: TypeAlias = NDArray[np.int64]

Structured: TypeAlias = Any
"""A numpy structured array: its fields are known at run time only."""

WORD = 8
"""Bytes of a field."""

Body: TypeAlias = int
"""Number of a body; `certkit.definitions.fixtures.rig_builder.GROUND` stands for the ground."""
State: TypeAlias = float
"""A field that the law itself writes: its history variables, and what is read off it for channels."""

_TYPES: dict[type[Record], np.dtype[np.void]] = {}
"""What `record_type` has made: every run asks for it hundreds of times."""

_FORMATS = {"float": "f8", "State": "f8", "int": "i8", "Body": "i8"}

T = TypeVar("T")
Rows: TypeAlias = Sequence[T]
"""A table of records, as compiled code sees it."""


class Record(Struct, eq=False):
    """Base of record classes, whose fields are `float`, `int`, `Body` or `State`."""


def record_type(record: type[Record]) -> np.dtype[np.void]:
    """Return the numpy type of a record's tables.

    Raises
    ------
    TypeError
        When a field is of another type.
    """
    if record in _TYPES:
        return _TYPES[record]
    found = []
    for name in record.__struct_fields__:
        kind = record.__annotations__[name]
        if kind not in _FORMATS:
            raise TypeError(f"{record.__name__}.{name} must be one of {', '.join(_FORMATS)}")
        found.append((name, _FORMATS[kind]))
    return _TYPES.setdefault(record, np.dtype(found, align=True))


def body_fields(record: type[Record]) -> tuple[str, ...]:
    """Return the names of the fields that hold a body's number."""
    return tuple(name for name, kind in record.__annotations__.items() if kind == "Body")


def table_of(record: type[Record], rows: Iterable[Record] = ()) -> Structured:
    """Return a table with these rows, shape (rows,)."""
    names = record_type(record).names or ()
    return np.array([tuple(getattr(row, n) for n in names) for row in rows], dtype=record_type(record))


def blank(record: type[Record], *shape: int) -> Structured:
    """Return a table of zeros of that shape."""
    return np.zeros(shape, dtype=record_type(record))
