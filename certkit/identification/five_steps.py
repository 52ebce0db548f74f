"""The five steps in their order, from a case to an extraction result."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from certkit._version import __version__
from certkit.documents.extraction import (
    ClosureResult,
    ExtractionResult,
    GroupResult,
    LawResult,
    MaterialResult,
    PathResult,
)
from certkit.errors import DataError
from certkit.exchange.fe import FrontData, read_case_data
from certkit.identification.balance import BY_MOMENTUM, Flow, flows, group_masses, group_momenta
from certkit.identification.displacement import group_displacements, shortening
from certkit.identification.grouping import Graph, build_graph
from certkit.identification.material import MOST_SPREAD, convert, front_spread, parse_area
from certkit.identification.sampling import Grid, make_grid
from certkit.identification.stiffness import SpringFit, fit_law

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import Case

    Values = NDArray[np.float64]

POOR_FIT = 15.0
"""Per cent of the peak force above which a law's misfit is warned of."""

CARRIES = 5e-4
"""A path that passes less than this share of the largest impulse is left out."""


@dataclass(frozen=True)
class _Steps:
    """Results of the first four steps."""

    case: Case
    data: FrontData
    graph: Graph
    grid: Grid
    momenta: dict[str, Values]
    masses: dict[str, float]
    flows: tuple[Flow, ...]
    displacements: dict[str, Values]


def extract(
    case: Case,
    folder: Path,
    *,
    case_folder: Path | None = None,
    case_digest: dict[str, str] | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> ExtractionResult:
    """Extract the stiffness between groups from finite-element histories.

    Parameters
    ----------
    case : Case
    folder : Path
        Where the histories lie.
    case_folder : Path, optional
        Where the material's curve lies, when that is another folder.
    case_digest : dict of str to str, optional
        Name and SHA-256 of the case file itself, kept with the inputs.
    progress : callable, optional
        Told what is being done.

    Raises
    ------
    DataError
        For anything missing, damaged or contradictory in the case's data.
    """
    progress("reading histories")
    steps = _first_four(case, read_case_data(case.histories, folder))
    warnings: list[str] = []
    notes = [*case.notes, *steps.data.histories.notes]
    largest = max(float(np.max(np.abs(flow.impulse))) for flow in steps.flows)
    fits: dict[str, SpringFit] = {}
    for flow in steps.flows:
        if not flow.link.law:
            continue
        if float(np.max(np.abs(flow.impulse))) < CARRIES * largest:
            notes.append(f"{flow.link.name}: carries nothing, left out")
            continue
        progress(f"stiffness of {flow.link.name}")
        fit = _fit(flow, steps)
        if fit is None:
            warnings.append(
                f"{flow.link.name}: carries a force, but not by getting shorter: no law; the front lacks "
                "this path"
            )
        else:
            fits[flow.link.name] = fit
            if fit.misfit > POOR_FIT:
                warnings.append(
                    f"{flow.link.name}: its force is no clear function of its shortening (law misses it by "
                    f"{fit.misfit:.0f} % rms)"
                )
            if not fit.unloaded:
                notes.append(
                    f"{flow.link.name}: never unloads; unloading stiffness assumed at four times the secant"
                )
    warnings += _closure_warnings(steps)
    material, digests = _material(case, steps, fits, case_folder or folder, warnings)
    inputs = {**(case_digest or {}), **steps.data.histories.files, **digests}
    return ExtractionResult(
        case=case.case,
        title=case.title,
        start=float(steps.grid.time[0]),
        interval=steps.grid.step,
        count=int(steps.grid.time.size),
        smoothing=steps.grid.window,
        groups=tuple(_group_result(name, steps) for name in steps.graph.groups),
        paths=tuple(_path_result(flow, fits.get(flow.link.name), steps) for flow in steps.flows),
        vehicle=case.vehicle,
        material=material,
        warnings=tuple(warnings),
        notes=tuple(notes),
        inputs=inputs,
        certkit=__version__,
    ).with_id()


def _first_four(case: Case, data: FrontData) -> _Steps:
    histories = data.histories
    graph = build_graph(case, histories)
    window = None if case.settings.smoothing is None else float(case.settings.smoothing)
    until = None if case.settings.until is None else float(case.settings.until)
    grid = make_grid(histories.time, window=window, until=until)
    momenta = group_momenta(graph, histories, grid)
    if not any(np.any(np.abs(p - p[0]) > 1e-9) for p in momenta.values()):
        raise DataError(
            f"{histories.source}: no group's momentum ever changes; the histories end before the impact"
        )
    return _Steps(
        case,
        data,
        graph,
        grid,
        momenta,
        group_masses(graph, histories),
        flows(graph, momenta, histories, grid),
        group_displacements(case, graph, histories, grid),
    )


def _fit(flow: Flow, steps: _Steps) -> SpringFit | None:
    x = shortening(flow.link, steps.displacements)
    if flow.link.start is not None and not flow.link.tension:
        x = x - flow.link.start
    fit = fit_law(x, steps.grid.derivative(x), flow.force, tension=flow.link.tension)
    if fit is None or flow.link.start is None or flow.link.tension:
        return fit
    start = flow.link.start
    law = replace(
        fit.law,
        shortening=(0.0, *(start + s for s in fit.law.shortening)),
        force=(0.0, *fit.law.force),
    )
    return replace(fit, law=law)


def _closure_warnings(steps: _Steps) -> list[str]:
    limit = steps.case.settings.closure_limit
    seen: dict[str, str] = {}
    for flow in steps.flows:
        for closure in flow.closures:
            if closure.percent > limit:
                seen[closure.title] = (
                    f"impulse does not close: {closure.title}: {closure.residual:.3g} N·s of "
                    f"{closure.impulse:.3g} N·s "
                    f"({closure.percent:.1f} %); is a path, a part or a contact missing, or a path's "
                    "direction reversed?"
                )
    return list(seen.values())


def _material(
    case: Case, steps: _Steps, fits: dict[str, SpringFit], folder: Path, warnings: list[str]
) -> tuple[MaterialResult | None, dict[str, str]]:
    """Convert to stress–strain where the crush is uniform; say why not where it is not."""
    material = case.material
    if material is None:
        return None, {}
    name = f"{material.path[0]} – {material.path[1]}"
    fit = fits.get(name)
    if fit is None:
        raise DataError(f"the material's path {name} has no law; name a path that carries a force")
    spread = front_spread(material, steps.data.histories, steps.grid)
    if spread is not None and spread > MOST_SPREAD:
        warnings.append(
            "no stress–strain curve: the block's front is not crushed uniformly (its nodes differ by "
            f"{spread:.0f} % of the crush), "
            "so force over area means nothing; the stiffness itself holds for this contact only"
        )
        return None, {}
    if spread is None:
        warnings.append(
            "whether the block is crushed uniformly was not checked: name nodes spread over its front as "
            "`faces`"
        )
    flow = next(f for f in steps.flows if f.link.name == name)
    history = (shortening(flow.link, steps.displacements), flow.force)
    return convert(material, parse_area(material.area), fit.law, spread, folder, history)


def _group_result(name: str, steps: _Steps) -> GroupResult:
    group, parts = steps.case.groups[name], steps.graph.groups[name]
    faces = [steps.data.faces[part] for part in parts if part in steps.data.faces]
    face = faces[0] if len(faces) == 1 else None

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
    )


def _path_result(flow: Flow, fit: SpringFit | None, steps: _Steps) -> PathResult:
    force = flow.force
    error = None
    if flow.recorded is not None and flow.known_by == BY_MOMENTUM:
        peak = float(np.max(np.abs(flow.recorded)))
        if peak > 0:
            error = float(100 * np.sqrt(np.mean((force - flow.recorded) ** 2)) / peak)
    k = int(np.argmax(np.abs(force)))
    moved = np.zeros_like(force)
    if flow.link.law:
        moved = shortening(flow.link, steps.displacements)
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
