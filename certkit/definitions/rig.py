"""The fixtures of a rig. A procedure is a combination of them; the mechanics room knows them one by one."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from certkit.definitions.base import Section
from certkit.definitions.provenance import (
    Angle,
    Force,
    Length,
    Mass,
    Pressure,
    Speed,
    Stiffness,
)

End = Literal["femur end", "tibia end"]


class Hinge(Section):
    """A pin that holds one end of the leg to the rig, beyond the end by `offset`."""

    at: End
    offset: Length


class AddedMass(Section):
    """A mass fixed to one end of the leg, beyond the end by `offset`."""

    at: End
    offset: Length
    mass: Mass


class Release(Section):
    """The leg is let go at an angle above the horizontal and swings down about the hinge."""

    angle: Angle
    start: Annotated[
        Literal["at contact", "full swing"],
        Field(description="`at contact` starts with the speed that the fall gives; same peaks, less time."),
    ] = "at contact"


class Stopper(Section):
    """The bar that stops the swinging leg: a band of `height` around a point below the knee centre."""

    below_knee_centre: Length
    height: Length
    stiffness: Annotated[Stiffness | None, Field(description="Of the cover; rigid when missing.")] = None


class Hanger(Section):
    """What the leg hangs from in the inverse test."""

    at: End
    offset: Annotated[
        Length | None, Field(description="From the end out to the pin; at the end itself when missing.")
    ] = None
    hold: Annotated[Literal["pinned", "free"], Field(description="What it does during the impact.")] = (
        "pinned"
    )


class Ram(Section):
    """A moving mass with a honeycomb face that is crushed at constant pressure."""

    mass: Mass
    speed: Speed
    crush_strength: Pressure
    height: Length
    depth: Length
    top_edge: Annotated[Length, Field(description="Height of its upper edge above the knee centre.")]
    width_on_knee: Annotated[Length, Field(description="Contact width where it meets the knee.")]
    width_on_bones: Annotated[Length, Field(description="Contact width where it meets a bone.")]
    elastic_depth: Annotated[
        Length | None,
        Field(description="Depth at which the honeycomb reaches its crush strength; 1 mm when missing."),
    ] = None


class Supports(Section):
    """Two rollers that stay where they are in space while the specimen slides over them."""

    span: Length


class LoadingRam(Section):
    """A ram that presses at mid-span in a staircase of force levels, each held until all is at rest."""

    force: Annotated[Force, Field(description="Highest level.")]
    levels: Annotated[int, Field(ge=1, le=1000)] = 20


class FreeFlight(Section):
    """The leg flies against the vehicle."""

    speed: Speed
    end_above_ground: Annotated[Length, Field(description="Height of the tibia end above the ground.")]
    angle: Angle


class Rig(Section):
    """All fixtures that certkit knows; a procedure names those it needs."""

    hinge: Hinge | None = None
    added_mass: AddedMass | None = None
    release: Release | None = None
    stopper: Stopper | None = None
    hanger: Hanger | None = None
    ram: Ram | None = None
    supports: Supports | None = None
    loading_ram: LoadingRam | None = None
    free_flight: FreeFlight | None = None
