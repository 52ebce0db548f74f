"""Graded tests of a leg as a diagnosis looks at them: conditioned curves, and the rig as it really stood."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.bench.results_at_path import results_at
from certkit.bench.setup import prepare
from certkit.definitions.loading.library import load
from certkit.definitions.units import dimensions, from_si, unit_of
from certkit.documents.channel_curves import recording_of
from certkit.errors import DataError
from certkit.grading import measure_all
from certkit.logbooks.logbook_entry import entry_of
from certkit.studies.trial import numbers_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from certkit.definitions.diagnosis import Diagnosis
    from certkit.documents.result import Result
    from certkit.signals import Filtered


class TestedLeg(Struct, frozen=True):
    """One recording with the model of its test."""

    result: Result
    place: str
    overrides: Mapping[str, str]
    filtered: Filtered
    procedure: str
    day: str
    serial: str


def tested_legs(path: str | Path, sheet: Diagnosis, library: Sequence[Path]) -> list[TestedLeg]:
    """Read the graded tests that a path carries.

    Raises
    ------
    DataError
        When one is damaged, was changed, carries no channels, or is of another legform than the diagnosis.
    """
    found = []
    for place, result in results_at(path):
        entry = entry_of(result, place)
        changes = _changes_of(result, sheet, library)
        setup = prepare(result.procedure, library=library, overrides=changes)
        if setup.legform.legform != sheet.legform:
            raise DataError(
                f"{place}: a test of `{setup.legform.legform}`; the diagnosis is of `{sheet.legform}`"
                "; name tests of that legform"
            )
        recording = recording_of(result, table=setup.legform.channel_table)
        filtered = measure_all(setup.procedure, recording, lenient=True).filtered
        found.append(
            TestedLeg(result, place, changes, filtered, result.procedure, entry.day.isoformat(), entry.serial)
        )
    return found


def _changes_of(result: Result, sheet: Diagnosis, library: Sequence[Path]) -> dict[str, str]:
    """Return the rig's values that the recording's conditions tell, where the procedure has them."""
    if not any(name in result.conditions for name in sheet.conditions):
        return {}
    known = dict(numbers_of(load("procedure", result.procedure, library=library).document))
    changes = {}
    for condition, path in sheet.conditions.items():
        value = result.conditions.get(condition)
        if value is not None and path in known:
            changes[path] = _written(value, known[path])
    return changes


def _written(value: float, like: str) -> str:
    """Write an SI value in the unit of another one."""
    unit = unit_of(like)
    return f"{from_si(value, dimensions(like)[0], unit)!r} {unit}"
