"""The channels of a Flex-PLI test: their short names, the words of the field, and their ISO-MME codes.

The codes resolve part by part in the ISO/TS 13499 tables (fine location `PF`: Flex-PLI); that they are *the*
usual Flex-PLI codes is an estimate, so a laboratory can override them (`certkit.exchange`).
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
        """Key of `certkit.definitions.quantities.UNITS` that its values are written in."""
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
    code : str
        ISO-MME channel code with filter class `0` (unfiltered), empty where there is none.
    """

    name: str
    title: str
    dimension: Dimension
    code: str = ""


_KINDS = (
    ChannelKind("F1", "femur moment 1", MOMENT, "D0FEMRLO00PFMOX0"),
    ChannelKind("F2", "femur moment 2", MOMENT, "D0FEMRMI00PFMOX0"),
    ChannelKind("F3", "femur moment 3", MOMENT, "D0FEMRUP00PFMOX0"),
    ChannelKind("T1", "tibia moment 1", MOMENT, "D0TIBIUP00PFMOX0"),
    ChannelKind("T2", "tibia moment 2", MOMENT, "D0TIBIMIUPPFMOX0"),
    ChannelKind("T3", "tibia moment 3", MOMENT, "D0TIBIMILOPFMOX0"),
    ChannelKind("T4", "tibia moment 4", MOMENT, "D0TIBILO00PFMOX0"),
    ChannelKind("MCL", "MCL elongation", ELONGATION, "D0KNEEMC00PFDC00"),
    ChannelKind("LCL", "LCL elongation", ELONGATION, "D0KNEELC00PFDC00"),
    ChannelKind("ACL", "ACL elongation", ELONGATION, "D0KNEEAC00PFDC00"),
    ChannelKind("PCL", "PCL elongation", ELONGATION, "D0KNEEPC00PFDC00"),
    ChannelKind("knee acceleration", "knee acceleration", ACCELERATION, "D0KNEE0000PFACY0"),
    ChannelKind("knee bend", "knee bending angle", ANGLE, "D0KNEE0000PFANX0"),
    ChannelKind("knee shear", "knee shear displacement", DISPLACEMENT, "D0KNEE0000PFDSY0"),
    ChannelKind("contact force", "contact force", FORCE, "T0IMPA000000FOY0"),
    ChannelKind("hinge force", "hinge force", FORCE, "T0HING000000FOR0"),
    ChannelKind("ram force", "ram force", FORCE, "T0IMPA000000FOZ0"),
    ChannelKind("ram travel", "ram travel", DISPLACEMENT, "T0IMPA000000DSZ0"),
    ChannelKind("mid moment", "moment at mid-span", MOMENT, "C0BONE0000PFMOX0"),
    ChannelKind("mid deflection", "deflection at mid-span", DISPLACEMENT, "C0BONE0000PFDSZ0"),
)

CHANNELS = MappingProxyType({kind.name: kind for kind in _KINDS})


def channel_kind(words: str) -> ChannelKind | None:
    """Find a channel kind by its short name or by the words of the field, or return None."""
    if words in CHANNELS:
        return CHANNELS[words]
    return next((kind for kind in _KINDS if kind.title == words), None)
