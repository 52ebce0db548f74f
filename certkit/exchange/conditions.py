"""Conditions of a test (temperature, speed, …) as files tell them: SI, by the words of the procedures."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.data_units import quantity, quantity_of_any_dimension

if TYPE_CHECKING:
    from collections.abc import Mapping as Lookup

    from certkit.definitions.channel_mapping import Mapping
    from certkit.exchange.codes import CodeTable
    from certkit.exchange.leniency import Leniency
    from certkit.exchange.mme_header import Header

_NEAR = 1e-3
"""Relative difference of two numbers that counts as rounding."""
_NEAR_KELVIN = 0.051
"""Likewise for temperatures, K: they are written with one digit after the point."""

_COMMENT = re.compile(r"([A-Za-z][A-Za-z ]{1,60}?)\s*[=:]\s*(.+)")

_OTHER_WORDS = {
    f"{word} temperature": "temperature"
    for word in ("ambient", "room", "test", "air", "laboratory", "reference")
} | {"relative humidity": "humidity", "air humidity": "humidity", "relative air humidity": "humidity"}
"""Other words for conditions, in comments and descriptors."""


class Told(Struct, frozen=True):
    """A condition's value, SI, and the place that tells it."""

    value: float
    place: str


def together(*tellings: Lookup[str, Told]) -> dict[str, Told]:
    """Join what several places tell of a test's conditions; the first that tells a condition counts.

    Raises
    ------
    DataError
        When two places contradict each other, with both.
    """
    joined: dict[str, Told] = {}
    for telling in tellings:
        for word, told in telling.items():
            _add(joined, word, told)
    return joined


def _add(joined: dict[str, Told], word: str, told: Told) -> None:
    """Add one condition, which must not contradict what was told of it before."""
    first = joined.setdefault(word, told)
    near = _NEAR_KELVIN if word.endswith("temperature") else 0.0
    if not math.isclose(first.value, told.value, rel_tol=0.0 if near else _NEAR, abs_tol=near):
        raise DataError(
            f"{told.place}: {word} is {told.value:.6g} here and {first.value:.6g} in {first.place} "
            "(SI units); correct one of them"
        )


def read_condition(word: str, text: str, table: CodeTable) -> float:
    """Read a condition such as `20.5 degC`; the table tells its dimension, else its unit does.

    Raises
    ------
    ValueError
        When it is no quantity.
    """
    known = table.conditions.get(word)
    return quantity(text, known.dimension) if known else quantity_of_any_dimension(text)


def mme_conditions(header: Header, table: CodeTable, leniency: Leniency) -> dict[str, Told]:
    """Collect the conditions of a `.mme` file.

    They stand behind descriptors of the table, and in comments such as `release angle = 15 deg`.

    Raises
    ------
    DataError
        When a descriptor of the table or a comment `known word = …` holds no quantity, or when two lines
        contradict each other.
    """
    found: dict[str, Told] = {}
    for word, condition in table.conditions.items():
        line = header.find(condition.descriptor) if condition.descriptor else None
        if line is None:
            continue
        try:
            value = quantity(line.value, condition.dimension, condition.unit)
        except ValueError as error:
            leniency.depart(header.at(line), f"`{line.descriptor}`: {error}", f"the {word} is unknown")
        else:
            _add(found, word, Told(value, header.at(line)))
    for line in header.all("Comments"):
        match = _COMMENT.fullmatch(line.value)
        if match is None:
            continue
        word = known_word(match.group(1), table)
        try:
            value = read_condition(word, match.group(2), table)
        except ValueError as error:
            if word in table.conditions:
                raise DataError(f"{header.at(line)}: {word}: {error}; correct the comment") from error
        else:
            _add(found, word, Told(value, header.at(line)))
    return found


def mapped_conditions(mapping: Mapping | None, table: CodeTable) -> dict[str, Told]:
    """Return the conditions that a mapping file tells.

    Raises
    ------
    DataError
        When one is no quantity.
    """
    found = {}
    for word, text in (mapping.conditions if mapping else {}).items():
        place = f"mapping `{mapping.mapping if mapping else ''}`, condition {word}"
        try:
            found[word] = Told(read_condition(word, text, table), place)
        except ValueError as error:
            raise DataError(f"{place}: {error}; correct it in the mapping file") from error
    return found


def known_word(word: str, table: CodeTable) -> str:
    """Return the condition that a word means, whatever its capitals and blanks."""
    plain = " ".join(word.split()).casefold()
    plain = _OTHER_WORDS.get(plain, plain)
    return plain if plain in table.conditions else word
