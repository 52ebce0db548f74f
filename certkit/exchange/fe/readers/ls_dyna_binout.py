"""LS-DYNA binout files: parts, nodes, contacts and energies of a run.

`matsum` has momenta, or only mass and rigid-body velocity; nowhere stands a part's centre of gravity, so its
displacement is the integral of its velocity.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from certkit.errors import DataError
from certkit.exchange.fe.binout_files import BinoutFiles, is_lsda
from certkit.exchange.fe.binout_tables import BinoutTables
from certkit.exchange.fe.histories import (
    ContactHistory,
    PartHistories,
    PartHistory,
    Units,
    match_one,
    parse_units,
)
from certkit.exchange.fe.integral import running_integral
from certkit.exchange.fe.run_binout import BinoutRun

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import HistoryFiles, RigidBody
    from certkit.definitions.virtual_test import FiniteElements
    from certkit.exchange.fe.histories import Place

    Values = NDArray[np.float64]


USUAL_FILES = ("binout*",)
holds = is_lsda


def open_run(paths: Sequence[Path], layout: FiniteElements) -> BinoutRun:
    """Open a run that is graded; whoever opened it closes it."""
    return BinoutRun(paths, parse_units(layout.units))


def read(paths: Sequence[Path], section: HistoryFiles) -> PartHistories:
    """Read the binout files of a case: one or more, or all that fit a pattern such as `binout*`."""
    files = [file for path in paths for file in _fitting(path)]
    return read_binout(files, parse_units(section.units), section.rigid_bodies)


def _fitting(path: Path) -> list[Path]:
    """Return the files that a name means; those that LSDA goes on in are found with their first."""
    if path.exists() or not set(path.name) & set("*?"):
        return [path]
    found = [file for file in sorted(path.parent.glob(path.name)) if "%" not in file.name]
    if not found:
        raise DataError(f"{path}: no file fits this name; name the binout files")
    return found


def read_binout(
    paths: Path | Sequence[Path], units: Units, rigid_bodies: Mapping[str, RigidBody]
) -> PartHistories:
    """Read matsum, nodout, rcforc and glstat of a run's binout files.

    Raises
    ------
    DataError
        Without lasso-python, for a damaged file, or when matsum is missing.
    """
    paths = [paths] if isinstance(paths, Path) else list(paths)
    files = BinoutFiles(paths)
    try:
        return _read(BinoutTables(files, str(paths[0])), str(paths[0]), units, rigid_bodies, files.digests)
    finally:
        files.close()


def _read(
    binout: BinoutTables,
    source: str,
    units: Units,
    rigid_bodies: Mapping[str, RigidBody],
    digests: dict[str, str],
) -> PartHistories:
    tables = set(binout.tables())
    if "matsum" not in tables:
        have = ", ".join(sorted(tables)) or "nothing"
        raise DataError(f"{source}: there is no matsum (only {have}); request *DATABASE_MATSUM")
    time = binout.times("matsum", units.time)
    notes = ["displacements of centres of gravity are integrals of the parts' velocities"]
    nodes = _nodes(binout, time, units) if "nodout" in tables else {}
    places = _places(binout, units) if "nodout" in tables else {}
    parts = _parts(binout, time, units, rigid_bodies, notes, source)
    for name, body in rigid_bodies.items():
        if body.node in nodes:
            moved = nodes[body.node]
            parts[name] = replace(
                parts[name], mass=body.mass, displacement=moved, front=moved, start=places.get(body.node)
            )
    contacts = _contacts(binout, time, units) if "rcforc" in tables else {}
    if contacts:
        notes.append("contact impulses are integrals of the recorded forces")
    return PartHistories(
        time,
        parts,
        nodes,
        contacts,
        energies=_energies(binout, time, units) if "glstat" in tables else {},
        notes=(*notes, *binout.remarks()),
        source=source,
        files=digests,
        node_places=places,
    )


def _nodes(binout: BinoutTables, time: Values, units: Units) -> dict[str, Values]:
    at = binout.times("nodout", units.time, until=time[-1])
    moved = binout.columns("nodout", "x_displacement") * units.length
    names = binout.legend("nodout")
    return {name: np.interp(time, at, moved[:, k]) for k, name in enumerate(names)}


def _places(binout: BinoutTables, units: Units) -> dict[str, Place]:
    """Return the places of nodes at the start, m, where the file tells their coordinates."""
    if not all(
        binout.has("nodout", f"{axis}_{kind}") for axis in "xyz" for kind in ("coordinate", "displacement")
    ):
        return {}
    at = [
        binout.columns("nodout", f"{axis}_coordinate")[0]
        - binout.columns("nodout", f"{axis}_displacement")[0]
        for axis in "xyz"
    ]
    x, y, z = (units.length * each for each in at)
    names = binout.legend("nodout")
    return {name: (float(x[k]), float(y[k]), float(z[k])) for k, name in enumerate(names)}


def _energies(binout: BinoutTables, time: Values, units: Units) -> dict[str, Values]:
    at = binout.times("glstat", units.time, until=time[-1])
    return {
        kind: np.interp(time, at, binout.array("glstat", f"{kind}_energy")) * units.energy
        for kind in ("kinetic", "internal")
        if binout.has("glstat", f"{kind}_energy")
    }


def _parts(
    binout: BinoutTables,
    time: Values,
    units: Units,
    rigid_bodies: Mapping[str, RigidBody],
    notes: list[str],
    source: str,
) -> dict[str, PartHistory]:
    mass = binout.columns("matsum", "mass") * units.mass
    velocity = binout.columns("matsum", "x_rbvelocity") * (units.length / units.time)
    direct = (
        binout.columns("matsum", "x_momentum") * units.momentum
        if binout.has("matsum", "x_momentum")
        else None
    )
    if direct is None:
        notes.append("matsum has no x_momentum: momentum is initial mass times x_rbvelocity")
    names = binout.legend("matsum")
    for name in rigid_bodies:
        match_one(name, dict.fromkeys(names), "part", source)
    parts, ids = {}, binout.ids("matsum")
    for k, name in enumerate(names):
        m = float(mass[0, k]) or None
        if name in rigid_bodies:
            m = float(rigid_bodies[name].mass)
        momentum = None if direct is None else direct[:, k]
        if m is not None and (momentum is None or (name in rigid_bodies and not np.any(momentum))):
            momentum = m * velocity[:, k]
        parts[name] = PartHistory(m, momentum, running_integral(velocity[:, k], time), id=ids[k])
    return parts


def _contacts(binout: BinoutTables, time: Values, units: Units) -> dict[str, ContactHistory]:
    at = binout.times("rcforc", units.time, until=time[-1])
    force = binout.columns("rcforc", "x_force") * units.force
    names = binout.legend("rcforc")
    contacts: dict[str, ContactHistory] = {}
    for k, name in enumerate(names):
        if name in contacts:  # the other side of the same contact
            continue
        impulse = running_integral(force[:, k], at)
        contacts[name] = ContactHistory(np.interp(time, at, impulse), np.interp(time, at, force[:, k]))
    return contacts
