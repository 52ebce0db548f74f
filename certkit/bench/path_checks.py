"""Springs and sheets of a front in the coupled run, beside the load paths that they were read from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.self_check import PathCheck

if TYPE_CHECKING:
    from certkit.definitions.vehicle import Vehicle
    from certkit.documents.extraction import ExtractionResult, PathResult
    from certkit.mechanics import Simulation
    from certkit.mechanics.records import Floats


def path_checks(
    result: ExtractionResult, vehicle: Vehicle, done: Simulation, *, start: float, time: Floats, every: int
) -> tuple[PathCheck, ...]:
    """Return what each spring and sheet did in the coupled run.

    Parameters
    ----------
    result : ExtractionResult
    vehicle : Vehicle
        Made of it, and hit in the run.
    done : Simulation
    start : float
        First contact on the run's time axis, s.
    time : ndarray, shape (n,)
        The checks' axis, s from the run's start.
    every : int
        Of how many instants one is kept.
    """
    links: dict[tuple[str, str], list[str]] = {}
    between = [(name, spring.between) for name, spring in vehicle.springs.items()]
    between += [(name, sheet.between) for name, sheet in vehicle.sheets.items()]
    for name, (source, target) in between:
        links.setdefault((source, target), []).append(name)
    own = done.run.time - done.run.contact + start
    found = []
    for path in result.paths:
        names = links.get((path.source, path.target), [])
        if not names or (path.law is None and path.sheet is None):
            continue
        name = names.pop(0)
        x, force = (
            np.interp(time, own, done.readings[f"spring {name} {state}"]) for state in ("shortening", "force")
        )
        found.append(_check(path, time, x, force, every))
    return tuple(found)


def _check(path: PathResult, time: Floats, x: Floats, force: Floats, every: int) -> PathCheck:
    run_x, run_force = (np.array(values[: time.size]) for values in (path.shortening, path.force))
    return PathCheck(
        name=path.name,
        peak=_largest(force),
        run_peak=_largest(run_force),
        largest=float(np.max(x)),
        run_largest=float(max(path.shortening)),
        impulse=float(np.trapezoid(force, time)),
        run_impulse=float(np.trapezoid(run_force, time)),
        absorbed=float(np.trapezoid(force, x)),
        run_absorbed=float(np.trapezoid(run_force, run_x)),
        shortening=tuple(map(float, x[::every])),
        force=tuple(map(float, force[::every])),
    )


def _largest(values: Floats) -> float:
    """Return the value of the largest magnitude."""
    return float(values[np.argmax(np.abs(values))])
