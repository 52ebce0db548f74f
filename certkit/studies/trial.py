"""`Trial`: one run of a study over real procedures. Loads, simulates and grades; draws and writes nothing."""

from __future__ import annotations

from functools import cached_property, lru_cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct, field
from pydantic import BaseModel

import certkit
from certkit.bench.package_versions import package_versions
from certkit.bench.setup import Setup, Unchanged, prepare
from certkit.definitions.loading.kinds import kind_of
from certkit.definitions.loading.library import search_order
from certkit.definitions.loading.old_forms import path_of_today
from certkit.definitions.loading.parameter_list import curve_points, parameters
from certkit.definitions.loading.search_path import RememberedStore
from certkit.grading import grade_criteria, grade_quality, measure_all, overall
from certkit.grading.asked_criterion import dimension_of
from certkit.signals import Filtered
from certkit.studies.quantity import written

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from certkit.studies.points import Outputs, Point
    from certkit.studies.recorded_curve import RecordedCurve

DECISIVE = ("definitions", "signals", "mechanics", "grading")
"""Rooms whose code can change a number: part of what a run is remembered by."""


class Trial(Struct, frozen=True, dict=True):
    """An evaluation of points by one or several procedures.

    Outputs are `PROCEDURE/CRITERION`, the same with ` margin` behind it (distance to the nearer limit,
    negative outside) where it is graded, `PROCEDURE/verdict`, and the quality figures of the run.

    Parameters
    ----------
    procedures : tuple of str
        Names or files.
    units : mapping of str to str
        Unit of each numeric parameter, by its name.
    tied : mapping of str to tuple of (str, float)
        Further paths that follow a numeric parameter, each with the factor (1 or −1) it is multiplied with.
    fixed : mapping of str to str
        Overrides for every run.
    library : tuple of str
        Folders with own definitions.
    curves : tuple of RecordedCurve
        What the simulated curves are held against; see its `outputs`.
    """

    procedures: tuple[str, ...]
    units: Mapping[str, str] = field(default_factory=dict)
    tied: Mapping[str, tuple[tuple[str, float], ...]] = field(default_factory=dict)
    fixed: Mapping[str, str] = field(default_factory=dict)
    library: tuple[str, ...] = ()
    curves: tuple[RecordedCurve, ...] = ()

    def __call__(self, point: Point) -> Outputs:
        """Run all procedures with the point's settings."""
        from certkit.mechanics import simulate  # noqa: PLC0415  # the solver waits until something is run

        outputs: dict[str, float | str | None] = {}
        for name in self.procedures:
            setup = self.prepared(name, point)
            simulation = simulate(setup.procedure, setup.legform, vehicle=setup.vehicle)
            criteria = grade_criteria(measure_all(setup.procedure, simulation.recording), setup.corridors)
            quality = grade_quality(simulation.quality)
            for criterion in criteria:
                outputs[f"{name}/{criterion.id}"] = criterion.value
                if criterion.graded:
                    outputs[f"{name}/{criterion.id} margin"] = criterion.margin
            filtered = Filtered(simulation.recording)
            for curve in self.curves:
                if curve.procedure == name:
                    outputs |= curve.outputs(filtered)
            outputs[f"{name}/verdict"] = overall(criteria, quality=quality)
            outputs[f"{name}/energy error %"] = quality.energy_error_percent
            outputs[f"{name}/joint gap mm"] = quality.joint_gap_mm
            outputs[f"{name}/penetration mm"] = quality.penetration_mm
            outputs[f"{name}/flesh depth %"] = simulation.quality.flesh_depth_percent
        return outputs

    def prepared(self, procedure: str, point: Point) -> Setup:
        """Load a procedure with the point's settings.

        Raises
        ------
        DefinitionError, UsageError
            When a setting does not fit.
        """
        own = {
            path: written(value if factor == 1 else factor * float(value), self.units.get(name, ""))
            for name, value in point.items()
            for scope, first in [scoped(name)]
            if scope in {"", procedure}
            for path, factor in ((first, 1.0), *self.tied.get(name, ()))
        }
        return prepare(
            procedure, library=self._stores, overrides={**self.fixed, **own}, unchanged=self._unchanged
        )

    @cached_property
    def _stores(self) -> tuple[RememberedStore, ...]:
        """Where definitions are looked for: once, so that all runs meet the same files."""
        return tuple(RememberedStore(store) for store in search_order(self.library))

    @cached_property
    def _unchanged(self) -> Unchanged:
        """What no point changes, read for the first of them."""
        return {}

    @property
    def context(self) -> str:
        """What besides a point decides the outputs: definitions, changes, programs."""
        inputs = [
            f"{name} {item.role} {item.path} {item.sha256}"
            for name in self.procedures
            for item in self.prepared(name, {}).inputs
        ]
        return "\n".join(
            [
                *inputs,
                *(f"{path}={value}" for path, value in self.fixed.items()),
                *map(str, sorted(self.units.items())),
                str(sorted(self.tied.items())),
                sha256(repr(self.curves).encode()).hexdigest(),
                programs(),
            ]
        )

    def output_units(self) -> dict[str, str]:
        """Return the units of criteria and their margins by output."""
        units: dict[str, str] = {}
        for name in self.procedures:
            setup = self.prepared(name, {})
            for criterion in setup.procedure.criteria:
                kind = dimension_of(criterion, setup.legform.channel_table)
                if kind is not None:
                    units[f"{name}/{criterion.id}"] = units[f"{name}/{criterion.id} margin"] = kind.unit
        return units

    def nominals(self, names: Iterable[str] = ()) -> dict[str, str]:
        """Return the values in the definitions by parameter name, as written there.

        Parameters
        ----------
        names : iterable of str
            Parameters that may have old paths; their values are found under these as well.
        """
        found: dict[str, str] = {}
        for name in self.procedures:
            setup = self.prepared(name, {})
            sheets = [("", setup.procedure), ("legform.", setup.legform), ("vehicle.", setup.vehicle)]
            for prefix, sheet in sheets:
                points = curve_points(sheet).items() if isinstance(sheet, BaseModel) else ()
                for key, value in (*numbers_of(sheet), *points):
                    path = prefix + key
                    found[f"{name}/{path}"] = value
                    found.setdefault(path, value)
        for name in names:
            if name not in found and (value := found.get(self.today(name))) is not None:
                found[name] = value
        return found

    def today(self, name: str) -> str:
        """Return a parameter's name with the path of today; see `certkit.definitions.loading.old_forms`.

        Raises
        ------
        UsageError
            When the definitions have no such path.
        """
        scope, path = scoped(name)
        setup = self.prepared(scope or self.procedures[0], {})
        role = next((kind for kind in ("legform", "vehicle") if path.startswith(f"{kind}.")), "procedure")
        prefix = "" if role == "procedure" else f"{role}."
        files = [item for item in setup.inputs if item.role == role]
        if not files:
            return name
        words = path_of_today(kind_of(role), files[0].text or "", files[0].path, path.removeprefix(prefix))
        return (f"{scope}/" if scope else "") + prefix + words


def scoped(name: str) -> tuple[str, str]:
    """Cut a parameter's name into the procedure it holds for (empty: all of them) and its path."""
    scope, slash, path = name.partition("/")
    return (scope, path) if slash else ("", name)


def numbers_of(document: object) -> list[tuple[str, str]]:
    """List path and written value of every number in a document; nothing for None."""
    return [(p.path, p.value) for p in parameters(document)] if isinstance(document, BaseModel) else []


@lru_cache(maxsize=1)
def programs() -> str:
    """Return versions of the packages and a hash of the code that can change a number."""
    root = Path(certkit.__file__).parent
    code = sha256()
    for room in DECISIVE:
        for path in sorted((root / room).rglob("*.py")):
            code.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes())
    packages = " ".join(f"{name} {version}" for name, version in package_versions().items())
    return f"{packages}\n{code.hexdigest()}"
