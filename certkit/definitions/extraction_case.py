"""The case document: finite-element histories, how parts are grouped, and what lies between the groups."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from certkit.definitions.base import Section
from certkit.definitions.history_formats import TABLE, Format
from certkit.definitions.loading.faults import Faults
from certkit.definitions.part_selection import Box, IdRange
from certkit.definitions.provenance import Length, Mass, Ratio, Time

_OF_A_TABLE = ("time", "parts", "nodes", "contacts", "springs")
"""Keys of the histories that name columns: solvers' files have names of their own."""

_MAPPING_NEEDED = "a tidy csv needs `parts`: which column holds which part's momentum"


class RigidBody(Section):
    """What the files do not say about a rigid body, whose own history row is all zero."""

    mass: Mass
    node: Annotated[str, Field(description="Its main node, whose velocity it has.")]


class PartColumns(Section):
    """Columns of one part in a tidy CSV; a `*` in its name and in the columns stands for the same words."""

    mass: Mass | None = None
    momentum: str | None = None
    velocity: Annotated[
        str | None,
        Field(description="Of the centre of gravity; times the mass it replaces `momentum`."),
    ] = None
    displacement: Annotated[
        str | None, Field(description="Of the centre of gravity; the integral of `velocity` when missing.")
    ] = None
    front: Annotated[str | None, Field(description="Mean displacement of its front.")] = None

    @model_validator(mode="after")
    def _one_of_them(self) -> PartColumns:
        if self.momentum is not None and self.velocity is not None:
            raise Faults([(("velocity",), "stands beside `momentum`; keep one of them")])
        return self


class ContactColumns(Section):
    """Columns of one contact in a tidy CSV."""

    impulse: Annotated[str | None, Field(description="The integral of `force` when missing.")] = None
    force: str | None = None

    @model_validator(mode="after")
    def _one_of_both(self) -> ContactColumns:
        if self.impulse is None and self.force is None:
            raise ValueError("a contact needs `impulse` or `force`")
        return self


class SpringColumns(Section):
    """Columns of one spring to the ground in a tidy CSV; the force is the one on the ground."""

    force: str
    shortening: str | None = None


class HistoryFiles(Section):
    """The solver's files and how to read them."""

    format: Format
    folder: Annotated[str | None, Field(description="Relative to the case file; `--data` replaces it.")] = (
        None
    )
    files: Annotated[list[str], Field(min_length=1, max_length=20)]
    units: Annotated[str, Field(description="Mass, length and time, such as `kg mm ms`.")] = "kg mm ms"
    rigid_bodies: Annotated[dict[str, RigidBody], Field(description="Not for a tidy CSV.")] = {}
    time: Annotated[str, Field(description="Column of the time in a tidy CSV.")] = "time_ms"
    parts: Annotated[dict[str, PartColumns], Field(description="Only for a tidy CSV.")] = {}
    nodes: Annotated[dict[str, str], Field(description="Column by node name, only for a tidy CSV.")] = {}
    contacts: Annotated[dict[str, ContactColumns], Field(description="Only for a tidy CSV.")] = {}
    springs: Annotated[dict[str, SpringColumns], Field(description="Only for a tidy CSV.")] = {}
    table: Annotated[str | None, Field(description="CSV with mass and face of each part, by `group`.")] = None
    outlines: Annotated[str | None, Field(description="JSON with the front's outlines (x, z) in mm.")] = None

    node_motion: Annotated[
        str | None,
        Field(
            description="CSV of time_ms, node, line, x_mm, z_mm; without it `animation*.csv` if there is one."
        ),
    ] = None

    @model_validator(mode="after")
    def _mapped(self) -> HistoryFiles:
        if self.format == TABLE:
            if not self.parts:
                raise ValueError(_MAPPING_NEEDED)
            if self.rigid_bodies:
                said = f"`rigid bodies` are for solvers' files; a {TABLE} has a `mass` in each of its `parts`"
                raise Faults([(("rigid bodies",), said)])
            return self
        columns = [key for key in _OF_A_TABLE if key in self.model_fields_set]
        if columns:
            said = f"is for a {TABLE} alone, but the format is `{self.format}`; leave it out"
            raise Faults([((key,), f"`{key}` {said}") for key in columns])
        return self


class CaseGroup(Section):
    """A set of parts that moves as one mass in the lumped front."""

    kind: Annotated[
        Literal["impactor", "fascia", "hood", "engine room"],
        Field(description="The impactor brings the momentum; it is no part of the vehicle."),
    ]
    parts: Annotated[list[str], Field(description="Names, or patterns such as `F1_*`.")] = []
    boxes: Annotated[
        list[Box], Field(max_length=200, description="All parts whose centre lies in one at the start.")
    ] = []
    ids: Annotated[
        list[IdRange], Field(max_length=1000, description="All parts of these ids: `2005`, `1000-1999`.")
    ] = []
    moves_with: Annotated[
        list[str] | Literal["front", "centre of gravity"] | None,
        Field(description="Nodes or rule; fascia: front, otherwise: centre of gravity."),
    ] = None
    moves_with_box: Annotated[
        Box | None, Field(description="The mean of all recorded nodes that lie in it at the start.")
    ] = None
    low: Annotated[Length | None, Field(description="Lower end of its face above the ground.")] = None
    high: Length | None = None
    position: Annotated[Length | None, Field(description="x of its face at mid-height.")] = None
    slope: Ratio | None = None

    @model_validator(mode="after")
    def _has_parts(self) -> CaseGroup:
        if not (self.parts or self.boxes or self.ids):
            raise ValueError("a group needs `parts`, `boxes` or `ids`")
        if self.moves_with is not None and self.moves_with_box is not None:
            raise Faults([(("moves with box",), "stands beside `moves with`; keep one of them")])
        return self


class Path(Section):
    """A load path: what pushes from the first group to the second, and how its force is known."""

    between: Annotated[list[str], Field(min_length=2, max_length=2)]
    contact: Annotated[
        list[str] | str | None, Field(description="Recorded contact in this path; of several the sum.")
    ] = None
    spring: Annotated[
        list[str] | str | None,
        Field(description="Recorded spring to the ground in this path; of several the sum."),
    ] = None
    tension: Annotated[bool, Field(description="Whether it can also pull: sheets, bolts.")] = False
    law: Annotated[bool, Field(description="False: no stiffness is wanted, the groups touch freely.")] = True
    start: Annotated[Length | None, Field(description="Initial clearance, where the geometry tells it.")] = (
        None
    )

    @property
    def name(self) -> str:
        """Return `F4 – E2`."""
        return f"{self.between[0]} – {self.between[1]}"


class Material(Section):
    """The block between two groups whose stress–strain curve the recovered stiffness is compared with."""

    path: Annotated[list[str], Field(min_length=2, max_length=2)]
    length: Annotated[Length, Field(description="Along the impact, before crush.")]
    area: Annotated[str, Field(description="Quantity such as `40000 mm²`.")]
    curve: Annotated[str | None, Field(description="CSV of engineering strain and stress in MPa.")] = None
    strain_from: Annotated[float, Field(ge=0, le=1)] = 0.12
    faces: Annotated[
        list[str], Field(description="Nodes spread over the front face: must move alike, else no conversion.")
    ] = []


class Settings(Section):
    """How forces are derived from impulses."""

    smoothing: Annotated[Time | None, Field(description="Window of the cubic smoothing; default 1 ms.")] = (
        None
    )
    until: Annotated[Time | None, Field(description="Only histories up to here are used.")] = None
    unloading: Annotated[
        Literal["force", "energy"],
        Field(
            description="What unloading has to repeat: the force at best, or the energy that comes back, too."
        ),
    ] = "force"
    movement_limit: Annotated[
        float,
        Field(gt=0, le=1000, description="Per cent of its largest movement by which a face may err (rms)."),
    ] = 50.0
    check_until: Annotated[
        Time | None,
        Field(description="End of the self-checks on the run's clock; 44 ms after contact when missing."),
    ] = None
    closure_limit: Annotated[
        float, Field(gt=0, le=100, description="Per cent of a path's impulse above which it is warned of.")
    ] = 2.0


class Case(Section):
    """A finite-element run to be turned into a lumped front."""

    case: Annotated[str, Field(description="Its name.")]
    title: str
    vehicle: Annotated[str | None, Field(description="Name of the vehicle that is written.")] = None
    histories: HistoryFiles
    groups: Annotated[
        dict[str, CaseGroup],
        Field(
            max_length=200, description="Two at least; `certkit extract --propose` writes a first grouping."
        ),
    ] = {}
    paths: Annotated[list[Path], Field(max_length=2000)] = []
    material: Material | None = None
    settings: Settings = Settings()
    notes: list[str] = []
