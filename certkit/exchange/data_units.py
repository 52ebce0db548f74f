"""Units as data files write them, brought to SI through the one unit table of the definitions."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from certkit.definitions.units import UNITS, parse_quantity

if TYPE_CHECKING:
    from certkit.definitions.channels import ChannelKind

_SPELLINGS = {
    "m/(s*s)": "m/s²",
    "m/s/s": "m/s²",
    "m/s**2": "m/s²",
    "m/sec2": "m/s²",
    "m/sec^2": "m/s²",
    "N m": "N·m",
    "N.m": "N·m",
    "N-m": "N·m",
    "newton": "N",
    "Newton": "N",
    "sec": "s",
    "degree": "deg",
    "degrees": "deg",
    "Grad": "deg",
    "kNm": "kN·m",
    "°C": "degC",
    "C": "degC",
    "Cel": "degC",
}


def factor(unit: str, kind: ChannelKind) -> float:
    """Return the factor from `unit` to the channel's SI unit.

    Raises
    ------
    ValueError
        When the unit is unknown or not one of the channel's dimension; says which units would do.
    """
    dimension = kind.dimension.quantity
    known = _SPELLINGS.get(unit.strip(), unit.strip())
    try:
        return parse_quantity(f"1 {known}", dimension)
    except ValueError as error:
        allowed = ", ".join(u for u in UNITS[dimension] if u)
        raise ValueError(f"unit `{unit}` for {kind.title}; it is written in {allowed}") from error


def any_factor(unit: str) -> dict[str, float]:
    """Return the factor to SI by each dimension that has this unit; empty when nothing has."""
    known = _SPELLINGS.get(unit.strip(), unit.strip())
    found = {}
    for dimension in UNITS if known else ():
        try:
            found[dimension] = parse_quantity(f"1 {known}", dimension)
        except ValueError:
            continue
    return found


def quantity(text: str, dimension: str, default_unit: str = "") -> float:
    """Read `20.5 degC`, or `20.5` under a descriptor with a default unit, or `20,5`, as SI.

    Raises
    ------
    ValueError
        When it is no finite number with a unit of the dimension.
    """
    match = re.fullmatch(r"\s*([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", text)
    if match is None:
        raise ValueError(f"`{text[:60]}` is not a number with a unit; write one such as `20.5 degC`")
    number, unit = match.group(1).replace(",", "."), match.group(2) or default_unit
    return parse_quantity(f"{number} {_SPELLINGS.get(unit, unit)}".strip(), dimension)


def quantity_of_any_dimension(text: str) -> float:
    """Read a quantity whose dimension only its unit tells.

    Raises
    ------
    ValueError
        When no dimension has that unit.
    """
    for dimension in UNITS:
        try:
            return quantity(text, dimension)
        except ValueError:
            continue
    raise ValueError(f"`{text}` is not a number with a unit that certkit knows; write it like `200 N·m`")
