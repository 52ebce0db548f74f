"""`ExtractionResult`: everything an extraction found, as plain data that a report is rendered from.

Values are SI unless a name says otherwise. Schema `certkit-extraction/1`: fields may be added, none changes
its meaning.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from certkit.documents.consistent_lists import check_axis, check_lengths, plain_name
from certkit.documents.front_motion import FrontMotion
from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.rounding import Figure, FigureTuple
from certkit.documents.self_check import SelfCheck


class OutlineResult(Part):
    """A face's points (x, z) in m at a displacement of its group (m), or at a share of its largest."""

    at: Figure
    points: tuple[tuple[Figure, Figure], ...]


class GroupResult(Part):
    """A group: what it consists of, its mass and face (m, kg), and how it moved over time (N·s, m)."""

    name: str
    kind: str
    parts: tuple[str, ...]
    mass: Figure
    momentum: FigureTuple
    displacement: FigureTuple
    low: Figure | None = None
    high: Figure | None = None
    position: Figure | None = None
    slope: Figure | None = None
    outlines: tuple[OutlineResult, ...] = ()
    springing_back: tuple[OutlineResult, ...] = ()


class ClosureResult(Part):
    """Impulse by two independent sides: largest difference and what passed (N·s), and their ratio."""

    title: str
    residual: Figure
    impulse: Figure
    percent: Figure


class LawResult(Part):
    """A path's spring law (see `certkit.identification.spring_law`) and how well it repeats the history."""

    shortening: FigureTuple
    force: FigureTuple
    unloading: Figure
    residual: Figure
    permanent_set: Figure
    damping: Figure
    tension: bool
    misfit_percent: Figure
    unloaded: bool


class SheetResult(Part):
    """A sheet's path (see `certkit.identification.sheet_law`) and how well it repeats the history."""

    progress: FigureTuple
    shortening: FigureTuple
    force: FigureTuple
    shares: FigureTuple
    back_shortening: FigureTuple
    back_force: FigureTuple
    stiffness: Figure
    damping: Figure
    misfit_percent: Figure
    tension: bool = True


class EnergyResult(Part):
    """Energy of a path over its history (J): the most that was put in, and what stayed; so of its law."""

    put_in: Figure
    absorbed: Figure
    law_put_in: Figure | None = None
    law_absorbed: Figure | None = None

    @property
    def returned(self) -> float:
        """Return what came back in the run, J."""
        return self.put_in - self.absorbed

    @property
    def law_returned(self) -> float | None:
        """Return what comes back by the law, J."""
        return (
            None
            if self.law_put_in is None or self.law_absorbed is None
            else self.law_put_in - self.law_absorbed
        )


class PathResult(Part):
    """A load path over time: impulse (N·s), force and recorded contact force (N), shortening (m); its law."""

    name: str
    source: str
    target: str
    known_by: str
    impulse: FigureTuple
    force: FigureTuple
    shortening: FigureTuple
    recorded_force: FigureTuple | None
    force_error_percent: Figure | None
    closures: tuple[ClosureResult, ...]
    law: LawResult | None
    peak_force: Figure
    peak_time: Figure
    sheet: SheetResult | None = None
    energy: EnergyResult | None = None


class MaterialResult(Part):
    """Engineering stress–strain curve from a path's law, beside the material's own curve (stress in Pa)."""

    path: str
    length: Figure
    area: Figure
    strain: FigureTuple
    stress: FigureTuple
    unloading_strain: FigureTuple
    unloading_stress: FigureTuple
    reference_strain: FigureTuple
    reference_stress: FigureTuple
    strain_from: Figure
    rms_percent: Figure | None
    mean_percent: Figure | None
    uniform: bool
    spread_percent: Figure | None


class ExtractionResult(OutputDocument):
    """What an extraction found.

    Parameters
    ----------
    case, title : str
    start, interval, count
        The uniform time axis of all series in s.
    groups, paths : tuple
    vehicle : str or None
        Name of the vehicle document written beside it.
    material : MaterialResult or None
        None when no material was named, or when the conversion was refused (see `warnings`).
    warnings : tuple of str
        What a user has to know before using the curves.
    notes : tuple of str
        What was assumed or repaired.
    inputs : dict of str to str
        SHA-256 by file name: the case and all histories.
    closed : bool or None
        Whether the impulse of every path that carries something closes within the case's limit; None where
        a path with a law is known from one side only, so that nothing tells.
    checks : tuple of SelfCheck
    motion : FrontMotion or None
        Faces and leg of the run and of the coupled model, at the same instants.
    """

    noun: ClassVar = "extraction"
    file_name: ClassVar = "extraction.json"
    made_by: ClassVar = "certkit extract"

    schema_: Annotated[Literal["certkit-extraction/1"], Field(alias="schema")] = "certkit-extraction/1"
    case: Annotated[str, AfterValidator(plain_name)]
    title: str
    start: Figure
    interval: Figure
    count: int
    smoothing: Figure
    groups: tuple[GroupResult, ...]
    paths: tuple[PathResult, ...]
    vehicle: str | None
    material: MaterialResult | None
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    inputs: dict[str, str] = Field(default_factory=dict)
    certkit: str = ""
    closed: bool | None = None
    checks: tuple[SelfCheck, ...] = ()
    motion: FrontMotion | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse histories that do not lie on the time axis, and laws and materials of unequal columns."""
        check_axis(self.start, self.interval, self.count)
        for group in self.groups:
            lists = {"momentum": group.momentum, "displacement": group.displacement}
            check_lengths(self.count, {f"{group.name}: {k}": v for k, v in lists.items()}, "samples")
        for path in self.paths:
            lists = {"impulse": path.impulse, "force": path.force, "shortening": path.shortening}
            if path.recorded_force is not None:
                lists["recorded_force"] = path.recorded_force
            check_lengths(self.count, {f"{path.name}: {k}": v for k, v in lists.items()}, "samples")
            if path.law is not None:
                points = len(path.law.shortening)
                check_lengths(points, {f"{path.name}: law.force": path.law.force}, "shortenings")
        if self.material is not None:
            m = self.material
            check_lengths(len(m.strain), {"material.stress": m.stress}, "strains")
            unloading = {"material.unloading_stress": m.unloading_stress}
            check_lengths(len(m.unloading_strain), unloading, "strains")
            reference = {"material.reference_stress": m.reference_stress}
            check_lengths(len(m.reference_strain), reference, "strains")
        return self

    @property
    def times(self) -> list[float]:
        """Return the time axis in s."""
        return [self.start + k * self.interval for k in range(self.count)]
