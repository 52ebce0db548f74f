"""Runs as a solver's own files tell them: histories are variables of named objects, not columns."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.fe.run_histories import RunFiles, Samples, combined, factor_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.virtual_test import History
    from certkit.exchange.fe.histories import Units

    Values = NDArray[np.float64]


class NodePath(Struct, frozen=True):
    """Where a node is over time, in the run's own units.

    Parameters
    ----------
    time : ndarray, shape (n,)
    place : ndarray, shape (3,)
        Before it moved.
    displacement : ndarray, shape (n, 3)
    """

    time: Values
    place: Values
    displacement: Values


class RunOfObjects(RunFiles):
    """A run that answers `table`, `of` and `variable`, and the distance `between` two nodes."""

    units: Units
    """The run's, as the mapping tells them."""

    source: str
    """Its files, for messages."""

    kind: str
    """What such a file is called, and what it has instead of columns."""

    @abstractmethod
    def variable(self, table: str, name: str, variable: str) -> Samples:
        """Return a variable of one object: time in seconds, values in the run's units.

        Raises
        ------
        DataError
            When there is none of these names; says what there is.
        """

    @abstractmethod
    def node(self, name: str) -> NodePath:
        """Return where a node is; its time in seconds."""

    def history(self, asked: History, dimension: str) -> Samples:
        """Return a variable of objects, their sum or mean, or the growth of two nodes' distance: SI."""
        if asked.between is not None:
            first, second = (self.node(name) for name in asked.between)
            found = growth_of_distance(first, second)
        elif asked.table is None:
            raise DataError(f"{self.source}: {self.kind}, no columns; map `table`, `of` and `variable`")
        else:
            table, variable = asked.table, asked.variable or ""
            found = combined([self.variable(table, name, variable) for name in asked.objects], asked.combine)
        return Samples(found.time, found.values * factor_of(self.units, dimension))


def growth_of_distance(first: NodePath, second: NodePath) -> Samples:
    """Return how much the distance of two nodes of one run grows, on the first one's time."""
    apart = (second.place + second.displacement) - (first.place + first.displacement)
    length = np.sqrt((apart**2).sum(axis=1))
    return Samples(first.time, length - length[0])
