"""Everything a procedure needs, loaded and checked before anything runs."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from certkit._version import __version__
from certkit.bench.package_versions import package_versions
from certkit.definitions.loading.library import Loaded, load, names
from certkit.definitions.loading.parameter_list import parameters
from certkit.documents.result import InputFile, Override, Parameter, Provenance
from certkit.grading.grading_terms import GradingTerms

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from pydantic import BaseModel

    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.legform import Legform
    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.overrides import Overrides
    from certkit.definitions.procedure import Procedure
    from certkit.definitions.reference import Reference
    from certkit.definitions.vehicle import Vehicle

OF_THE_MODEL = ("legform", "vehicle")
"""Definitions of what is simulated: `--set` may start with them, and they play no part of a real test."""


class Setup(Struct, frozen=True, dict=True):
    """A procedure with the legform, vehicle, corridors and reference it names, and where each came from."""

    procedure: Procedure
    legform: Legform
    vehicle: Vehicle | None
    corridors: dict[str, CorridorSet]
    reference: Reference | None
    loaded: tuple[tuple[str, Loaded[BaseModel]], ...]
    model_left_out: bool = False

    # What only a document needs is made when one is made: thousands of runs of a study make none.
    @cached_property
    def inputs(self) -> tuple[InputFile, ...]:
        """The files that went in, by their role."""
        confirmations = [item.confirmation for _, item in self.loaded if item.confirmation is not None]
        left_out = {"vehicle"} if self.model_left_out else set()
        items = [item for role, item in self.loaded if role not in left_out]
        return tuple(map(input_file, (*items, *confirmations)))

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """All numbers that went in, each with its origin."""
        found = _parameters(self.loaded)
        return tuple(p for p in found if not (self.model_left_out and _of_the_model(p.path)))

    @property
    def overrides(self) -> tuple[Override, ...]:
        """The values that were changed, by their paths as they were given."""
        return tuple(
            Override(path=_full(role, change.path), value=change.value, was=change.was)
            for role, item in self.loaded
            for change in item.overrides
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """Old forms and paths that were read; see `Loaded`."""
        return tuple(remark for _, item in self.loaded for remark in item.remarks)

    def terms(self, *further: InputFile) -> GradingTerms:
        """Return what the test is graded by; `further` are input files beside the definitions."""
        return GradingTerms(self.corridors, self.provenance(*further), self.reference, self.parameters)

    def provenance(self, *further: InputFile) -> Provenance:
        """Say what went in and which programs worked on it."""
        return Provenance(
            certkit=__version__,
            inputs=[*self.inputs, *further],
            packages=dict(package_versions()),
            overrides=list(self.overrides),
        )


Unchanged = dict[tuple[str, str], "Loaded[BaseModel]"]
"""Definitions of one library as they stand, by kind and name: runs of a study read them once."""


def prepare(
    procedure: str | Path,
    *,
    library: Library = (),
    overrides: Overrides | None = None,
    unchanged: Unchanged | None = None,
) -> Setup:
    """Load a procedure and all that it names.

    Parameters
    ----------
    procedure : str or Path
        Name that the library knows, or a file.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.
    overrides : mapping, optional
        Values by their paths: `{"rig.hinge.offset": "30 mm"}` changes the procedure, `{"legform": NAME}` and
        `{"vehicle": NAME}` put another one on the rig, `{"legform.parts.femur.length": "0.34 m"}` changes
        the legform, `vehicle.…` likewise the vehicle.
    unchanged : Unchanged, optional
        What was read before of this library; what is read now and nobody changes is added.

    Raises
    ------
    DefinitionError
        With all problems of a file.
    UsageError
        For a name that nobody knows, or an override that fits nowhere.
    """
    changes = _sorted_out(overrides or {})
    known: Unchanged = {} if unchanged is None else unchanged

    def read(kind: str, name: str | Path) -> Loaded[Any]:
        changed = changes.get(kind)
        key = (kind, str(name))
        if changed or key not in known:
            found = load(kind, name, library=library, overrides=changed)
            if changed:
                return found
            known[key] = found
        return known[key]

    sheet: Loaded[Procedure] = read("procedure", procedure)
    legform: Loaded[Legform] = read("legform", sheet.document.specimen.legform)
    loaded: list[tuple[str, Loaded[BaseModel]]] = [("procedure", sheet), ("legform", legform)]
    vehicle: Loaded[Vehicle] | None = None
    if sheet.document.vehicle is not None:
        vehicle = read("vehicle", sheet.document.vehicle)
        loaded.append(("vehicle", vehicle))
    sets: dict[str, Loaded[CorridorSet]] = {
        name: read("corridors", name) for name in _named_sets(sheet.document, library)
    }
    loaded += [("corridors", corridors) for corridors in sets.values()]
    reference: Loaded[Reference] | None = None
    if sheet.document.reference is not None:
        reference = read("reference", sheet.document.reference)
        loaded.append(("reference", reference))
    return Setup(
        procedure=sheet.document,
        legform=legform.document,
        vehicle=vehicle.document if vehicle else None,
        corridors={name: corridors.document for name, corridors in sets.items()},
        reference=reference.document if reference else None,
        loaded=tuple(loaded),
    )


def input_file(loaded: Loaded[Any]) -> InputFile:
    """Return a definition as a document lists it among its inputs."""
    return InputFile(role=loaded.kind, path=loaded.path, sha256=loaded.sha256, text=loaded.text)


def without_model(setup: Setup) -> Setup:
    """Leave out the numbers of the simulated leg, rig and car; the legform's file stays, for its channels."""
    return replace(setup, model_left_out=True)


def _of_the_model(path: str) -> bool:
    """Tell whether a number is one of the simulation's own."""
    return path.startswith(OF_THE_MODEL) or path.partition(": ")[2].startswith("rig.")


def _sorted_out(overrides: Overrides) -> dict[str, dict[str, object]]:
    """Sort overrides by the definition they change."""
    changes: dict[str, dict[str, object]] = {"procedure": {}, **{kind: {} for kind in OF_THE_MODEL}}
    for path, value in overrides.items():
        kind, dot, inner = path.strip().partition(".")
        if kind in OF_THE_MODEL and dot:
            changes[kind][inner] = value
        elif path.strip() == "legform":
            changes["procedure"]["specimen.legform"] = value
        else:
            changes["procedure"][path] = value
    return changes


def _full(role: str, path: str) -> str:
    """Return a changed value's path as it was given: behind its definition's kind, if not the procedure."""
    return path if role == "procedure" else f"{role}.{path}"


def _named_sets(procedure: Procedure, library: Library) -> list[str]:
    """List the corridor sets that a procedure names and somebody supplies."""
    named = procedure.corridor_sets | ({procedure.score} if procedure.score else set())
    return sorted(named & set(names("corridors", library)))


def _parameters(loaded: Iterable[tuple[str, Loaded[BaseModel]]]) -> Iterable[Parameter]:
    for role, item in loaded:
        for entry in parameters(item.document):
            yield Parameter(
                path=f"{role} {item.name}: {entry.path}",
                value=entry.value,
                source=entry.source,
                confidence=entry.confidence,
            )
