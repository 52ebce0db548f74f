"""A vehicle's front and a leg in motion, in the finite-element run and in the model, side by side."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.documents.consistent_lists import check_lengths, check_sizes
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

    times: Annotated[Figures, Field(min_length=1)]
    lines: Annotated[
        tuple[MovingLine, ...], Field(min_length=1, description="Of the leg, the faces and what is inside.")
    ]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse lines that are not given at each instant, or change their number of points."""
        for line in self.lines:
            _check_side(f"{line.name}: run", line.run, line.run_moments, len(self.times))
            _check_side(f"{line.name}: model", line.model, line.model_moments, len(self.times))
        return self


def _check_side(
    name: str, frames: list[list[tuple[float, float]]], moments: list[list[float]], times: int
) -> None:
    """Refuse a side of a line that cannot be drawn.

    Raises
    ------
    ValueError
        With the frame that does not fit.
    """
    if not frames:
        check_lengths(0, {f"{name}_moments": moments}, "times")
        return
    check_lengths(times, {name: frames}, "times")
    points = len(frames[0])
    if points < 2:
        raise ValueError(f"`{name}` has {points} points; a line has two or more: make the document again")
    check_lengths(points, {f"{name}.{f}": frame for f, frame in enumerate(frames)}, "points")
    check_sizes(name, [value for frame in frames for point in frame for value in point])
    if moments:
        check_lengths(times, {f"{name}_moments": moments}, "times")
        check_lengths(points - 1, {f"{name}_moments.{f}": row for f, row in enumerate(moments)}, "pieces")
        check_sizes(f"{name}_moments", [value for row in moments for value in row])
