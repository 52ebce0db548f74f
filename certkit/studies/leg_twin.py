"""`twin`: fit the model to a leg's recordings part by part, and say which part explains how it differs."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from certkit._version import __version__
from certkit.definitions.diagnosis import Diagnosis
from certkit.definitions.loading.library import folders_of, load
from certkit.definitions.units import parse_quantity
from certkit.documents.twin_report import PartFinding, TwinCurve, TwinReport, TwinTest
from certkit.errors import DataError, UsageError
from certkit.reasons import Reason
from certkit.reporting.language import worded
from certkit.studies.part_hypotheses import (
    DEVIATES,
    FARTHEST,
    TOLD_APART,
    Compared,
    PartFit,
    PartHypothesis,
    misfit_of,
)
from certkit.studies.part_model import PartModel
from certkit.studies.quantity import share
from certkit.studies.tested_legs import TestedLeg, tested_legs

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.diagnosis import SuspectPart
    from certkit.documents.twin_report import Answer
    from certkit.signals import Filtered

USUAL = "flex-pli-gtr"
"""Diagnosis that is taken when none is named."""
QUIET = -0.002
"""Time before which a channel shows nothing but noise, s."""
FEWEST = 20
"""Quiet samples below which a channel's noise is taken from the diagnosis' floor alone."""
WIDE = 1.96
REFINED = 4
"""Parts for which the model is run again at their best change."""


def twin(
    recordings: Sequence[str | Path],
    *,
    diagnosis: str | Path = USUAL,
    against: str | Path | None = None,
    library: str | Path | Sequence[str | Path] = (),
) -> TwinReport:
    """Say which part of a leg explains how its recordings differ from the model, or from an earlier test.

    Parameters
    ----------
    recordings : sequence of str or Path
        Graded tests of one legform: certificates (PDF), `result.json`, or folders of runs.
    diagnosis : str or Path
        Name or file of the parts that are looked at.
    against : str or Path, optional
        An earlier test of the same procedure: what has changed since is looked for, and what the model does
        not follow in both drops out. The model itself when missing.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.

    Raises
    ------
    DataError
        When a recording is damaged, was changed, carries no channels, or is of another legform or procedure.
    UsageError
        When nothing is given, or the diagnosis does not fit.
    """
    folders = folders_of(library)
    sheet = load("diagnosis", diagnosis, library=folders).document
    if not isinstance(sheet, Diagnosis):
        raise TypeError("not a diagnosis")
    legs = [leg for path in recordings for leg in tested_legs(path, sheet, folders)]
    if not legs:
        raise UsageError("name at least one graded test")
    serials = sorted({leg.serial for leg in legs})
    if len(serials) > 1:
        raise DataError(f"recordings of several legforms ({', '.join(serials)}); name those of one")
    before = list(tested_legs(against, sheet, folders)) if against is not None else []
    told = [_told(leg, sheet, before, folders) for leg in sorted(legs, key=lambda leg: (leg.day, leg.place))]
    remarks = [
        Reason.of("twin-one-part-at-a-time"),
        *([] if before else [Reason.of("twin-against-the-model")]),
    ]
    return (
        worded(
            TwinReport(
                diagnosis=sheet.diagnosis,
                title=f"Twin of legform {serials[0]}",
                legform=serials[0],
                against=before[0].result.id if before else "",
                tests=told,
                coded_remarks=remarks,
                certkit=__version__,
            )
        )
        .as_written()
        .with_id()
    )


def _told(leg: TestedLeg, sheet: Diagnosis, before: Sequence[TestedLeg], library: Sequence[Path]) -> TwinTest:
    base = next((each for each in before if each.procedure == leg.procedure), None)
    if before and base is None:
        raise DataError(
            f"{leg.place}: a test of `{leg.procedure}`; the earlier one is of another procedure"
            "; name tests of one"
        )
    model = PartModel(leg.procedure, leg.overrides, sheet, library)
    unchanged = model.curves({})
    recorded = model.at_places(leg.filtered)
    names = [name for name in unchanged if name in recorded]
    if not names:
        raise DataError(f"{leg.place}: has neither bone moments nor elongations to look at")
    unchanged = {name: unchanged[name] for name in names}
    compared = _compared(leg, base, unchanged, model, sheet)
    weights = compared.inverse_covariance()
    asked = {
        part.part: PartHypothesis.probed(partial(_changed, model, names, part), unchanged, model.usual(part))
        for part in model.parts
    }
    straight = {name: each.straight(compared, weights) for name, each in asked.items()}
    # The model is run again for those that could be the best; the others stay as its derivative has them.
    nearest = sorted(straight, key=lambda name: straight[name].misfit)[:REFINED]
    fits = straight | {name: asked[name].refined(straight[name], compared, weights) for name in nearest}
    none = misfit_of(unchanged, compared, weights)
    samples = sum(row.size for row in compared.values.values())
    ranked = sorted(((part, fits[part.part]) for part in model.parts), key=lambda pair: pair[1].misfit)
    best = ranked[0][1]
    width = math.sqrt(max(1.0, best.misfit / samples))
    findings = [_finding(part, fit, model, width, (none, best.misfit, samples)) for part, fit in ranked]
    return TwinTest(
        id=leg.result.id,
        procedure=leg.procedure,
        day=leg.day,
        serial=leg.serial,
        answer=_answer(
            deviates=none - best.misfit >= DEVIATES * width**2,
            explained=compared.is_noise(
                unchanged if none - best.misfit < DEVIATES * width**2 else best.curves
            ),
            alone=_alone(asked, ranked[0][0].part, best, compared, weights),
            candidates=sum(each.candidate for each in findings),
        ),
        misfit=none / samples,
        samples=samples,
        findings=findings,
        curves=[_curve(name, leg, compared, unchanged, best, model.places) for name in names],
    )


def _changed(
    model: PartModel, names: Sequence[str], part: SuspectPart, change: float
) -> dict[str, NDArray[np.float64]]:
    """Return the curves that were recorded too, with a part changed."""
    made = model.changed(part, change)
    return {name: made[name] for name in names}


def _compared(
    leg: TestedLeg,
    base: TestedLeg | None,
    unchanged: Mapping[str, NDArray[np.float64]],
    model: PartModel,
    sheet: Diagnosis,
) -> Compared:
    """Return what was recorded, or how the model would have to be for the change since an earlier test."""
    recorded = model.at_places(leg.filtered)
    earlier = None if base is None else model.at_places(base.filtered)
    floor, gain = share(sheet.floor) or 0.0, share(sheet.gain) or 0.0
    tests = 1 if base is None else 2  # each has a gain and a time zero of its own
    values, slopes, noise = {}, {}, {}
    for name, made in unchanged.items():
        row = recorded[name]
        variance = _noise(leg.filtered, name, model.filter) ** 2 + (floor * float(np.abs(row).max())) ** 2
        if earlier is not None and base is not None and name in earlier:
            row = row - earlier[name] + made
            variance += _noise(base.filtered, name, model.filter) ** 2
            variance += (floor * float(np.abs(earlier[name]).max())) ** 2
        values[name] = row
        slopes[name] = np.gradient(row, model.places)
        noise[name] = math.sqrt(variance) or 1.0
    trigger = parse_quantity(sheet.trigger, "time")
    return Compared(values, slopes, noise, gain * tests**0.5, trigger * tests**0.5)


def _noise(filtered: Filtered, name: str, words: str) -> float:
    """Return what a channel shows before contact, its standard deviation."""
    quiet = filtered.values(name, words)[filtered.recording.time < QUIET]
    return float(quiet.std()) if quiet.size >= FEWEST else 0.0


def _curve(
    name: str,
    leg: TestedLeg,
    compared: Compared,
    unchanged: Mapping[str, NDArray[np.float64]],
    best: PartFit,
    places: NDArray[np.float64],
) -> TwinCurve:
    channel = leg.filtered.recording[name]
    scale = channel.dimension.scale
    return TwinCurve(
        channel=name,
        title=channel.title,
        unit=channel.dimension.unit,
        time=places.tolist(),
        recorded=(scale * compared.values[name]).tolist(),
        model=(scale * unchanged[name]).tolist(),
        changed=(scale * best.curves[name]).tolist(),
    )


def _alone(
    asked: Mapping[str, PartHypothesis],
    best: str,
    fit: PartFit,
    compared: Compared,
    weights: NDArray[np.float64],
) -> bool:
    """Tell whether the best part does it within what parts differ by, and leaves nothing to another one."""
    first = asked[best]
    if abs(fit.change) >= FARTHEST * first.usual * (1 - 1e-9):
        return False
    others = [each for name, each in asked.items() if name != best]
    return all(each.takes_away(first, fit, compared, weights) < DEVIATES for each in others)


def _answer(*, deviates: bool, explained: bool, alone: bool, candidates: int) -> Answer:
    if not explained:
        return "no part explains it"
    if not deviates:
        return "nothing deviates"
    if candidates > 1:
        return "several parts would do"
    return "one part" if alone else "no part explains it"


def _finding(
    part: SuspectPart,
    fit: PartFit,
    model: PartModel,
    width: float,
    misfits: tuple[float, float, int],
) -> PartFinding:
    none, best, samples = misfits
    unit, scale = model.shown(part)
    reach = WIDE * fit.deviation * width
    return PartFinding(
        part=part.part,
        change=scale * fit.change,
        unit=unit,
        lower=scale * (fit.change - reach),
        upper=scale * (fit.change + reach),
        misfit=fit.misfit / samples,
        explained=max(0.0, 1 - fit.misfit / none) if none > 0 else 0.0,
        candidate=fit.misfit - best < TOLD_APART * width**2,
        remedy=part.remedy,
    )
