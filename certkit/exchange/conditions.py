"""Conditions of a test (temperature, speed, …) as files tell them: SI, by the words of the procedures."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from certkit.errors import DataError
from certkit.exchange.data_units import quantity, quantity_of_any_dimension

if TYPE_CHECKING:
    from certkit.definitions.channel_mapping import Mapping
    from certkit.exchange.codes import CodeTable
    from certkit.exchange.measured import Leniency
    from certkit.exchange.mme_header import Header

_COMMENT = re.compile(r"([A-Za-z][A-Za-z ]{1,60}?)\s*=\s*(.+)")


def read_condition(word: str, text: str, table: CodeTable) -> float:
    """Read a condition such as `20.5 degC`; the table tells its dimension, else its unit does.

    Raises
    ------
    ValueError
        When it is no quantity.
    """
    known = table.conditions.get(word)
    return quantity(text, known.dimension) if known else quantity_of_any_dimension(text)


def mme_conditions(header: Header, table: CodeTable, leniency: Leniency) -> dict[str, float]:
    """Collect the conditions of a `.mme` file.

    They stand behind descriptors of the table, and in comments such as `release angle = 15 deg`.

    Raises
    ------
    DataError
        When a descriptor of the table or a comment `known word = …` holds no quantity.
    """
    found = {}
    for word, condition in table.conditions.items():
        line = header.find(condition.descriptor) if condition.descriptor else None
        if line is None:
            continue
        try:
            found[word] = quantity(line.value, condition.dimension, condition.unit)
        except ValueError as error:
            leniency.depart(header.at(line), f"`{line.descriptor}`: {error}", f"the {word} is unknown")
    for line in header.all("Comments"):
        match = _COMMENT.fullmatch(line.value)
        if match is None:
            continue
        word = match.group(1)
        try:
            found[word] = read_condition(word, match.group(2), table)
        except ValueError as error:
            if word in table.conditions:
                raise DataError(f"{header.at(line)}: {word}: {error}") from error
    return found


def mapped_conditions(mapping: Mapping | None, table: CodeTable) -> dict[str, float]:
    """Return the conditions that a mapping file tells.

    Raises
    ------
    DataError
        When one is no quantity.
    """
    found = {}
    for word, text in (mapping.conditions if mapping else {}).items():
        try:
            found[word] = read_condition(word, text, table)
        except ValueError as error:
            raise DataError(
                f"mapping `{mapping.mapping if mapping else ''}`, condition {word}: {error}"
            ) from error
    return found
