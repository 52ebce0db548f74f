"""The channels of a Flex-PLI test: their short names and the words of the field.

Their ISO-MME codes stand in one table, `certkit/exchange/flex-pli.yaml`, which a laboratory can override.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Dimension:
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


@dataclass(frozen=True)
class ChannelKind:
    """What a channel of this name is.

    Parameters
    ----------
    name : str
        Short name, as in `result.json` and in column heads: `T1`, `MCL`, `ram force`.
    title : str
        The words a procedure uses: `tibia moment 1`.
    dimension : Dimension
        Its dimension and units.
    """

    name: str
    title: str
    dimension: Dimension


_KINDS = (
    ChannelKind("F1", "femur moment 1", MOMENT),
    ChannelKind("F2", "femur moment 2", MOMENT),
    ChannelKind("F3", "femur moment 3", MOMENT),
    ChannelKind("T1", "tibia moment 1", MOMENT),
    ChannelKind("T2", "tibia moment 2", MOMENT),
    ChannelKind("T3", "tibia moment 3", MOMENT),
    ChannelKind("T4", "tibia moment 4", MOMENT),
    ChannelKind("MCL", "MCL elongation", ELONGATION),
    ChannelKind("LCL", "LCL elongation", ELONGATION),
    ChannelKind("ACL", "ACL elongation", ELONGATION),
    ChannelKind("PCL", "PCL elongation", ELONGATION),
    ChannelKind("knee acceleration", "knee acceleration", ACCELERATION),
    ChannelKind("knee bend", "knee bending angle", ANGLE),
    ChannelKind("knee shear", "knee shear displacement", DISPLACEMENT),
    ChannelKind("contact force", "contact force", FORCE),
    ChannelKind("hinge force", "hinge force", FORCE),
    ChannelKind("ram force", "ram force", FORCE),
    ChannelKind("ram travel", "ram travel", DISPLACEMENT),
    ChannelKind("mid moment", "moment at mid-span", MOMENT),
    ChannelKind("mid deflection", "deflection at mid-span", DISPLACEMENT),
)

CHANNELS = MappingProxyType({kind.name: kind for kind in _KINDS})


def channel_kind(words: str) -> ChannelKind | None:
    """Find a channel kind by its short name or by the words of the field, or return None."""
    if words in CHANNELS:
        return CHANNELS[words]
    return next((kind for kind in _KINDS if kind.title == words), None)
