"""The space of a fit: every free number between its bounds as a share from 0 to 1."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.definitions.units import split_quantity
from certkit.errors import UsageError
from certkit.studies.quantity import number_in

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from certkit.definitions.calibration import FitParameter

DIGITS = 6
"""Significant digits of a tried value: what is tried can be written into a file and read back unchanged."""


class Axis(Struct, frozen=True):
    """One free number.

    Parameters
    ----------
    name, unit : str
    low, high, start : float
        In `unit`.
    logarithmic : bool
        Shares go by ratios instead of differences.
    prior : (float, float), optional
        Mean and standard deviation in `unit`.
    """

    name: str
    unit: str
    low: float
    high: float
    start: float
    logarithmic: bool = False
    prior: tuple[float, float] | None = None

    def value(self, share: float) -> float:
        """Return the number at a share of the way from low to high."""
        share = min(max(share, 0.0), 1.0)
        if self.logarithmic:
            number = self.low * (self.high / self.low) ** share
        else:
            number = self.low + share * (self.high - self.low)
        return float(f"{min(max(number, self.low), self.high):.{DIGITS}g}")

    def share(self, value: float) -> float:
        """Return how far along a number is."""
        if self.logarithmic:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def slope(self, share: float) -> float:
        """Return the change of the number per share, there."""
        if self.logarithmic:
            return self.value(share) * math.log(self.high / self.low)
        return self.high - self.low


class Space(Struct, frozen=True):
    """All free numbers of a fit, in the order of its document."""

    axes: tuple[Axis, ...]

    @property
    def names(self) -> list[str]:
        """Names of the axes."""
        return [axis.name for axis in self.axes]

    @property
    def start(self) -> NDArray[np.float64]:
        """Shares of the start, shape (k,)."""
        return np.array([axis.share(axis.start) for axis in self.axes])

    def point(self, shares: NDArray[np.float64]) -> dict[str, float]:
        """Return the numbers at shares, shape (k,)."""
        return {axis.name: axis.value(float(s)) for axis, s in zip(self.axes, shares, strict=True)}


def axis_of(parameter: FitParameter, nominals: Mapping[str, str]) -> Axis:
    """Turn a parameter of a fit document into an axis that starts at its value in the definitions.

    Raises
    ------
    UsageError
        When the path is no number of the definitions, units differ, or the start lies outside the bounds.
    """
    name = parameter.name
    written = nominals.get(name)
    if written is None:
        raise UsageError(f"{name}: the definitions have no number of this path; `certkit show` lists them")
    found = split_quantity(parameter.lower)
    unit = found[1] if found else ""
    low, high = number_in(parameter.lower, unit, name), number_in(parameter.upper, unit, name)
    start = number_in(written, unit, name)
    if not low < high:
        raise UsageError(f"{name}: the lower bound has to be below the upper")
    if parameter.scale == "logarithmic" and low <= 0:
        raise UsageError(f"{name}: a logarithmic scale needs bounds above zero")
    if not low <= start <= high:
        raise UsageError(f"{name}: it is {written} now, outside its bounds; widen them or change the start")
    prior = None
    if parameter.prior is not None:
        prior = (number_in(parameter.prior.mean, unit, name), number_in(parameter.prior.sd, unit, name))
    return Axis(name, unit, low, high, start, parameter.scale == "logarithmic", prior)


def space_of(parameters: Sequence[FitParameter], nominals: Mapping[str, str]) -> Space:
    """Turn all parameters of a fit into its space; see `axis_of`."""
    return Space(tuple(axis_of(parameter, nominals) for parameter in parameters))
