"""LS-DYNA binout files through lasso-python, an optional extra that is imported only here.

What binout files do, and this reader handles: a table with a single id comes back one-dimensional; every
table has its own time vector; keys come in any order; `rcforc` lists each contact twice, once a side;
`matsum` has momenta, or only mass and rigid-body velocity; nowhere stands a part's centre of gravity, so its
displacement is the integral of its velocity.
"""

from __future__ import annotations

import shutil
import tempfile
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes, require_finite, require_time_axis
from certkit.exchange.fe.histories import (
    ContactHistory,
    PartHistories,
    PartHistory,
    Units,
    distinct,
    match_one,
    parse_units,
)
from certkit.exchange.fe.joined_binout import JoinedBinout

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import HistoryFiles, RigidBody

    Values = NDArray[np.float64]

_LEGEND_WIDTHS = (80, 70)
_LSDA_HEADER = 8
INSTALL = "reading binout files needs lasso-python: pip install 'certkit[binout]'"


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
    source = str(paths[0])
    digests: dict[str, str] = {}
    readers = []
    with tempfile.TemporaryDirectory(prefix="certkit-") as folder:
        for number, path in enumerate(paths):
            content, digests[str(path)] = read_bytes(path)
            # LSDA goes on in files of this name; the reader joins them, so they belong to what was read.
            rest = sorted(path.parent.glob(f"{escape(path.name)}%[0-9]*")) if path.suffix != ".gz" else []
            digests |= {str(part): read_bytes(part)[1] for part in rest}
            if not is_lsda(content):
                raise DataError(
                    f"{path}: this is no LSDA container; a binout starts with its header length 8: "
                    "name the binout"
                )
            own = Path(folder) / str(number)
            own.mkdir()
            readers.append(open_binout(path, content, rest, own, str(path)))
        return _read(JoinedBinout(readers, source), source, units, rigid_bodies, digests)


def is_lsda(content: bytes) -> bool:
    """Tell whether a file's content is an LSDA container, which a binout is."""
    return len(content) >= _LSDA_HEADER and content[0] == _LSDA_HEADER


def _read(
    reader: Any,  # noqa: ANN401  # lasso ships no types
    source: str,
    units: Units,
    rigid_bodies: Mapping[str, RigidBody],
    digests: dict[str, str],
) -> PartHistories:
    tables = set(reader.read())
    if "matsum" not in tables:
        have = ", ".join(sorted(tables)) or "nothing"
        raise DataError(f"{source}: there is no matsum (only {have}); request *DATABASE_MATSUM")
    binout = BinoutTables(reader, source)
    time = binout.array("matsum", "time") * units.time
    require_time_axis(time, source)
    notes = ["displacements of centres of gravity are integrals of the parts' velocities"]
    nodes = _nodes(binout, time, units) if "nodout" in tables else {}
    parts = _parts(binout, time, units, rigid_bodies, notes)
    for name, body in rigid_bodies.items():
        if body.node in nodes:
            moved = nodes[body.node]
            parts[name] = PartHistory(body.mass, parts[name].momentum, moved, moved)
    contacts = _contacts(binout, time, units) if "rcforc" in tables else {}
    if contacts:
        notes.append("contact impulses are integrals of the recorded forces")
    return PartHistories(
        time,
        parts,
        nodes,
        contacts,
        energies=_energies(binout, time, units) if "glstat" in tables else {},
        notes=tuple(notes),
        source=source,
        files=digests,
    )


def _nodes(binout: BinoutTables, time: Values, units: Units) -> dict[str, Values]:
    at = binout.times("nodout", units.time, until=time[-1])
    moved = binout.columns("nodout", "x_displacement") * units.length
    names = binout.legend("nodout", moved.shape[1])
    return {name: np.interp(time, at, moved[:, k]) for k, name in enumerate(names)}


def _energies(binout: BinoutTables, time: Values, units: Units) -> dict[str, Values]:
    at = binout.times("glstat", units.time, until=time[-1])
    return {
        kind: np.interp(time, at, binout.array("glstat", f"{kind}_energy")) * units.energy
        for kind in ("kinetic", "internal")
        if binout.has("glstat", f"{kind}_energy")
    }


def open_binout(path: Path, content: bytes, rest: list[Path], folder: Path, source: str) -> Any:  # noqa: ANN401  # lasso ships no types
    """Open exactly these files: lasso takes brackets in a path for a pattern, and reads no `.gz`."""
    try:
        from lasso.dyna import Binout  # noqa: PLC0415  # optional, heavy
        from lasso.dyna.lsda_py3 import Lsda  # noqa: PLC0415  # likewise
    except ImportError:
        raise DataError(f"{source}: {INSTALL}") from None
    if not hasattr(Lsda, "fw"):
        Lsda.fw = None  # its destructor asks for it, also where opening failed, and prints a traceback else
    try:
        if path.suffix != ".gz" and str(path) == escape(str(path)):
            return Binout(str(path))
        for part in rest:
            shutil.copyfile(part, folder / part.name)
        (folder / path.name).write_bytes(content)
        return Binout(str(folder / path.name))
    except Exception as error:  # noqa: BLE001  # whatever lasso raises, the file is what is wrong
        raise DataError(
            f"{source}: lasso-python cannot read it ({error}); was it cut? Copy it again"
        ) from None


class BinoutTables:
    """Tables of a binout file as plain two-dimensional arrays."""

    def __init__(self, reader: Any, source: str) -> None:  # noqa: ANN401  # lasso ships no types
        self._reader, self._source = reader, source

    def tables(self) -> list[str]:
        """Return the names of all tables; those of `elout` stand one level down."""
        found = []
        for name in self._reader.read():
            inner = [each for each in self._reader.read(name) if name == "elout"]
            found += [f"{name}/{each}" for each in inner] or [name]
        return found

    def has_table(self, table: str) -> bool:
        """Tell whether there is a table of that name, such as `secforc` or `elout/beam`."""
        return table in self.tables()

    def has(self, table: str, name: str) -> bool:
        """Tell whether a table has a variable."""
        return name in self._reader.read(*table.split("/"))

    def ids(self, table: str) -> list[int]:
        """Return the ids of a table's objects."""
        return [int(i) for i in np.atleast_1d(self.array(table, "ids")).ravel()]

    def array(self, table: str, name: str) -> Values:
        """Return a variable of a table as it stands there."""
        if not self.has(table, name):
            raise DataError(
                f"{self._source}: {table} has no `{name}`; is the file whole? Copy it again, or "
                "request it from the solver"
            )
        try:
            values = np.asarray(self._reader.read(*table.split("/"), name), dtype=np.float64)
        except Exception as error:  # noqa: BLE001  # see open_binout
            raise DataError(
                f"{self._source}: {table}/{name} cannot be read ({error}); copy the file again"
            ) from None
        require_finite(values.ravel(), f"{table}/{name}", self._source)
        return values

    def columns(self, table: str, name: str) -> Values:
        """Return (n, k) also where a single id comes back as (n,)."""
        values = self.array(table, name)
        values = values[:, None] if values.ndim == 1 else values
        if values.shape[0] != self.array(table, "time").shape[0]:
            raise DataError(
                f"{self._source}: {table}/{name} has not one row an instant; the file was cut: copy it again"
            )
        return values

    def legend(self, table: str, count: int) -> list[str]:
        """Return the names of a table's objects; ids where the model gives no titles."""
        ids = np.atleast_1d(self.array(table, "ids")).astype(int)
        names = {int(i): str(int(i)) for i in ids}
        if self.has(table, "legend"):
            text = str(self._reader.read(*table.split("/"), "legend"))
            titled = np.atleast_1d(self.array(table, "legend_ids")).astype(int)
            for width in _LEGEND_WIDTHS:
                if titled.size and len(text) == width * titled.size:
                    for k, i in enumerate(titled):
                        names[int(i)] = text[width * k : width * (k + 1)].strip() or str(int(i))
        if len(ids) != count:
            raise DataError(
                f"{self._source}: {table} announces {len(ids)} objects and holds {count}; copy the file again"
            )
        known = distinct(names.items())
        return [known[int(i)] for i in ids]

    def times(self, table: str, scale: float, *, until: float | None = None) -> Values:
        """Return a table's own times in seconds, which must reach `until`, the end of matsum."""
        times = self.array(table, "time") * scale
        require_time_axis(times, f"{self._source}: {table}")
        if until is not None and times[-1] + 1.01 * float(np.diff(times).max()) < until:
            raise DataError(
                f"{self._source}: {table} ends at {times[-1]:g} s, matsum at {until:g} s; the file was cut "
                "or goes on in another one: name a whole binout"
            )
        return times


def _parts(
    binout: BinoutTables,
    time: Values,
    units: Units,
    rigid_bodies: Mapping[str, RigidBody],
    notes: list[str],
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
    names = binout.legend("matsum", mass.shape[1])
    for name in rigid_bodies:
        match_one(name, dict.fromkeys(names), "part", binout._source)  # noqa: SLF001  # same module
    parts = {}
    for k, name in enumerate(names):
        m = float(mass[0, k]) or None
        if name in rigid_bodies:
            m = float(rigid_bodies[name].mass)
        momentum = None if direct is None else direct[:, k]
        if m is not None and (momentum is None or (name in rigid_bodies and not np.any(momentum))):
            momentum = m * velocity[:, k]
        steps = 0.5 * (velocity[1:, k] + velocity[:-1, k]) * np.diff(time)
        parts[name] = PartHistory(m, momentum, np.concatenate([[0.0], np.cumsum(steps)]))
    return parts


def _contacts(binout: BinoutTables, time: Values, units: Units) -> dict[str, ContactHistory]:
    at = binout.times("rcforc", units.time, until=time[-1])
    force = binout.columns("rcforc", "x_force") * units.force
    names = binout.legend("rcforc", force.shape[1])
    contacts: dict[str, ContactHistory] = {}
    for k, name in enumerate(names):
        if name in contacts:  # the other side of the same contact
            continue
        steps = 0.5 * (force[1:, k] + force[:-1, k]) * np.diff(at)
        impulse = np.concatenate([[0.0], np.cumsum(steps)])
        contacts[name] = ContactHistory(np.interp(time, at, impulse), np.interp(time, at, force[:, k]))
    return contacts
