"""A vehicle's front and a leg in motion, in the finite-element run and in the model, side by side."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.documents.consistent_lists import check_lengths
from certkit.documents.output_document import Part
from certkit.documents.rounding import Figures, LineFrames, Rows


class MovingLine(Part):
    """A line in the middle plane, its points (x into the car, z above the ground) in m at each instant.

    `leg` is the leg's axis from its lower end upwards, with the bending moment in each piece where it is
    known (N·m); `face` what the leg can touch; `inside` what lies behind, in the model moved as a whole.
    `run` or `model` is empty where nothing is known.
    """

    name: str
    kind: Literal["leg", "face", "inside"]
    closed: bool = False
    run: LineFrames = []
    model: LineFrames = []
    run_moments: Rows = []
    model_moments: Rows = []


class FrontMotion(Part):
    """Lines of run and model at the same instants, s from the run's start."""

    times: Figures
    lines: Annotated[tuple[MovingLine, ...], Field(description="Of the leg, the faces and what is inside.")]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse lines that are not given at each instant, or change their number of points."""
        for line in self.lines:
            for side, frames, moments in (
                ("run", line.run, line.run_moments),
                ("model", line.model, line.model_moments),
            ):
                if frames:
                    check_lengths(len(self.times), {f"{line.name}: {side}": frames}, "times")
                    points = len(frames[0])
                    check_lengths(
                        points, {f"{line.name}: {side}.{f}": p for f, p in enumerate(frames)}, "points"
                    )
                if moments:
                    check_lengths(len(frames), {f"{line.name}: {side}_moments": moments}, "times")
                    pieces = max(len(frames[0]) - 1, 0) if frames else 0
                    rows = {f"{line.name}: {side}_moments.{f}": row for f, row in enumerate(moments)}
                    check_lengths(pieces, rows, "pieces")
        return self
