"""The channels of a legform: what they measure, what they are called, and how a test of it is evaluated."""

import re
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Section, Sourced
from certkit.definitions.channels import (
    ACCELERATION,
    ANGLE,
    DIMENSIONS,
    DISPLACEMENT,
    ELONGATION,
    MOMENT,
    Dimension,
)
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.provenance import Length

Measured = Literal["bending moment", "elongation", "acceleration", "bending angle", "shear displacement"]
_DIMENSION: dict[str, Dimension] = {
    "bending moment": MOMENT,
    "elongation": ELONGATION,
    "acceleration": ACCELERATION,
    "bending angle": ANGLE,
    "shear displacement": DISPLACEMENT,
}


class LegformChannel(Section):
    """A channel of the legform. What it measures tells its dimension, and the model where it comes from.

    Acceleration, bending angle and shear displacement are the knee's. A channel that the model does not have
    names its `dimension` instead of what it measures: it can be read and graded.
    """

    title: Annotated[str, Field(description="Its words in a procedure, such as `tibia moment 1`.")]
    measures: Measured | None = None
    dimension: str | None = None
    part: Annotated[str | None, Field(description="Of a bending moment: the part it is measured in.")] = None
    from_knee_centre: Annotated[
        Length | None, Field(description="Of a bending moment: distance of the gauge, along the leg.")
    ] = None
    ligament: Annotated[str | None, Field(description="Of an elongation: the ligament.")] = None
    codes: Annotated[
        list[str],
        Field(description="ISO-MME codes, 16 characters, `?` for any; the first one is written."),
    ] = []

    @property
    def kind(self) -> Dimension:
        """Return its dimension."""
        return _DIMENSION[self.measures] if self.measures else DIMENSIONS[self.dimension or ""]

    @model_validator(mode="after")
    def _whole(self) -> Self:
        faults: list[Fault] = []
        for index, code in enumerate(self.codes):
            if not re.fullmatch(r"[A-Z0-9?]{16}", code):
                message = f"`{code}` is no code of 16 characters; use A to Z, 0 to 9, and `?` for any"
                faults.append((("codes", index), message))
        if (self.measures is None) == (self.dimension is None):
            faults.append(((), "needs what it `measures`, or else its `dimension`"))
        elif self.dimension is not None and self.dimension not in DIMENSIONS:
            hint = suggestion(self.dimension, DIMENSIONS)
            faults.append((("dimension",), f"no dimension is called `{self.dimension}`; {hint}"))
        placed = [self.part is not None, self.from_knee_centre is not None]
        if placed != [self.measures == "bending moment"] * 2:
            faults.append(((), "a bending moment, and nothing else, has `part` and `from knee centre`"))
        if (self.measures == "elongation") != (self.ligament is not None):
            faults.append(((), "an elongation, and nothing else, has a `ligament`"))
        if faults:
            raise Faults(faults)
        return self


class Evaluation(Sourced):
    """What is known of the channels of a test beforehand: how they are conditioned and where they clip."""

    bone_channels: Annotated[
        list[str],
        Field(description="Bending moments whose last zero crossing ends the assessment interval."),
    ] = []
    flight_channels: Annotated[
        list[str],
        Field(
            description="Bending moments whose noise in free flight is looked at; all bones' when missing."
        ),
    ] = []
    contact_channels: Annotated[
        list[str], Field(description="Channels that show first contact, the quickest first.")
    ] = []
    positive: Annotated[
        list[str], Field(description="Channels that are positive in pendulum and inverse tests.")
    ] = []
    negative: Annotated[
        list[str], Field(description="Channels that are negative in pendulum and inverse tests.")
    ] = []
    amplitude_classes: Annotated[
        dict[str, list[str]], Field(description="Where channels clip: `400 N·m: [T1, T2]`.")
    ] = {}
    usual_peaks: Annotated[
        dict[str, str],
        Field(
            description="What channels usually show beside each other, to tell a wrong unit: `T1: 254 N·m`."
        ),
    ] = {}

    def lines(self) -> dict[str, str]:
        """Return the amplitude classes; the rest is words."""
        return {
            f"amplitude classes.{level}": f"{level} for {', '.join(names)}"
            for level, names in self.amplitude_classes.items()
        }
