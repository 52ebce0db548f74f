"""The force laws, one file each, in the order in which the time loop evaluates them.

A new law is a new file beside the others and one line here.
"""

from certkit.mechanics.force_laws.law import ForceLaw
from certkit.named_class import named_class

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
    "skinned_foam_contact",
    "vehicle_spring",
    "sheet_link",
    "recorded_contact",
    "sliding_guide",
    "recorded_motion",
    "foam_sleeve",
)


LAWS: tuple[type[ForceLaw], ...] = tuple(named_class(__name__, file) for file in _FILES)

WEIGHT_ACCOUNT, MASS_DAMPING_ACCOUNT = len(LAWS), len(LAWS) + 1
ENERGY_ACCOUNTS: tuple[str, ...] = (*(law.words() for law in LAWS), "gravity", "mass damping")
"""Names of the rows of `Totals`: one a law, then weight and mass damping."""
