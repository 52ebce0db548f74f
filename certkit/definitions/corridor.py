"""Corridor sets: what a value or curve has to stay within, and the limits and scores of vehicle tests."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from certkit.definitions.document import Document, Section
from certkit.definitions.origin import Confidence


class Window(Section):
    """A scalar corridor: `lower` ≤ value ≤ `upper`; either may be missing. Quantities carry the channel's unit."""

    lower: str | None = None
    upper: str | None = None
    source: str | None = None
    confidence: Confidence | None = None


class Polygon(Section):
    """A closed area in the plane of two channels that the curve must stay inside of, up to `until` on the x or y axis.

    Points are pairs of quantities, (x, y).
    """

    x: Annotated[str, Field(description="Channel of the abscissa.")]
    y: Annotated[str, Field(description="Channel of the ordinate.")]
    points: Annotated[list[tuple[str, str]], Field(min_length=3, max_length=10_000)]
    source: str | None = None
    confidence: Confidence | None = None


class Band(Section):
    """A corridor over time: lower and upper polylines of (time, value)."""

    lower: Annotated[list[tuple[str, str]] | None, Field(min_length=2, max_length=10_000)] = None
    upper: Annotated[list[tuple[str, str]] | None, Field(min_length=2, max_length=10_000)] = None
    source: str | None = None
    confidence: Confidence | None = None


class Score(Section):
    """Points on a sliding scale: full points up to `full`, none from `zero` on, linear between."""

    criteria: Annotated[list[str], Field(min_length=1, description="The worst of these criteria counts.")]
    full: str
    zero: str
    points: Annotated[float, Field(gt=0)]
    source: str | None = None
    confidence: Confidence | None = None


class CorridorSet(Section):
    """Corridors of one procedure from one source. Entries inherit the set's `origin` unless they have their own."""

    corridors: Annotated[str, Field(description="Name of the set.")]
    title: str
    windows: dict[str, Window] = {}
    polygons: dict[str, Polygon] = {}
    bands: dict[str, Band] = {}
    scores: dict[str, Score] = {}


class Choice(Document):
    """Placeholder in a procedure for a corridor by its name: `set/entry`."""

    set: str
    entry: str
    kind: Literal["window", "polygon", "band", "score"]
