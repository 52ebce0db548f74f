"""The five steps in their order, from a case to an extraction result."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.documents.extraction import ExtractionResult, MaterialResult
from certkit.errors import DataError
from certkit.exchange.fe import FrontData, read_case_data
from certkit.exchange.fe.plausible_nodes import node_remarks
from certkit.identification.closures import closes, closure_warnings, end_warnings
from certkit.identification.displacement import shortening
from certkit.identification.extraction_parts import group_result, path_result
from certkit.identification.first_steps import FirstSteps, first_steps, missing_impactor
from certkit.identification.material import MOST_SPREAD, convert, front_spread, parse_area
from certkit.identification.part_groups import left_over
from certkit.identification.path_laws import path_laws
from certkit.identification.rate_check import material_remark, rate_remarks
from certkit.identification.record_names import misnamed_records
from certkit.identification.vehicle_file import loose_groups

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from certkit.definitions.extraction_case import Case
    from certkit.identification.stiffness import SpringFit


def extract(
    case: Case,
    folder: Path,
    *,
    case_folder: Path | None = None,
    case_digest: dict[str, str] | None = None,
    progress: Callable[[str], None] = lambda _: None,
    data: FrontData | None = None,
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
    data : FrontData, optional
        The histories, where they have been read already.

    Raises
    ------
    DataError
        For anything missing, damaged or contradictory in the case's data.
    """
    if data is None:
        progress("reading histories")
        data = read_case_data(case.histories, folder)
    steps = first_steps(case, data)
    warnings: list[str] = missing_impactor(steps)
    notes = [*case.notes, *steps.data.histories.notes]
    forgotten, noted = left_over(steps.graph.groups, steps.data.histories, steps.data.faces)
    warnings += forgotten
    if steps.data.motion is not None:
        warnings += node_remarks(steps.data.motion, steps.data.histories, steps.data.faces)
    notes += noted
    warnings += misnamed_records(steps.graph, steps.data.histories)
    fits, sheets = path_laws(steps, warnings, notes, progress)
    rate_remarks(fits, steps, warnings, notes)
    warnings += [*closure_warnings(steps), *end_warnings(steps)]
    closed = closes(steps, warnings)
    material, digests = _material(case, steps, fits, case_folder or folder, warnings)
    inputs = {**(case_digest or {}), **steps.data.histories.files, **digests}
    groups = tuple(group_result(name, steps) for name in steps.graph.groups)
    paths = tuple(
        path_result(flow, fits.get(flow.link.name), sheets.get(flow.link.name), steps) for flow in steps.flows
    )
    loose = loose_groups(groups, paths)
    warnings += [
        f"{group.name}: nothing that carries a force leads from it to the ground, so no law holds it: it is "
        f"left out of the vehicle{', and the leg meets nothing there' if group.position is not None else ''}"
        for group in groups
        if group.name in loose
    ]
    return ExtractionResult(
        case=case.case,
        title=case.title,
        start=float(steps.grid.time[0]),
        interval=steps.grid.step,
        count=int(steps.grid.time.size),
        smoothing=steps.grid.window,
        groups=groups,
        paths=paths,
        vehicle=case.vehicle,
        material=material,
        warnings=tuple(warnings),
        notes=tuple(notes),
        inputs=inputs,
        certkit=__version__,
        closed=closed,
    ).with_id()


def _material(
    case: Case, steps: FirstSteps, fits: dict[str, SpringFit], folder: Path, warnings: list[str]
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
    result, digests = convert(material, parse_area(material.area), fit.law, spread, folder, history)
    remark = material_remark(material, result, flow, steps)
    warnings += [] if remark is None else [remark]
    return result, digests
