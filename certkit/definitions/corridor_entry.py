"""What every corridor, limit and score of a set has: an origin, a note, and limits in order."""

from typing import Annotated, ClassVar

from pydantic import Field

from certkit.definitions.base import Sourced
from certkit.definitions.loading.faults import Fault
from certkit.definitions.units import alike


class CorridorEntry(Sourced):
    """One corridor, limit or score; its origin is its own, or the set's."""

    noun: ClassVar[str] = "entry"

    note: Annotated[str | None, Field(description="What a reader of the verdict should know about it.")] = (
        None
    )


def order_faults(low: tuple[str, str | None], high: tuple[str, str | None]) -> list[Fault]:
    """Return what is wrong with two (key, quantity) that should be alike and in order."""
    given = [(key, text) for key, text in (low, high) if text is not None]
    values, wrong = alike([text for _, text in given])
    faults: list[Fault] = [((given[index][0],), said) for index, said in wrong]
    if len(values) == 2 and values[0] > values[1]:
        message = f"{low[0]} {low[1]} lies above {high[0]} {high[1]}; exchange them"
        faults.append(((low[0],), message))
    return faults
