"""Names of what OpenRadioss' native time history numbers: variables, and kinds of objects.

What is accumulated over time in the file, and has to be differentiated, is told by kind and name.
"""

from __future__ import annotations

GLOBALS: tuple[str, ...] = (
    *("internal", "kinetic", "x momentum", "y momentum", "z momentum", "mass", "time step", "rotation"),
    *("external work", "spring", "contact", "hourglass", "elastic contact", "frictional contact"),
    *("damping contact", "plastic work", "added mass", "percentage added mass", "inlet mass", "outlet mass"),
    *("inlet energy", "outlet energy"),
)
"""Global variables by their number, from 1 on."""

ENERGIES = frozenset(
    name for name in GLOBALS if not name.endswith(("momentum", "mass")) and name != "time step"
)

PART_VARIABLES = {
    1: "IE", 2: "KE", 3: "XMOM", 4: "YMOM", 5: "ZMOM", 6: "MASS", 7: "HE", 8: "TURBKE", 9: "XCG", 10: "YCG",
    11: "ZCG", 12: "XXMOM", 13: "YYMOM", 14: "ZZMOM", 15: "IXX", 16: "IYY", 17: "IZZ", 18: "IXY", 19: "IYZ",
    20: "IZX", 21: "RIE", 22: "KERB", 23: "RKERB", 24: "RKE", 25: "ERODED", 28: "HEAT", 29: "VX", 30: "VY",
    31: "VZ", 32: "PW",
}  # fmt: skip

NODE_GROUP, SPRING_GROUP, CONTACT_GROUP, SECTION_GROUP = 0, 6, 101, 104

KINDS = {
    "node": NODE_GROUP,
    "brick": 1,
    "quad": 2,
    "shell": 3,
    "truss": 4,
    "beam": 5,
    "spring": SPRING_GROUP,
    "triangle": 7,
    "contact": CONTACT_GROUP,
    "rigid wall": 102,
    "rigid body": 103,
    "section": SECTION_GROUP,
    "joint": 105,
    "accelerometer": 108,
    "frame": 110,
    "gauge": 113,
}
"""Word of the mapping → number of a group's kind in the file."""

GROUP_VARIABLES = {
    NODE_GROUP: (
        *("DX", "DY", "DZ", "VX", "VY", "VZ", "AX", "AY", "AZ", "VRX", "VRY", "VRZ", "ARX", "ARY", "ARZ"),
        *("X", "Y", "Z", "TEMP"),
    ),
    CONTACT_GROUP: ("FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ"),
}
"""Variables of a kind by their number, from 1 on, where no file of titles names them."""

_REACTIONS = frozenset({"REACX", "REACY", "REACZ", "REACXX", "REACYY", "REACZZ"})
_FORCES = frozenset(
    f"{before}{axis}{after}"
    for axis in "XYZ"
    for before, after in (
        *(("FN", ""), ("FT", ""), ("F", ""), ("M", ""), ("F", "I"), ("M", "I"), ("|FN", "|"), ("|F", "|")),
    )
) | {"||FN||", "||F||"}
_OF_SECTIONS = frozenset({"F1", "F2", "F3", "M1", "M2", "M3"})


def is_impulse(kind: int, variable: str) -> bool:
    """Tell whether a variable is accumulated over time in the file: a force's impulse, a moment's.

    So are forces and moments of interfaces, walls, rigid bodies, sections and joints, and nodes' reactions;
    forces of elements (beams, springs) are not.
    """
    if kind == NODE_GROUP:
        return variable in _REACTIONS
    if kind < CONTACT_GROUP:
        return False
    return variable in _FORCES or (kind == SECTION_GROUP and variable in _OF_SECTIONS)
