"""What the steps found, as the parts of an extraction's document."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.extraction import (
    ClosureResult,
    EnergyResult,
    GroupResult,
    LawResult,
    OutlineResult,
    PathResult,
    SheetResult,
)
from certkit.exchange.fe.faces import joint_face
from certkit.identification.balance import BY_MOMENTUM
from certkit.identification.displacement import shortening
from certkit.identification.path_energy import PathEnergy, path_energy

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.identification.balance import Flow
    from certkit.identification.first_steps import FirstSteps
    from certkit.identification.sheet_law import SheetLaw
    from certkit.identification.stiffness import SpringFit

    Values = NDArray[np.float64]


def group_result(name: str, steps: FirstSteps) -> GroupResult:
    """Return a group with its face and movement."""
    group, parts = steps.case.groups[name], steps.graph.groups[name]
    face = joint_face([steps.data.faces[part] for part in parts if part in steps.data.faces])
    outlines = steps.outlines.get(name) if face is not None and face.position is not None else None

    def of_face(key: str) -> float | None:
        given = getattr(group, key)
        if given is not None:
            return float(given)
        return None if face is None else getattr(face, key)

    return GroupResult(
        name=name,
        kind=group.kind,
        parts=parts,
        mass=steps.masses[name],
        momentum=tuple(map(float, steps.momenta[name])),
        displacement=tuple(map(float, steps.displacements[name])),
        low=of_face("low"),
        high=of_face("high"),
        position=of_face("position"),
        slope=of_face("slope"),
        outlines=() if outlines is None else _lines(outlines.at, outlines.pushed),
        springing_back=() if outlines is None else _lines(outlines.shares, outlines.returning),
    )


def _lines(at: Values, points: Values) -> tuple[OutlineResult, ...]:
    return tuple(
        OutlineResult(at=float(a), points=tuple((float(x), float(z)) for x, z in line))
        for a, line in zip(at, points, strict=True)
    )


def path_result(flow: Flow, fit: SpringFit | None, sheet: SheetLaw | None, steps: FirstSteps) -> PathResult:
    """Return a path with its histories and its law."""
    force = flow.force
    error = None
    if flow.recorded is not None and flow.known_by == BY_MOMENTUM:
        peak = float(np.max(np.abs(flow.recorded)))
        if peak > 0:
            error = float(100 * np.sqrt(np.mean((force - flow.recorded) ** 2)) / peak)
    k = int(np.argmax(np.abs(force)))
    moved = np.zeros_like(force)
    energy = None
    if flow.link.law:
        moved = shortening(flow.link, steps.displacements)
        energy = _energy_result(flow, fit, steps, path_energy(moved, force))
    return PathResult(
        name=flow.link.name,
        source=flow.link.source,
        target=flow.link.target,
        known_by=flow.known_by,
        impulse=tuple(map(float, flow.impulse)),
        force=tuple(map(float, force)),
        shortening=tuple(map(float, moved)),
        recorded_force=None if flow.recorded is None else tuple(map(float, flow.recorded)),
        force_error_percent=error,
        closures=tuple(
            ClosureResult(title=c.title, residual=c.residual, impulse=c.impulse, percent=c.percent)
            for c in flow.closures
        ),
        law=None if fit is None else _law_result(fit),
        peak_force=float(force[k]),
        peak_time=float(steps.grid.time[k]),
        sheet=None if sheet is None else _sheet_result(sheet),
        energy=energy,
    )


def _energy_result(flow: Flow, fit: SpringFit | None, steps: FirstSteps, run: PathEnergy) -> EnergyResult:
    law = None
    if fit is not None:
        x = shortening(flow.link, steps.displacements)
        law = path_energy(x, fit.law.total_force(x, steps.grid.derivative(x)))
    return EnergyResult(
        put_in=run.put_in,
        absorbed=run.absorbed,
        law_put_in=None if law is None else law.put_in,
        law_absorbed=None if law is None else law.absorbed,
    )


def _sheet_result(sheet: SheetLaw) -> SheetResult:
    return SheetResult(
        progress=tuple(map(float, sheet.progress)),
        shortening=tuple(map(float, sheet.shortening)),
        force=tuple(map(float, sheet.force)),
        shares=tuple(map(float, sheet.shares)),
        back_shortening=tuple(map(float, sheet.back_shortening)),
        back_force=tuple(map(float, sheet.back_force)),
        stiffness=sheet.stiffness,
        damping=sheet.damping,
        misfit_percent=sheet.misfit,
        tension=sheet.tension,
    )


def _law_result(fit: SpringFit) -> LawResult:
    law = fit.law
    return LawResult(
        shortening=law.shortening,
        force=law.force,
        unloading=law.branch.stiffness,
        residual=law.branch.residual,
        permanent_set=law.branch.permanent_set,
        damping=law.damping,
        tension=law.tension,
        misfit_percent=fit.misfit,
        unloaded=fit.unloaded,
    )
