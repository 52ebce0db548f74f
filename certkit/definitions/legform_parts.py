"""Parts of a legform: bones, knee with ligaments and condyles, flesh; each number with its origin."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Section
from certkit.definitions.bounded_numbers import (
    AngleFromZero,
    ForceFromZero,
    LengthAboveZero,
    LengthFromZero,
    RatioAboveZero,
    RatioFromZero,
    RatioToOne,
    SpeedAboveZero,
    StiffnessAboveZero,
    TimeFromZero,
)
from certkit.definitions.flesh_foam import FleshFoam
from certkit.definitions.loading.faults import Faults
from certkit.definitions.loading.field_types import Axes
from certkit.definitions.provenance import (
    BendingStiffness,
    Damping,
    Force,
    FoundationStiffness,
    Frequency,
    Inertia,
    Length,
    Mass,
    RotationalStiffness,
    Stiffness,
)


class PartJoint(Section):
    """A rotational spring between a part and the next one below it."""

    stiffness: RotationalStiffness
    damping_time: Annotated[TimeFromZero, Field(description="Damping divided by stiffness.")]


class Bone(Section):
    """A part of the leg, such as femur and tibia: rigid segments on pivots with rotational springs."""

    length: LengthAboveZero
    depth: Annotated[LengthAboveZero, Field(description="Outer size along the impact.")]
    segments: Annotated[int, Field(ge=1, le=200)]
    mass: Mass
    centre_of_gravity: Annotated[Length, Field(description="From the top of the part.")]
    inertia: Annotated[Inertia, Field(description="About its own centre of gravity.")]
    bending_stiffness: BendingStiffness
    damping_time: Annotated[TimeFromZero, Field(description="Joint damping divided by joint stiffness.")]
    damper: Annotated[
        Literal["in the core", "beside the core"],
        Field(
            description="Where the damping is: in what the gauges are on, or in links that they do not feel."
        ),
    ] = "in the core"
    block_joint: Annotated[
        RatioAboveZero | None,
        Field(description="How much stiffer the joint at the knee block is; 1 when missing."),
    ] = None
    cable_angle: Annotated[
        AngleFromZero | None,
        Field(description="Joint angle at which the steel cables come tight; never when missing."),
    ] = None
    cable_stiffness: Annotated[
        RotationalStiffness | None, Field(description="Added joint stiffness beyond it.")
    ] = None
    joint: Annotated[
        PartJoint | None,
        Field(description="To the next part below, where that is not the knee; rigid when missing."),
    ] = None

    def spread_fault(self) -> str | None:
        """Return why its mass cannot be a uniform bar of its size with masses at both ends, or None.

        The bar and the ends meet mass, centre of gravity and inertia; none of them may be negative.
        """
        length, depth, centre = float(self.length), float(self.depth), float(self.centre_of_gravity)
        mass, inertia = float(self.mass), float(self.inertia)
        if not 0.0 < centre < length:
            return "its centre of gravity has to lie between its ends"
        below, nearer = length - centre, min(centre, length - centre)
        bar = 2 * mass * nearer / length  # the heaviest: then one end carries nothing
        whole = mass * centre * below  # all mass is at the ends
        most_bar = bar * ((length**2 + depth**2) / 12 + (length / 2 - centre) ** 2) + (mass - bar) * nearer**2
        least, most = sorted((most_bar, whole))
        if least <= inertia <= most:
            return None
        bounds = f"from {least:.3g} to {most:.3g} kg·m²"
        return f"with its mass, size and centre of gravity its inertia has to be {bounds}"


class Ligament(Section):
    """A cable on a preloaded spring: it pulls and never pushes. Points are (x, z), femur side, tibia side."""

    femur: Annotated[list[Length], Axes(("x", "z")), Field(min_length=2, max_length=2)]
    tibia: Annotated[list[Length], Axes(("x", "z")), Field(min_length=2, max_length=2)]
    stiffness: Stiffness
    preload: Annotated[Force, Field(description="At rest; below zero it is slack until it has stretched.")]
    damping: Damping


class Condyles(Section):
    """Two round condyles of the femur block in two troughs of the tibia block."""

    radius: LengthAboveZero
    trough_radius: LengthAboveZero
    offset: Annotated[
        LengthAboveZero, Field(description="Distance of each condyle's middle from the leg's axis.")
    ]
    stiffness: StiffnessAboveZero
    damping: Damping
    friction: RatioFromZero

    @model_validator(mode="after")
    def _fits_in(self) -> Self:
        if self.trough_radius <= self.radius:
            raise Faults([(("trough_radius",), "a trough has a larger radius than the condyle in it")])
        return self


class KneeGuide(Section):
    """A guide against sliding between the knee blocks: free for some way, then a spring."""

    offset: Annotated[Length, Field(description="Distance from the leg's axis, towards the impact side.")]
    free_travel: Annotated[LengthFromZero, Field(description="Either way.")]
    stiffness: Stiffness
    damping: Damping


class Knee(Section):
    """Two rigid blocks in contact, held together by ligaments."""

    between: Annotated[
        list[str], Field(min_length=2, max_length=2, description="The parts above and below it.")
    ]
    mass: Mass
    centre_of_gravity: Annotated[Length, Field(description="From the top of the knee.")]
    inertia: Inertia
    above_centre: Annotated[LengthAboveZero, Field(description="Height of the femur block.")]
    below_centre: Annotated[LengthAboveZero, Field(description="Height of the tibia block.")]
    depth: LengthAboveZero
    condyles: Condyles
    parallel_stiffness: RotationalStiffness
    guide: KneeGuide | None = None
    ligaments: Annotated[dict[str, Ligament], Field(min_length=1, description="By their names, such as MCL.")]


class FarFlesh(Section):
    """Flesh on the side away from the impact, where it is a mass a segment of its own."""

    share: Annotated[RatioToOne, Field(description="Of the flesh's mass; the rest is on the impact side.")]
    across: Annotated[Frequency, Field(description="Natural frequency along the impact.")]
    along: Annotated[Frequency, Field(description="Natural frequency along the bone.")]
    damping_ratio: RatioFromZero
    at_knee: Annotated[
        RatioFromZero | None,
        Field(description="Its mass per length at the knee over that at the bones; 1 when missing."),
    ] = None
    foam: Annotated[
        RatioFromZero | None,
        Field(
            description="Its foam's stress over that of the impact side; it bends along where `foam` does."
        ),
    ] = None


class Flesh(Section):
    """Rubber and neoprene around the bones: a mass a segment on springs, and a layer that can be crushed."""

    mass: Mass
    across: Annotated[Frequency, Field(description="Natural frequency of the flesh along the impact.")]
    along: Annotated[Frequency, Field(description="Natural frequency along the bone.")]
    damping_ratio: RatioFromZero
    tension: Annotated[
        ForceFromZero, Field(description="Tensile stiffness EA between neighbours; 0 leaves it out.")
    ]
    compression: Annotated[
        FoundationStiffness | None,
        Field(description="Initial, per unit length; needed where no `foam` is given."),
    ] = None
    thickness: Annotated[LengthAboveZero, Field(description="Between bone and surface: it ends at the bone.")]
    compacted_at: Annotated[
        LengthAboveZero | None,
        Field(description="Depth at which it is compacted; 90 % of its thickness when missing."),
    ] = None
    wall: Annotated[
        FoundationStiffness | None,
        Field(description="Of the bone behind it, per unit length; 2000 MN/m² when missing."),
    ] = None
    resilience: Annotated[
        RatioToOne | None, Field(description="Share of its work that it gives back; 50 % when missing.")
    ] = None
    reversal_speed: Annotated[
        SpeedAboveZero | None,
        Field(
            description="Of compression, where internal friction has come to three quarters of its full "
            "value; 1 m/s when missing."
        ),
    ] = None
    foam: Annotated[
        FleshFoam | None,
        Field(description="A tabulated foam under a skin; a law by compression and wall when missing."),
    ] = None
    face: Annotated[
        LengthFromZero | None,
        Field(description="Distance of its bone side from the leg's axis; half the parts' depth if missing."),
    ] = None
    bending_stiffness: Annotated[
        BendingStiffness | None,
        Field(description="Of the sleeve, which bends beside the bones; no gauge feels it."),
    ] = None
    damping_time: Annotated[
        TimeFromZero | None, Field(description="Damping of the sleeve's bending divided by its stiffness.")
    ] = None
    far_side: Annotated[
        FarFlesh | None,
        Field(description="Both sides are one mass on the axis when missing, else each in its own middle."),
    ] = None

    @model_validator(mode="after")
    def _has_one_law(self) -> Self:
        if self.foam is None and self.compression is None:
            raise Faults([((), "`compression` is missing; give it, or a `foam`")])
        if self.compacted_at is not None and self.compacted_at >= self.thickness:
            raise Faults([(("compacted_at",), "`compacted at` has to be below `thickness`")])
        if self.foam is not None:
            for name in ("compression", "compacted_at", "wall", "resilience", "reversal_speed"):
                if getattr(self, name) is not None:
                    key = name.replace("_", " ")
                    raise Faults([((name,), f"`{key}` says nothing beside `foam`; leave one of them out")])
            if self.foam.elastic_modulus is not None and self.bending_stiffness is not None:
                message = "the foam's `elastic modulus` lets the sleeve bend already; leave one of them out"
                raise Faults([(("bending_stiffness",), message)])
        return self
