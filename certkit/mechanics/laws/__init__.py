"""The force laws, in the order in which the kernel walks them."""

from certkit.mechanics.laws import (
    bending,
    cables,
    condyles,
    crush,
    cushion,
    flesh,
    front,
    loading,
    nose,
    spring,
    supports,
)
from certkit.mechanics.laws.table import Law

LAWS: tuple[Law, ...] = (
    bending.LAW,
    cables.LAW,
    condyles.LAW,
    flesh.LAW,
    cushion.LAW,
    crush.LAW,
    supports.LAW,
    loading.LAW,
    nose.LAW,
    front.LAW,
    spring.POINTS,
    spring.LAW,
)
BENDING, CABLES, CONDYLES, FLESH, CUSHION, CRUSH, SUPPORTS, LOADING, NOSE, FRONT, POINTS, SPRINGS = range(
    len(LAWS)
)

# Two more books beside those of the laws.
GRAVITY, DRAG = len(LAWS), len(LAWS) + 1
BOOKS: tuple[str, ...] = (*(law.name for law in LAWS), "gravity", "mass damping")
