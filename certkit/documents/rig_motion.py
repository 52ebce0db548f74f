"""The moving picture of a test: what moves and what stands on the rig, where and when."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.documents.consistent_lists import check_lengths
from certkit.documents.output_document import Part
from certkit.documents.rounding import Figure, Figures, Points, Poses, Rows


class Shape(Part):
    """Something that moves or stands in the moving picture: an outline in its own axes, metres.

    `ground` is what is fixed to the laboratory's floor, `ghost` where something was before the test.
    """

    name: str
    kind: Literal["bone", "knee", "flesh", "rig", "ram", "honeycomb", "vehicle", "mass", "ground", "ghost"]
    outline: Points
    closed: bool = True
    note: Annotated[str, Field(description="What the drawing of the rig says beside it: `5 kg`.")] = ""


class Motion(Part):
    """The moving picture, z upwards in the laboratory.

    Shape s in frame f: (x, z, angle) = `poses[f][s]`; `moments[f]` its colours.
    """

    times: Figures
    shapes: list[Shape]
    poses: Poses
    joints: Annotated[list[str], Field(description="Names of what `moments` colours: shape names.")] = []
    moments: Rows = []
    unit: str = "N·m"
    scene: Annotated[list[Shape], Field(description="Shapes that never move, in world axes.")] = []
    before: Annotated[
        list[Shape], Field(description="Where the legform was before the test; in the drawing of the rig.")
    ] = []
    gravity: Annotated[
        Figure | None, Field(description="In the run, m/s² along −z; 0 where it was left out.")
    ] = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse poses that do not belong to the times and shapes."""
        check_lengths(len(self.times), {"poses": self.poses}, "times")
        shapes, joints = len(self.shapes), len(self.joints)
        check_lengths(shapes, {f"poses.{f}": row for f, row in enumerate(self.poses)}, "shapes")
        if self.moments:
            check_lengths(len(self.times), {"moments": self.moments}, "times")
            check_lengths(joints, {f"moments.{f}": row for f, row in enumerate(self.moments)}, "joints")
        return self
