"""Step 5 for all paths: which law each of them gets, and what has to be said of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from certkit.identification.displacement import shortening
from certkit.identification.grouping import GROUND
from certkit.identification.sheet_law import SheetLaw, sheet_law
from certkit.identification.stiffness import SpringFit, fit_law

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.identification.balance import Flow
    from certkit.identification.first_steps import FirstSteps

POOR_FIT = 15.0
"""Per cent of the peak force above which a law's misfit is warned of."""

NO_SPRING = 10.0
"""Per cent of the peak force above which a two-way link between two groups is taken for a sheet."""

MOST_FALL = 0.5
"""Share of its peak by which a loading curve may fall and still be a spring's.

A foam or a beam that buckles falls by less. What falls by more, a fascia that slides along a stiffener and
off it, is a contact whose force follows how far the sheet is pushed in.
"""

SHEETS = {"fascia", "hood"}
"""Kinds of groups that are pieces of one sheet."""


def path_laws(
    steps: FirstSteps, warnings: list[str], notes: list[str], progress: Callable[[str], None]
) -> tuple[dict[str, SpringFit], dict[str, SheetLaw]]:
    """Find the law of each path that carries something: a spring's, or a sheet's."""
    carrying = {flow.link.name for flow in steps.carrying}
    fits: dict[str, SpringFit] = {}
    sheets: dict[str, SheetLaw] = {}
    for flow in steps.flows:
        name = flow.link.name
        if not flow.link.law:
            continue
        if name not in carrying:
            notes.append(f"{name}: carries nothing, left out")
            continue
        progress(f"stiffness of {name}")
        fit = _fit(flow, steps)
        sheet = _sheet(flow, fit, steps)
        if sheet is not None:
            sheets[name] = sheet
            if sheet.misfit > POOR_FIT:
                warnings.append(f"{name}: its force repeats the run's only within {sheet.misfit:.0f} % rms")
            continue
        if fit is None:
            warnings.append(
                f"{name}: carries a force, but not by getting shorter: no law; the front lacks this path"
            )
            continue
        fits[name] = fit
        if fit.misfit > POOR_FIT:
            warnings.append(
                f"{name}: its force is no clear function of its shortening (law misses it by "
                f"{fit.misfit:.0f} % rms)"
            )
        if not fit.unloaded:
            notes.append(f"{name}: never unloads; unloading stiffness assumed at four times the secant")
    return fits, sheets


def _sheet(flow: Flow, fit: SpringFit | None, steps: FirstSteps) -> SheetLaw | None:
    """Find a sheet's law: between two faces of one kind, or where a link of a fascia is no spring."""
    link = flow.link
    if link.target == GROUND:
        return None
    kinds = {steps.case.groups[end].kind for end in (link.source, link.target)}
    one_sheet = link.tension and len(kinds) == 1 and kinds <= SHEETS
    if not one_sheet and fit is not None and _is_spring(fit, tension=link.tension):
        return None
    if not one_sheet and not link.tension and not _of_a_sheet(flow, steps):
        return None
    first, second = steps.displacements[link.source], steps.displacements[link.target]
    masses = (steps.masses[link.source], steps.masses[link.target])
    law = sheet_law(first, second, flow.force, masses, tension=link.tension)
    better = one_sheet or link.tension or fit is None or law is None or law.misfit < fit.misfit
    return law if better else None


def _of_a_sheet(flow: Flow, steps: FirstSteps) -> bool:
    """Tell whether a path leads from a fascia group that is joined to another one, so that it can slide."""
    fascia = {name for name, group in steps.case.groups.items() if group.kind == "fascia"}
    ends = {flow.link.source, flow.link.target} & fascia
    joined = ({link.source, link.target} for link in steps.graph.links if link.tension)
    return any(len(pair & fascia) == 2 and pair & ends for pair in joined)


def _is_spring(fit: SpringFit, *, tension: bool) -> bool:
    """Tell whether a path's force is a function of its shortening that a spring could have."""
    if fit.misfit > (NO_SPRING if tension else POOR_FIT):
        return False
    if tension:
        return True
    force = np.array(fit.law.force)[:-1]  # the last point continues the curve beyond what was seen
    fallen = np.maximum.accumulate(force) - force
    return float(np.max(fallen)) <= MOST_FALL * float(np.max(np.abs(force)))


def _fit(flow: Flow, steps: FirstSteps) -> SpringFit | None:
    x = shortening(flow.link, steps.displacements)
    if flow.link.start is not None and not flow.link.tension:
        x = x - flow.link.start
    held = steps.case.settings.unloading == "energy"
    fit = fit_law(x, steps.grid.derivative(x), flow.force, tension=flow.link.tension, hold_energy=held)
    if fit is None or flow.link.start is None or flow.link.tension:
        return fit
    start = flow.link.start
    law = replace(
        fit.law,
        shortening=(0.0, *(start + s for s in fit.law.shortening)),
        force=(0.0, *fit.law.force),
    )
    return replace(fit, law=law)
