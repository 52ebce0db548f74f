"""Uncertainty of a test: tolerances of rig and sensors propagated through the model, by two ways.

By the GUM (JCGM 100:2008, 5.1.2): U = 2·√Σ(c_i·u_i)², with sensitivities c_i from two runs each, a standard
uncertainty to both sides. By Monte Carlo (JCGM 101:2008): rig values in a Latin hypercube by their
distributions, sensor errors drawn for each run; half of the interval that holds 95 % of the values. Where the
model is bent within the tolerances, the two differ.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from certkit._version import __version__
from certkit.bench.render_documents import render
from certkit.bench.result_folder import refuse_other_name
from certkit.definitions.channels import TIME
from certkit.definitions.loading.library import folders_of, load
from certkit.definitions.uncertainty_budget import UncertaintyBudget
from certkit.definitions.units import split_quantity
from certkit.documents.uncertainty_report import CriterionUncertainty, UncertaintyReport
from certkit.errors import RunError, UsageError
from certkit.files import write_whole
from certkit.grading.asked_criterion import AskedCriterion, asked_criterion
from certkit.grading.decision import COVERAGE
from certkit.studies.combined_uncertainty import (
    SensorError,
    criterion_uncertainty,
    standard_uncertainty,
)
from certkit.studies.designs.latin_hypercube import latin_hypercube
from certkit.studies.execution import USUAL, Execution
from certkit.studies.factors import Factor, factor_of
from certkit.studies.journal import JOURNAL, forget
from certkit.studies.quantity import share
from certkit.studies.runs import Runs
from certkit.studies.trial import Trial

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from certkit.definitions.uncertainty_budget import SensorUncertainty
    from certkit.studies.points import Point

SNIPPET = "uncertainties.yaml"
"""File with the lines for a laboratory file."""


def uncertainty(
    document: UncertaintyBudget | str | Path,
    *,
    out: str | Path | None = None,
    library: str | Path | Sequence[str | Path] = (),
    execution: Execution = USUAL,
    fresh: bool = False,
    force: bool = False,
) -> UncertaintyReport:
    """Propagate an uncertainty budget.

    Parameters
    ----------
    document : UncertaintyBudget, str or Path
        The budget, its shipped name, or its file.
    out : str or Path, optional
        Folder for the document, its page and the lines for a laboratory file. Nothing is written when
        missing.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.
    execution : Execution
        Where and how the runs are done.
    fresh : bool
        Forget the runs that an earlier call has done.
    force : bool
        Replace what `out` holds of another budget.

    Raises
    ------
    DefinitionError, UsageError
        Before anything is run: a path, unit or channel does not fit.
    RunError
        When the run with everything as it should be fails.
    """
    folders = folders_of(library)
    sheet = budget_sheet(document, folders)
    if out is None:
        return _propagated(sheet, folders, execution)
    folder = Path(out)
    refuse_other_name(folder, "budget", sheet.budget, (UncertaintyReport.file_name,), force=force)
    if fresh:
        forget(folder / JOURNAL)
    report = _propagated(sheet, folders, execution.kept_in(folder / JOURNAL))
    render(report, folder, "html", force=force, beside=lambda stage: [_snippet(report, stage)])
    return report


def budget_sheet(document: UncertaintyBudget | str | Path, library: Sequence[Path] = ()) -> UncertaintyBudget:
    """Return the budget that is given, named or in a file."""
    found = (
        document
        if isinstance(document, UncertaintyBudget)
        else load("budget", document, library=library).document
    )
    if not isinstance(found, UncertaintyBudget):
        raise TypeError("not an uncertainty budget")
    return found


def _propagated(sheet: UncertaintyBudget, library: Sequence[Path], execution: Execution) -> UncertaintyReport:
    names = tuple(map(str, library))
    bare = Trial((sheet.procedure,), fixed={p: str(v) for p, v in sheet.set.items()}, library=names)
    nominals = bare.nominals(tolerance.name for tolerance in sheet.rig)
    factors = [factor_of(tolerance, nominals) for tolerance in sheet.rig]
    trial = replace(bare, units={factor.name: factor.unit for factor in factors})
    criteria = _criteria(trial)
    errors = _sensor_errors(sheet.sensors, criteria.values())
    risk = share(sheet.risk)
    if risk is None or not 0 < risk < 0.5:
        raise UsageError(f"risk: `{sheet.risk}` is no probability between 0 and 50 %, such as `2.5 %`")
    middle: dict[str, float | str] = {factor.name: _middle(factor) for factor in factors}
    sides = [
        {**middle, factor.name: _middle(factor) + sign * standard_uncertainty(factor)}
        for factor in factors
        for sign in (1, -1)
    ]
    spread: list[Point] = list(latin_hypercube(factors, sheet.runs, sheet.seed)) if factors else []
    with Runs(trial, execution, context=trial.context) as runs:
        first, *others = runs([middle, *sides, *spread])
    if first.error:
        raise RunError(
            f"with everything as it should be, the run fails: {first.error}; correct the procedure first"
        )
    at_sides, scattered = others[: len(sides)], others[len(sides) :]
    failed = [outcome.error for outcome in at_sides if outcome.error]
    if failed:
        raise RunError(
            f"a run at the edge of a tolerance fails: {failed[0]}; narrow it, or correct the procedure"
        )
    chance = np.random.default_rng(sheet.seed)
    rows = [
        criterion_uncertainty(
            criterion,
            f"{sheet.procedure}/{name}",
            (first, at_sides, [outcome for outcome in scattered if not outcome.error]),
            factors,
            errors.get(criterion.channel, SensorError()),
            risk,
            (chance, sheet.runs),
        )
        for name, criterion in criteria.items()
        if first.outputs.get(f"{sheet.procedure}/{name}") is not None
    ]
    return (
        UncertaintyReport(
            budget=sheet.budget,
            title=sheet.title,
            procedure=sheet.procedure,
            risk=risk,
            runs=sheet.runs,
            failed=sum(bool(outcome.error) for outcome in scattered),
            criteria=rows,
            sources={
                **{tolerance.path: tolerance.source for tolerance in sheet.rig},
                **{", ".join(sensor.channels): sensor.source for sensor in sheet.sensors},
            },
            notes=sheet.notes,
            certkit=__version__,
        )
        .as_written()
        .with_id()
    )


def _middle(factor: Factor) -> float:
    """Return the median of a factor: its tolerance need not lie evenly around the definition's value."""
    return float(factor.distribution.quantile(0.5))


def _criteria(trial: Trial) -> dict[str, AskedCriterion]:
    """Return what the criteria of the procedure ask, by their ids."""
    setup = trial.prepared(trial.procedures[0], {})
    channels = setup.legform.channel_table
    return {c.id: asked_criterion(c, setup.corridors, channels) for c in setup.procedure.criteria}


def _sensor_errors(
    sensors: Sequence[SensorUncertainty], criteria: Collection[AskedCriterion]
) -> dict[str, SensorError]:
    units = {c.channel: c.unit for c in criteria if c.shows == "channel"}
    curves = {c.channel for c in criteria if c.shows == "curve"}
    found: dict[str, SensorError] = {}
    for place, sensor in enumerate(sensors):
        gain = 0.0 if sensor.gain is None else share(sensor.gain)
        if gain is None:
            raise UsageError(f"sensors.{place}.gain: `{sensor.gain}` is no share such as `0.8 %`")
        for channel in sensor.channels:
            if channel in curves:
                raise UsageError(
                    f"sensors.{place}.channels: `{channel}` is held against an area as a whole curve, "
                    "whose distance no gain or offset tells; leave it out"
                )
            if channel not in units:
                raise UsageError(
                    f"sensors.{place}.channels: no criterion is of the channel `{channel}`; there are "
                    f"{', '.join(units)}"
                )
            if channel in found:
                raise UsageError(f"sensors.{place}.channels: `{channel}` stands in two sensors; name it once")
            offset = _offset(sensor.offset, units[channel], f"sensors.{place}.offset")
            found[channel] = SensorError(gain / COVERAGE, offset / COVERAGE)
    return found


def _offset(written: str | None, unit: str, place: str) -> float:
    if written is None:
        return 0.0
    found = split_quantity(written)
    if found is None or found[1] != unit:
        raise UsageError(f"{place}: `{written}` should be a number in {unit}, as the channel's criterion is")
    return found[0]


def laboratory_lines(report: UncertaintyReport) -> str:
    """Return the lines of a laboratory file: U by channel, two digits, rounded up (JCGM 100, 7.2.6).

    Of several criteria of one channel the largest U counts; that of an instant is none of the channel.
    """
    lines = ["uncertainties: # expanded, k = 2; from the budget " + f"`{report.budget}`, {report.id}"]
    of_channel: dict[str, CriterionUncertainty] = {}
    for each in report.criteria:
        known = of_channel.get(each.channel)
        if each.unit != TIME.unit and each.counted > (0.0 if known is None else known.counted):
            of_channel[each.channel] = each
    for channel, each in of_channel.items():
        power = 10.0 ** (math.floor(math.log10(each.counted)) - 1)
        written = math.ceil(each.counted / power - 1e-9) * power
        why = f" # by Monte Carlo; by the GUM {each.expanded:.2g}" if each.bent else ""
        lines.append(f"  {channel}: {written:.6g} {each.unit}{why}")
    return "\n".join(lines) + "\n"


def _snippet(report: UncertaintyReport, folder: Path) -> Path:
    write_whole(folder / SNIPPET, laboratory_lines(report))
    return folder / SNIPPET
