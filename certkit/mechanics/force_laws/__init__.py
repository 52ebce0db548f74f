"""The force laws, in the order in which the kernel walks them."""

from certkit.mechanics.force_laws import (
    condyle_contact,
    flesh_compression,
    flesh_suspension,
    honeycomb,
    joint_spring,
    ligament_cable,
    loading_ram_force,
    ram_nose_contact,
    sliding_guide,
    support_roller,
    vehicle_front_contact,
    vehicle_spring,
)
from certkit.mechanics.force_laws.law import Law

LAWS: tuple[Law, ...] = (
    joint_spring.LAW,
    ligament_cable.LAW,
    condyle_contact.LAW,
    flesh_suspension.LAW,
    flesh_compression.LAW,
    honeycomb.LAW,
    support_roller.LAW,
    loading_ram_force.LAW,
    ram_nose_contact.LAW,
    vehicle_front_contact.LAW,
    vehicle_spring.POINTS,
    vehicle_spring.LAW,
    sliding_guide.LAW,
)
BENDING, CABLES, CONDYLES, FLESH, CUSHION, CRUSH, SUPPORTS, LOADING, NOSE, FRONT, POINTS, SPRINGS, GUIDE = (
    range(len(LAWS))
)

# Two more books beside those of the laws.
GRAVITY, DRAG = len(LAWS), len(LAWS) + 1
BOOKS: tuple[str, ...] = (*(law.name for law in LAWS), "gravity", "mass damping")
