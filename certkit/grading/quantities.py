"""Quantities of definitions as grading needs them: SI of a channel's dimension, or in a criterion's unit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.definitions.units import UNITS, dimensions, from_si, parse_quantity
from certkit.errors import UsageError

if TYPE_CHECKING:
    from certkit.definitions.channels import Dimension


def quantity(text: str, dimension: Dimension, where: str) -> float:
    """Read a quantity of a channel's dimension, SI.

    Raises
    ------
    UsageError
        When its unit is not one of the dimension; `where` says in which definition it stands.
    """
    try:
        return parse_quantity(text, dimension.quantity)
    except ValueError as error:
        raise UsageError(f"{where}: {error}") from error


def in_unit(text: str, unit: str, where: str) -> float:
    """Read a quantity of any dimension, and give it in a unit of reports.

    Raises
    ------
    UsageError
        When it is another kind of quantity than the unit's; `where` says in which definition it stands.
    """
    for dimension in dimensions(text):
        if unit in UNITS[dimension]:
            return from_si(parse_quantity(text, dimension), dimension, unit)
    raise UsageError(f"{where}: `{text}` cannot be given in {unit}; correct its unit")
