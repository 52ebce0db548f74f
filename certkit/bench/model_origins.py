"""What is to be said of a model: what it was fitted to, values on a bound, springs beyond their range."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.fit_aims import corridor_sets, known_fits
from certkit.definitions.loading.library import stores
from certkit.definitions.units import UNITS, parse_quantity
from certkit.grading.front_limits import beyond_range
from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.bench.fit_aims import FitAims
    from certkit.bench.setup import Setup
    from certkit.definitions.loading.library import Library
    from certkit.documents.result import Front

ON_BOUND = 0.005
"""Share of the way between the bounds within which a fitted value stands on one."""


def fits_of(setup: Setup, library: Library = ()) -> list[FitAims]:
    """Return the fits that the legform was made by; those that cannot be read are passed over."""
    return [task for task in known_fits(_folders(library)) if task.legform == setup.legform.legform]


def fitted_to(setup: Setup, fits: list[FitAims], library: Library = ()) -> list[Reason]:
    """Return what the model was fitted to, where it is what the procedure grades by or compares with.

    A fit that aimed at corridors is known by the corridors: a copy of its procedure under another name
    grades by them all the same.
    """
    graded = setup.procedure.corridor_sets
    said = []
    for task in fits:
        aims = {to: {t.procedure for t in task.targets if t.to == to} for to in ("corridors", "reference")}
        if graded and (
            setup.procedure.procedure in aims["corridors"]
            or any(graded & corridor_sets(aim, _folders(library)) for aim in sorted(aims["corridors"]))
        ):
            said.append(Reason.of("fitted-to-corridors", fit=task.fit))
        if setup.procedure.procedure in aims["reference"]:
            said.append(Reason.of("fitted-to-reference", fit=task.fit))
    return said


def _folders(library: Library) -> tuple[str, ...]:
    return tuple(map(str, stores(library)))


def model_remarks(setup: Setup, fits: list[FitAims], front: Front | None) -> tuple[Reason, ...]:
    """Return the remarks on the model that a run was made with.

    Parameters
    ----------
    setup : Setup
    fits : list of FitAims
        Those of the legform.
    front : Front or None
        What the vehicle's front did, where there was one.
    """
    guess = (Reason.of("model-for-what-if"),) if setup.legform.what_if else ()
    stretched = [] if front is None or setup.vehicle is None else beyond_range(front, setup.vehicle)
    return (*guess, *_on_bounds(setup, fits), *stretched)


def _on_bounds(setup: Setup, fits: list[FitAims]) -> list[Reason]:
    """Return a remark on the fitted values of the model that stand on a bound."""
    values = {_path(parameter.path): parameter.value for parameter in setup.parameters}
    said = []
    for task in fits:
        names_on = [
            parameter.path
            for parameter in task.parameters
            if parameter.procedure in {None, setup.procedure.procedure}
            and parameter.path in values
            and _stands_on(values[parameter.path], parameter.lower, parameter.upper)
        ]
        if names_on:
            said.append(Reason.of("fitted-on-bounds", fit=task.fit, parameters=names_on))
    return said


def _path(listed: str) -> str:
    """Return a path as fits write it: `legform NAME: knee.…` is `legform.knee.…`, a procedure is left out."""
    owner, colon, path = listed.partition(": ")
    kind = owner.partition(" ")[0]
    return path if kind == "procedure" else f"{kind}.{path}" if colon else listed


def _stands_on(value: str, *bounds: object) -> bool:
    """Tell whether a quantity is at one of its bounds; quantities that cannot be compared are not."""
    for dimension in UNITS:
        try:
            at, low, high = (parse_quantity(str(each), dimension) for each in (value, *bounds))
        except (ValueError, KeyError):
            continue
        near = ON_BOUND * (high - low)
        return at <= low + near or at >= high - near
    return False
