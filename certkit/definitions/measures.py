"""The measures that a criterion can name, and what follows from each for the rest of its definition.

A new measure is one line here and one file in `certkit.grading.measures` that takes it, found by the
measure's words. The two are apart because procedures are read and checked without measuring anything.
"""

from __future__ import annotations

from types import MappingProxyType

from msgspec import Struct

from certkit.definitions.corridor_set import Band, Polygon, ValueWindow


class MeasureKind(Struct, frozen=True):
    """What a measure asks of a criterion, and what its value is.

    Parameters
    ----------
    corridor : type
        What it is held against.
    needs : tuple of str
        Keys of the criterion that it cannot do without.
    quantity : str
        Key of `certkit.definitions.units.UNITS` that its value is written in; the channel's when empty.
    magnitude : bool
        Whether its value has lost the channel's sign.
    """

    corridor: type[ValueWindow | Polygon | Band] = ValueWindow
    needs: tuple[str, ...] = ("channel",)
    quantity: str = ""
    magnitude: bool = False


MEASURES = MappingProxyType(
    {
        "max": MeasureKind(),
        "min": MeasureKind(),
        "max abs": MeasureKind(magnitude=True),
        "value at": MeasureKind(needs=("channel", "at")),
        "time of max": MeasureKind(quantity="time"),
        "curve in polygon": MeasureKind(corridor=Polygon, needs=("curve",)),
        "curve in band": MeasureKind(corridor=Band),
    }
)
