"""The force laws, one file each, in the order in which the time loop evaluates them.

A new law is a new file beside the others and one line here.
"""

from importlib import import_module

from certkit.mechanics.force_laws.law import ForceLaw

_FILES = (
    "joint_spring",
    "ligament_cable",
    "condyle_contact",
    "flesh_suspension",
    "flesh_compression",
    "honeycomb",
    "support_roller",
    "loading_ram_force",
    "ram_nose_contact",
    "vehicle_front_contact",
    "folding_face_contact",
    "vehicle_spring",
    "sheet_link",
    "recorded_contact",
    "sliding_guide",
)


def _law(file: str) -> type[ForceLaw]:
    """Return the law of a file, the class of the file's name."""
    law: type[ForceLaw] = getattr(import_module(f"{__name__}.{file}"), file.title().replace("_", ""))
    return law


LAWS: tuple[type[ForceLaw], ...] = tuple(_law(file) for file in _FILES)

GRAVITY, MASS_DAMPING = len(LAWS), len(LAWS) + 1
ENERGY_ACCOUNTS: tuple[str, ...] = (*(law.words() for law in LAWS), "gravity", "mass damping")
"""Names of the rows of `Totals`: one a law, then weight and mass damping."""
