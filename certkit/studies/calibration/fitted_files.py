"""The files a fit writes: the legform (and rigs) with the fitted numbers, the family, the report as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import yaml
from msgspec.structs import asdict

from certkit._version import __version__
from certkit.definitions.loading.kinds import kind_of
from certkit.definitions.loading.library import find
from certkit.definitions.loading.old_forms import modernised
from certkit.definitions.loading.overrides import ORIGIN, change
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.calibration_report import (
    CalibrationReport,
    FamilyFigures,
    FittedParameter,
    FittedValue,
    FollowedCurve,
    Following,
    ReachedBasin,
    StrongCorrelation,
)
from certkit.files import write_whole
from certkit.studies.calibration.leg_family import extent, passes
from certkit.studies.quantity import written
from certkit.studies.trial import scoped

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.loading.overrides import Overrides
    from certkit.studies.calibration.fit import Calibration
    from certkit.studies.points import Outcome
    from certkit.studies.recorded_curve import RecordedCurve

LEG = "legform."
ON_BOUND = 1e-3
"""Share of the bounds' width within which a number stands on its bound."""

NUMBER = {"value", "source", "confidence"}


def write_fit(calibration: Calibration, folder: Path) -> list[Path]:
    """Write `LEGFORM.yaml` and a `PROCEDURE.yaml` for every rig that was fitted too.

    All numbers that were free carry the confidence `calibrated` and the fit's name.
    """
    task = calibration.task
    overrides: dict[tuple[str, str], dict[str, str]] = {("legform", task.sheet.legform): {}}
    for path, value in changes(calibration, calibration.shares):
        scope, inner = scoped(path)
        key = ("procedure", scope) if scope else ("legform", task.sheet.legform)
        overrides.setdefault(key, {})[inner.removeprefix(LEG)] = value
    paths = []
    for (kind, name), changed in overrides.items():
        paths.append(folder / f"{name}.yaml")
        write_whole(paths[-1], _document(calibration, kind, name, changed))
    return paths


def write_family(calibration: Calibration, members: NDArray[Any], path: Path) -> None:
    """Write the family's file; `members` are shares of the bounds, shape (m, k), and numbered from 1."""
    sheet = calibration.task.sheet
    today = {path: calibration.task.trial.today(path) for path, _ in changes(calibration, calibration.shares)}
    document = {
        "family": sheet.legform,
        "title": f"{len(members)} legs that pass as {sheet.legform} does",
        "legform": sheet.legform,
        "origin": {"source": _source(calibration) + ", family", "confidence": "calibrated"},
        "procedures": [
            target.procedure for target in sheet.targets if _is_graded(calibration, target.procedure)
        ],
        "members": [
            {
                "id": f"{number:02d}",
                **_member(calibration, row, today),
            }
            for number, row in enumerate(members, 1)
        ],
    }
    head = (
        "# Legs with other numbers that pass every graded criterion as well, written by `certkit calibrate`\n"
        f"# from the fit {sheet.fit}. The fitted leg is the base, and no member.\n"
    )
    write_whole(path, head + _yaml(document))


def _member(calibration: Calibration, row: NDArray[Any], today: Mapping[str, str]) -> dict[str, Any]:
    """Sort what a member has different by legform and rigs, under the paths of today."""
    values: dict[str, str] = {}
    rigs: dict[str, dict[str, str]] = {}
    for path, value in changes(calibration, row):
        scope, inner = scoped(today[path])
        if scope:
            rigs.setdefault(scope, {})[inner] = value
        else:
            values[inner.removeprefix(LEG)] = value
    return {"values": values, **({"rigs": rigs} if rigs else {})}


def changes(calibration: Calibration, shares: NDArray[Any]) -> list[tuple[str, str]]:
    """Return path and quantity of all that a place sets; a procedure's path has the procedure before it.

    `shares` of the bounds, shape (k,), are the place.
    """
    trial = calibration.task.trial
    found = []
    for name, value in calibration.task.space.point(shares).items():
        scope, first = scoped(name)
        for path, factor in ((first, 1.0), *trial.tied.get(name, ())):
            number = value if factor == 1 else factor * value
            found.append((f"{scope}/{path}" if scope else path, _short(number, trial.units[name])))
    return found


def report(calibration: Calibration, members: NDArray[Any] | None = None) -> CalibrationReport:
    """Return the document of a calibration, with figures of its family where one was found.

    `members` are shares of the bounds, shape (m, k).
    """
    task, known = calibration.task, calibration.knowledge
    before, after = calibration.before.outputs, calibration.after.outputs
    return CalibrationReport(
        fit=task.sheet.fit,
        title=task.sheet.title,
        legform=task.sheet.legform,
        runs=calibration.runs,
        rms_before=calibration.rms(calibration.before),
        rms_after=calibration.rms(calibration.after),
        passes=passes(calibration.after, task.trial.procedures),
        values=[
            FittedValue(
                name=goal.name,
                unit=goal.unit,
                aim=goal.aim,
                counts_as_one=goal.scale,
                graded=goal.graded,
                before=before.get(goal.name),
                after=after.get(goal.name),
                distance_before=goal.distance(before.get(goal.name)),
                distance_after=goal.distance(after.get(goal.name)),
                left_out=calibration.left_out.get(goal.name),
            )
            for goal in task.goals
            if not goal.curve
        ],
        curves=[_followed(calibration, curve) for curve in task.trial.curves],
        parameters=[
            FittedParameter(
                name=axis.name,
                unit=axis.unit,
                before=axis.start,
                after=axis.value(float(share)),
                deviation=known.deviations[axis.name],
                lower=axis.low,
                upper=axis.high,
                narrowed_to=known.narrowed[axis.name],
                determined=axis.name not in known.undetermined,
                on_bound=not ON_BOUND < share < 1 - ON_BOUND,
                reason=parameter.reason,
            )
            for axis, share, parameter in zip(
                task.space.axes, calibration.shares, task.sheet.parameters, strict=True
            )
        ],
        basins=[
            ReachedBasin(
                start=basin.start,
                rms=basin.rms,
                squares=basin.squares,
                distance=float(np.sqrt(np.mean((basin.shares - calibration.shares) ** 2))),
            )
            for basin in calibration.basins
        ],
        nearer_elsewhere=calibration.nearer,
        family=None if members is None else FamilyFigures(members=len(members), **asdict(extent(members))),
        correlations=[StrongCorrelation(between=(a, b), coefficient=c) for a, b, c in known.correlations],
        open_directions=list(known.open),
        certkit=__version__,
    ).with_id()


def _document(calibration: Calibration, kind: str, name: str, overrides: Overrides) -> str:
    known = kind_of(kind)
    found = find(known, name, calibration.task.trial.library)
    # Written in the form of today, whatever form the file and the fit's paths have.
    tree, overrides, _ = modernised(known, read_tree(found.data, found.label), overrides)
    tree, _ = change(tree, overrides, known.model)
    data = _sourced(tree.data, {"source": _source(calibration), "confidence": "calibrated"})
    head = f"# Written by `certkit calibrate` from {found.label} and the fit {calibration.task.sheet.fit}.\n"
    return head + _yaml(data)


def _followed(calibration: Calibration, curve: RecordedCurve) -> FollowedCurve:
    """Say how well the simulated curve followed the recorded one, before and after the fit."""
    scale = curve.dimension.scale
    return FollowedCurve(
        name=curve.name,
        unit=curve.dimension.unit,
        window=(curve.start * curve.across.scale, curve.end * curve.across.scale),
        window_unit=curve.across.unit,
        recorded_peak=curve.peak * scale,
        before=_following(calibration.before, curve),
        after=_following(calibration.after, curve),
    )


def _following(outcome: Outcome, curve: RecordedCurve) -> Following:
    def figure(word: str) -> float | None:
        value = outcome.outputs.get(f"{curve.name} {word}")
        return value if isinstance(value, float) else None

    return Following(
        rms_percent=figure("rms %"),
        peak=figure("peak"),
        peak_error_percent=figure("peak error %"),
        time_error_ms=figure("time error ms"),
        score=figure("score"),
    )


def _source(calibration: Calibration) -> str:
    targets = ", ".join(dict.fromkeys(target.procedure for target in calibration.task.sheet.targets))
    return f"fit {calibration.task.sheet.fit} to {targets}"


def _is_graded(calibration: Calibration, procedure: str) -> bool:
    return calibration.after.outputs.get(f"{procedure}/verdict") == "pass"


def _sourced(data: Any, origin: dict[str, str]) -> Any:  # noqa: ANN401  # plain YAML data
    """Say of every changed number that it comes from the fit instead of the command line."""
    if isinstance(data, dict):
        if data.get("source") == ORIGIN["source"]:
            return {**data, **origin}
        return {key: _sourced(value, origin) for key, value in data.items()}
    if isinstance(data, list):
        return [_sourced(value, origin) for value in data]
    return data


def _short(value: float, unit: str) -> str:
    return written(float(f"{value:.6g}"), unit)


class _Dumper(yaml.SafeDumper):
    """Numbers with their origin, and short lists, stand on one line."""


def _mapping(dumper: _Dumper, data: dict[str, Any]) -> yaml.Node:
    flow = set(data) <= NUMBER or {"id", "values"} <= set(data)
    return dumper.represent_mapping("tag:yaml.org,2002:map", data.items(), flow_style=flow)


def _sequence(dumper: _Dumper, data: list[Any]) -> yaml.Node:
    flow = not any(isinstance(item, dict) and not set(item) <= NUMBER for item in data)
    return dumper.represent_sequence("tag:yaml.org,2002:seq", data, flow_style=flow)


def _number(dumper: _Dumper, data: float) -> yaml.Node:
    tag = "int" if isinstance(data, int) else "float"
    return dumper.represent_scalar(f"tag:yaml.org,2002:{tag}", str(data))


_Dumper.add_multi_representer(int, _number)
_Dumper.add_multi_representer(float, _number)
_Dumper.add_representer(dict, _mapping)
_Dumper.add_representer(list, _sequence)


def _yaml(document: dict[str, Any]) -> str:
    return yaml.dump(document, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=100_000)
