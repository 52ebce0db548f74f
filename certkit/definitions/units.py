"""Quantities as people write them (`5 kg`, `25 mm`, `15 deg`) and as the program uses them: plain SI numbers.

Some sixty units in two dozen dimensions are needed; importing pint for them costs 0.6 s, three times what a
whole simulated test takes, so the table is ours and pint is the oracle of the tests.
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

# Dimension → unit → factor to SI. Temperatures have an offset too and are handled below.
_PI = math.pi
UNITS: MappingProxyType[str, MappingProxyType[str, float]] = MappingProxyType(
    {
        name: MappingProxyType(table)
        for name, table in {
            "length": {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "µm": 1e-6},
            "mass": {"kg": 1.0, "g": 1e-3, "t": 1e3},
            "time": {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "min": 60.0, "h": 3600.0, "d": 86400.0},
            "angle": {"rad": 1.0, "deg": _PI / 180, "°": _PI / 180, "mrad": 1e-3},
            "speed": {"m/s": 1.0, "mm/ms": 1.0, "km/h": 1 / 3.6, "mm/s": 1e-3, "mm/min": 1e-3 / 60},
            "acceleration": {"m/s²": 1.0, "g": 9.80665, "mm/ms²": 1e3},
            "force": {"N": 1.0, "kN": 1e3},
            "moment": {"N·m": 1.0, "kN·m": 1e3, "N·mm": 1e-3},
            "stiffness": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3, "kN/mm": 1e6},
            "damping": {"N·s/m": 1.0, "kN·s/m": 1e3, "N·s/mm": 1e3},
            "rotational stiffness": {"N·m/rad": 1.0, "kN·m/rad": 1e3, "N·m/deg": 180 / _PI},
            "rotational damping": {"N·m·s/rad": 1.0},
            "bending stiffness": {"N·m²": 1.0},
            "inertia": {"kg·m²": 1.0, "kg·mm²": 1e-6, "g·m²": 1e-3},
            "pressure": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "psi": 6894.757293168361},
            "foundation stiffness": {"N/m²": 1.0, "kN/m²": 1e3, "MN/m²": 1e6},  # force per length and depth
            "line load": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3},
            "frequency": {"Hz": 1.0, "kHz": 1e3},
            "energy": {"J": 1.0, "kJ": 1e3},
            "temperature": {"K": 1.0, "degC": 1.0, "°C": 1.0},
            "temperature difference": {"K": 1.0},
            "ratio": {"": 1.0, "%": 1e-2},
            "count": {"": 1.0},
        }.items()
    }
)

# Other spellings of the same signs, brought to the ones of the table.
_SPELLINGS = ((" * ", "·"), ("*", "·"), ("⋅", "·"), ("^2", "²"), ("μ", "µ"), ("Nmm", "N·mm"), ("Nm", "N·m"))

LONGEST = 60  # letters of a user's text that a message repeats

_NUMBER = re.compile(r"^\s*([+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*$")


def _canonical(unit: str) -> str:
    for spelling, sign in _SPELLINGS:
        unit = unit.replace(spelling, sign)
    if re.search(r"(?<=[m])2$", unit):
        unit = unit[:-1] + "²"
    return unit


def parse_quantity(text: object, dimension: str) -> float:
    """Turn `25 mm` into 0.025.

    Parameters
    ----------
    text : object
        A string of number and unit; a plain number only where the dimension is a ratio or a count.
    dimension : str
        A key of `UNITS`.

    Returns
    -------
    float
        The value in SI units; temperatures in kelvin.

    Raises
    ------
    ValueError
        When it is no finite number, or has no unit of the dimension; says which units would do.
    """
    units = UNITS[dimension]
    read = split_quantity(text)
    if read is not None and read[1] in units:
        value = read[0] * units[read[1]] + _offset(dimension, read[1])
        if math.isfinite(value):
            return value
        raise ValueError(
            f"`{_short(text)}` is not a finite number; write a number with its unit, such as `25 mm`"
        )
    allowed = ", ".join(u for u in units if u) or "no unit"
    if isinstance(text, bool) or not isinstance(text, (str, int, float)):
        example = f"1 {next(iter(units))}".strip()
        message = f"expected a {dimension} such as `{example}`, not `{_short(text)}`"
    elif read is None:
        message = f"`{_short(text)}` is not a number with a unit; write a {dimension} in {allowed}"
    else:
        found = f"the unit `{_short(read[1])}`" if read[1] else "no unit"
        message = f"`{_short(text)}` has {found}; a {dimension} is written in {allowed}"
    raise ValueError(message)


def from_si(value: float, dimension: str, unit: str) -> float:
    """Return an SI value in a unit of its dimension; both are keys of `UNITS`."""
    return (value - _offset(dimension, unit)) / UNITS[dimension][unit]


def _offset(dimension: str, unit: str) -> float:
    return 273.15 if dimension == "temperature" and unit in {"degC", "°C"} else 0.0


def split_quantity(text: object) -> tuple[float, str] | None:
    """Cut `25 mm` into 25.0 and `mm`; None when it is neither a number nor a text that begins with one."""
    if isinstance(text, bool) or not isinstance(text, (str, int, float)):
        return None
    return _cut(str(text))


@lru_cache(maxsize=4096)
def _cut(text: str) -> tuple[float, str] | None:
    """Cut a text likewise; every run of a study reads the same limits and classes."""
    match = _NUMBER.match(text)
    return None if match is None else (float(match.group(1)), _canonical(match.group(2)))


def _short(text: object) -> str:
    said = str(text)
    return said if len(said) <= LONGEST else f"{said[:LONGEST]}…"


def unit_of(text: str) -> str:
    """Return the unit that a quantity is written in; empty where it has none."""
    read = split_quantity(text)
    return "" if read is None else read[1]


def dimensions(text: object) -> list[str]:
    """Return what a text can be a quantity of: `25 mm` of length, `3 g` of mass or acceleration."""
    read = split_quantity(text)
    if read is None or not math.isfinite(read[0]):
        return []
    return [dimension for dimension, units in UNITS.items() if read[1] in units]


def alike(texts: Sequence[str]) -> tuple[list[float], list[tuple[int, str]]]:
    """Read quantities that have to be of one kind, though nobody says of which.

    Parameters
    ----------
    texts : sequence of str
        Such as `235 N·m`, `0.272 kN·m`.

    Returns
    -------
    tuple of list
        The SI values, and (index, what is wrong) of each text that is no quantity or of another kind than
        those before; there are values only when nothing is wrong.
    """
    common: list[str] = []
    wrong = []
    for index, text in enumerate(texts):
        found = dimensions(text)
        shared = [dimension for dimension in found if not common or dimension in common]
        if not found:
            wrong.append((index, f"`{text}` is not a number with a unit that certkit knows"))
        elif not shared:
            kinds = " or ".join(common)
            wrong.append((index, f"`{text}` is another kind of quantity than the {kinds} before it"))
        else:
            common = shared
    return ([] if wrong else [parse_quantity(text, common[0]) for text in texts]), wrong
