"""Histories of a finite-element run by the names that the solver gives them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Self

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from certkit.definitions.virtual_test import History
    from certkit.exchange.fe.histories import Units

    Values = NDArray[np.float64]


class Samples(Struct, frozen=True):
    """One history on its own time axis.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Seconds.
    values : ndarray, shape (n,)
        SI.
    """

    time: Values
    values: Values

    def at(self, time: Values) -> Values:
        """Return the values at other times (s, shape (m,)), by linear interpolation."""
        return np.interp(time, self.time, self.values)


class RunFiles(ABC):
    """What every reader of a run offers. Used in `with`, it lets go of its files at the end."""

    files: Mapping[str, str]
    """SHA-256 of every file that was read, by its name."""

    @property
    def remarks(self) -> tuple[str, ...]:
        """What there is to say of the files and of how they were joined."""
        return ()

    def close(self) -> None:  # noqa: B027  # most readers hold nothing open
        """Let go of what is held open."""

    def __enter__(self) -> Self:
        """Return the run."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()

    @abstractmethod
    def history(self, asked: History, dimension: str) -> Samples:
        """Return a history of that dimension.

        Raises
        ------
        DataError
            When the run has none of that name; says what there is.
        """

    @abstractmethod
    def energies(self) -> Mapping[str, Samples]:
        """Return what the run tells of its energies and its mass, SI.

        Keys: `kinetic`, `internal`, `hourglass`, `contact`, `external work`, `total` (external work not
        taken off), `ratio` (total over what went in), `mass` and `added mass` (both kg). What the run does
        not tell is missing.
        """


def factor_of(units: Units, dimension: str) -> float:
    """Return the SI value of one unit of a dimension in a consistent set of units."""
    return {
        "moment": units.energy,
        "length": units.length,
        "force": units.force,
        "angle": 1.0,
        "speed": units.length / units.time,
        "acceleration": units.length / units.time**2,
        "energy": units.energy,
        "time": units.time,
    }[dimension]


def combined(parts: Iterable[Samples], how: str) -> Samples:
    """Return the sum or mean of histories that share a time axis."""
    listed = list(parts)
    total = np.sum([part.values for part in listed], axis=0)
    return Samples(listed[0].time, total / len(listed) if how == "mean" else total)
