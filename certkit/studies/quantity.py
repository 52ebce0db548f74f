"""Quantities of a study in the unit that they are written in, which only the definitions need to know."""

from __future__ import annotations

from certkit.definitions.units import split_quantity
from certkit.errors import UsageError


def number_in(text: str | float, unit: str, name: str) -> float:
    """Return the number of a quantity that has to be in `unit`.

    Raises
    ------
    UsageError
        When it is a word or has another unit.
    """
    found = split_quantity(text)
    if found is None or found[1] != unit:
        wanted = f"in {unit}" if unit else "without a unit"
        raise UsageError(f"{name}: `{text}` should be a number {wanted}, like its neighbours")
    return found[0]


def share(text: str | float) -> float | None:
    """Return 0.1 for `10 %` or `± 10 %`, None for anything else."""
    found = split_quantity(str(text).lstrip("±+- "))
    return found[0] / 100 if found and found[1] == "%" else None


def written(value: float | str, unit: str) -> str:
    """Write a setting as a definition has it, to the last bit."""
    if isinstance(value, str):
        return value
    return f"{value!r} {unit}".rstrip()
