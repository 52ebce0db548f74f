"""Channels of a test: their short names, the words of the field, their dimensions and what is known of them.

Those of a legform are data of that legform (`certkit.definitions.legform`), those of the rig
are declared by its fixtures (`certkit.definitions.fixtures`).
"""

from __future__ import annotations

from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Mapping


class Dimension(Struct, frozen=True):
    """A physical dimension: its SI unit and the unit that people of the field read.

    Parameters
    ----------
    name : str
        Its name.
    si : str
        Unit of the stored values.
    unit : str
        Unit at the borders: reports, tables, CSV heads.
    scale : float
        Shown value = stored value × scale.
    """

    name: str
    si: str
    unit: str
    scale: float

    @property
    def quantity(self) -> str:
        """Key of `certkit.definitions.units.UNITS` that its values are written in."""
        return "length" if self.name in {"elongation", "displacement"} else self.name


MOMENT = Dimension("moment", "N·m", "N·m", 1.0)
ELONGATION = Dimension("elongation", "m", "mm", 1e3)
FORCE = Dimension("force", "N", "N", 1.0)
ACCELERATION = Dimension("acceleration", "m/s²", "m/s²", 1.0)
ANGLE = Dimension("angle", "rad", "deg", 57.29577951308232)
DISPLACEMENT = Dimension("displacement", "m", "mm", 1e3)
SPEED = Dimension("speed", "m/s", "m/s", 1.0)
ENERGY = Dimension("energy", "J", "J", 1.0)
TIME = Dimension("time", "s", "ms", 1e3)

DIMENSIONS = MappingProxyType(
    {d.name: d for d in (MOMENT, ELONGATION, FORCE, ACCELERATION, ANGLE, DISPLACEMENT, SPEED, ENERGY, TIME)}
)


class ChannelKind(Struct, frozen=True):
    """What a channel of this name is.

    Parameters
    ----------
    name : str
        Short name, as in `result.json` and in column heads: `T1`, `MCL`, `ram force`.
    title : str
        The words a procedure uses: `tibia moment 1`.
    dimension : Dimension
        Its dimension and units.
    codes : tuple of str
        Patterns of its ISO-MME code, `?` for any character; the first is the one that is written.
    amplitude_class : float, optional
        Channel amplitude class (ISO 6487), SI: the channel clips there.
    sign : {1, -1, 0}
        Sign of its largest value in a certification test; 0 where it may have either.
    part : str
        Of a bending moment: the part it is measured in, which its neighbours share.
    usual : float, optional
        What it usually shows beside the others of its dimension, SI.
    """

    name: str
    title: str
    dimension: Dimension
    codes: tuple[str, ...] = ()
    amplitude_class: float | None = None
    sign: int = 0
    part: str = ""
    usual: float | None = None


class ChannelTable(Struct, frozen=True, dict=True):
    """The channels that a test of one legform can have.

    Parameters
    ----------
    legform, impactor : str
        Name of its definition, and of the impactor that corridors are made for.
    fine_location : str
        Fine location 3 of its ISO-MME codes (characters 11 and 12).
    kinds : mapping of str to ChannelKind
        By short name, in the order in which channels are listed.
    bone : tuple of str
        Bending moments that end the assessment interval.
    flight : tuple of str
        Bending moments that show the noise in free flight.
    contact : tuple of str
        Channels that show first contact, the quickest first.
    """

    legform: str
    impactor: str
    fine_location: str
    kinds: Mapping[str, ChannelKind]
    bone: tuple[str, ...] = ()
    flight: tuple[str, ...] = ()
    contact: tuple[str, ...] = ()

    def find(self, words: str) -> ChannelKind | None:
        """Return the channel of that short name or of these words of the field, or None."""
        if words in self.kinds:
            return self.kinds[words]
        return self._titled.get(words)

    @cached_property
    def _titled(self) -> dict[str, ChannelKind]:
        """Return the channels by their words of the field; the first of those that share theirs."""
        found: dict[str, ChannelKind] = {}
        for kind in self.kinds.values():
            found.setdefault(kind.title, kind)
        return found

    def name(self, words: str) -> str:
        """Return a channel's short name; what is no channel comes back as it is."""
        kind = self.find(words)
        return words if kind is None else kind.name

    def dimension(self, name: str, unit: str) -> Dimension | None:
        """Return the dimension of a channel that is shown in `unit`; that of the unit where it is unknown."""
        kind = self.kinds.get(name)
        if kind is not None and kind.dimension.unit == unit:
            return kind.dimension
        return next((d for d in DIMENSIONS.values() if d.unit == unit), None)
