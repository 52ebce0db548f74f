"""What a virtual test is graded by beside its procedure: the run's quality and the model it was done with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.bench.setup import input_file
from certkit.definitions.loading.library import load
from certkit.documents.result import Histories, Series
from certkit.documents.rounding import rounded_series
from certkit.grading.virtual_test_checks import LIMITS, certification_check, run_checks

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.channel_mapping import Mapping as ChannelMapping
    from certkit.definitions.loading.library import Library
    from certkit.definitions.procedure import Procedure
    from certkit.grading import LaboratoryTerms
    from certkit.signals import Recording

MOST_POINTS = 400
"""Samples of each drawn energy."""


def virtual_test_terms(
    laboratory: LaboratoryTerms,
    procedure: Procedure,
    recording: Recording,
    mapping: ChannelMapping | None,
    library: Library = (),
) -> LaboratoryTerms:
    """Add the checks of a finite-element run, and its legform model, to what the laboratory says.

    Parameters
    ----------
    laboratory : LaboratoryTerms
        Of the office that ran the simulation; often empty.
    procedure : Procedure
        A static test has no free flight.
    recording : Recording
        With what the run tells of its quality among the conditions.
    mapping : Mapping, optional
        Names the legform model; without it nobody does.
    library : str, Path, or sequence of them
        Where a set `virtual-test` with other limits is looked for first.
    """
    limits = load("corridors", LIMITS, library=library)
    rows = run_checks(limits.document, recording.conditions, static=procedure.test_kind == "static")
    layout = None if mapping is None else mapping.finite_elements
    told = None if mapping is None else mapping.legform_model
    model = told if layout is None else layout.legform_model
    name = "" if model is None else model.name
    certification = None if model is None else model.certification
    specimen = {"legform": name} if name else {}
    if certification:
        specimen["certification"] = certification
    if layout is not None and layout.vehicle:
        specimen["vehicle"] = layout.vehicle
    return replace(
        laboratory,
        checks=(*laboratory.checks, *rows, certification_check(name, certification)),
        specimen={**specimen, **laboratory.specimen},
        inputs=(*laboratory.inputs, input_file(limits)),
    )


def energies_of(recording: Recording, energies: Mapping[str, NDArray[np.float64]]) -> Histories | None:
    """Return the run's energies over time (J, shape (n,) each), thinned out; None where it told none."""
    if not energies:
        return None
    every = -(-recording.time.size // MOST_POINTS)
    return Histories(
        start=float(recording.time[0]),
        interval=recording.interval * every,
        count=len(range(0, recording.time.size, every)),
        series={
            name: Series(title=name, unit="J", values=rounded_series(values[::every]))
            for name, values in energies.items()
        },
    )
