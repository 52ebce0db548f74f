"""Factors: the parameters of a study as distributions over numbers in their units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from msgspec import Struct

from certkit.definitions.units import split_quantity
from certkit.errors import UsageError
from certkit.studies.quantity import number_in, share

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.study import StudyParameter
    from certkit.studies.points import Setting

CUT = 3.0
"""Standard deviations at which a normal distribution is cut off: a rig outside is not let to the test."""


class Uniform(Struct, frozen=True):
    """Every value between two is as likely."""

    word: ClassVar[Literal["uniform"]] = "uniform"

    low: float
    high: float

    def quantile(self, p: float) -> float:
        """Return the value below which a share `p` lies."""
        return self.low + p * (self.high - self.low)


class NormalFactor(Struct, frozen=True):
    """A bell, cut off at `CUT` standard deviations."""

    word: ClassVar[Literal["normal"]] = "normal"

    mean: float
    sd: float

    def quantile(self, p: float) -> float:
        """Return the value below which a share `p` lies."""
        from scipy.special import ndtr, ndtri  # noqa: PLC0415  # scipy is slow to import

        tail = float(ndtr(-CUT))
        return self.mean + self.sd * float(ndtri(tail + p * (1 - 2 * tail)))

    @property
    def low(self) -> float:
        """Lowest value."""
        return self.mean - CUT * self.sd

    @property
    def high(self) -> float:
        """Highest value."""
        return self.mean + CUT * self.sd


class Triangular(Struct, frozen=True):
    """Likeliest in the middle, impossible at both ends."""

    word: ClassVar[Literal["triangular"]] = "triangular"

    low: float
    mode: float
    high: float

    def quantile(self, p: float) -> float:
        """Return the value below which a share `p` lies."""
        width = self.high - self.low
        if p * width <= self.mode - self.low:
            return self.low + math.sqrt(p * width * (self.mode - self.low))
        return self.high - math.sqrt((1 - p) * width * (self.high - self.mode))


class Levels(Struct, frozen=True):
    """A list of numbers or words, each as likely."""

    word: ClassVar[Literal["levels"]] = "levels"

    entries: tuple[Setting, ...]

    def quantile(self, p: float) -> Setting:
        """Return the entry at the share `p` of the list."""
        return self.entries[min(int(p * len(self.entries)), len(self.entries) - 1)]


Distribution = Uniform | NormalFactor | Triangular | Levels


class Factor(Struct, frozen=True):
    """A parameter of a study.

    Parameters
    ----------
    name : str
        Its column: the path, with the procedure before it where it holds for one only.
    unit : str
        Unit of its numbers, as written in the study; empty for ratios and words.
    distribution : Distribution
    nominal : float or str, optional
        Its value in the definitions, in the same unit; None where they have it in another one.
    """

    name: str
    unit: str
    distribution: Distribution
    nominal: Setting | None = None

    @property
    def middle(self) -> Setting:
        """The nominal value, else the median: where a factor stands while others vary."""
        return self.distribution.quantile(0.5) if self.nominal is None else self.nominal

    def levels(self, count: int) -> list[Setting]:
        """Return `count` values from the lowest to the highest, or the list that was given."""
        if isinstance(self.distribution, Levels):
            return list(self.distribution.entries)
        low, high = self.distribution.low, self.distribution.high
        return [low + (high - low) * i / (count - 1) for i in range(count)]


def factor_of(parameter: StudyParameter, nominals: Mapping[str, str]) -> Factor:
    """Turn a parameter of a study document into a factor.

    Parameters
    ----------
    parameter : StudyParameter
    nominals : mapping of str to str
        Values in the definitions by path, as written there; needed for shares such as `10 %`.

    Raises
    ------
    UsageError
        When units differ, an order is wrong, or a share has nothing to be a share of.
    """
    name = parameter.name
    nominal = nominals.get(name)
    if parameter.values is not None:
        return _levels(name, parameter.values, nominal)
    if parameter.triangular is not None:
        unit = _unit(parameter.triangular[0], name)
        low, mode, high = (number_in(value, unit, name) for value in parameter.triangular)
        if not (low <= mode <= high and low < high):
            raise UsageError(f"{name}: `triangular` is lowest, likeliest, highest, in this order")
        return Factor(name, unit, Triangular(low, mode, high), _number(nominal, unit))
    if parameter.normal is not None:
        mean = parameter.normal.mean if parameter.normal.mean is not None else _known(nominal, name)
        unit = _unit(mean, name)
        middle = number_in(mean, unit, name)
        part = share(parameter.normal.sd) if unit != "%" else None
        sd = abs(middle) * part if part is not None else number_in(parameter.normal.sd, unit, name)
        if sd <= 0:
            raise UsageError(f"{name}: the standard deviation has to be above zero")
        return Factor(name, unit, NormalFactor(middle, sd), _number(nominal, unit))
    return _uniform(parameter, nominal)


def _uniform(parameter: StudyParameter, nominal: str | None) -> Factor:
    name, given = parameter.name, parameter.uniform
    if isinstance(given, list):
        unit = _unit(given[0], name)
        low, high = (number_in(value, unit, name) for value in given)
    else:
        part = share(given or "")
        if part is None:
            raise UsageError(f"{name}: `uniform` is [lowest, highest], or a share such as `10 %`")
        unit = _unit(_known(nominal, name), name)
        middle = number_in(_known(nominal, name), unit, name)
        low, high = sorted((middle * (1 - part), middle * (1 + part)))
    if not low < high:
        raise UsageError(f"{name}: the lowest value has to be below the highest; exchange the two")
    return Factor(name, unit, Uniform(low, high), _number(nominal, unit))


def _levels(name: str, values: list[str | float], nominal: str | None) -> Factor:
    found = [split_quantity(value) for value in values]
    if any(entry is None for entry in found):
        return Factor(name, "", Levels(tuple(str(value) for value in values)), nominal)
    unit = _unit(values[0], name)
    return Factor(
        name, unit, Levels(tuple(number_in(value, unit, name) for value in values)), _number(nominal, unit)
    )


def _unit(value: str | float, name: str) -> str:
    found = split_quantity(value)
    if found is None:
        raise UsageError(f"{name}: `{value}` is no number with a unit; write it like `25 mm`")
    return found[1]


def _number(nominal: str | None, unit: str) -> float | None:
    found = split_quantity(nominal) if nominal is not None else None
    return found[0] if found and found[1] == unit else None


def _known(nominal: str | None, name: str) -> str:
    if nominal is None:
        raise UsageError(
            f"{name}: the definitions have no number of this path, so there is nothing to take a share of; "
            "give quantities"
        )
    return nominal
