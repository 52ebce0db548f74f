"""Curves of recordings as targets of a fit: read, cut to their window, and turned into goals."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from certkit.bench.sources import load_source
from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.channels import TIME
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.library import load
from certkit.errors import UsageError
from certkit.grading.quantities import quantity
from certkit.signals import Filtered
from certkit.studies.calibration.targets import Goal
from certkit.studies.quantity import share
from certkit.studies.recorded_curve import RecordedCurve, curve_name, curve_of

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.definitions.calibration import Target
    from certkit.definitions.channels import ChannelTable


def recorded_curves(targets: Sequence[Target], folder: Path) -> dict[str, RecordedCurve]:
    """Read all curves that the targets name, by their names.

    Parameters
    ----------
    targets : sequence of Target
        Those that aim at a recording.
    folder : Path
        Where recordings and mappings are looked for.

    Raises
    ------
    UsageError, DataError
        When a file or channel is missing, or two targets want one curve in different windows.
    """
    found: dict[str, RecordedCurve] = {}
    for target in targets:
        for curve in _curves(target, folder):
            other = found.get(curve.name, curve)
            merged = replace(
                curve, points=max(curve.points, other.points), scored=curve.scored or other.scored
            )
            if replace(other, points=merged.points, scored=merged.scored) != merged:
                raise UsageError(
                    f"{curve.name}: two targets take it from different files, filters or windows; "
                    "give both the same"
                )
            found[curve.name] = merged
    return found


def recorded_goals(target: Target, curves: dict[str, RecordedCurve]) -> list[Goal]:
    """Return the goals of one target: a value at each place, a peak, or a score."""
    tolerance = share(target.tolerance)
    if tolerance is None:
        raise UsageError(f"{target.procedure}: the tolerance has to be a share such as `5 %`")
    goals = []
    table = next(curve.table for curve in curves.values() if curve.procedure == target.procedure)
    for pair in _pairs(target, table):
        curve = curves[curve_name(target.procedure, *pair)]
        scale, unit = curve.dimension.scale, curve.dimension.unit
        one = tolerance * abs(curve.peak) * scale
        if not one:
            raise UsageError(
                f"{curve.name}: {target.tolerance} of the recorded peak is nothing: "
                "leave the channel out, which may be dead"
            )
        if target.measure == "peak":
            goals.append(
                Goal(f"{curve.name} peak", curve.peak * scale, one, unit, target.weight, graded=False)
            )
        elif target.measure == "ISO/TS 18571":
            goals.append(Goal(f"{curve.name} score", 1.0, tolerance, "", target.weight, graded=False))
        else:
            # All places together count as much as one value.
            weight = target.weight / np.sqrt(curve.points)
            goals += [
                Goal(curve.at(place), value * scale, one, unit, weight, graded=False, curve=curve.name)
                for place, value in zip(
                    curve.places.tolist(), curve.recorded(curve.places).tolist(), strict=True
                )
            ]
    return goals


def _pairs(target: Target, table: ChannelTable) -> list[tuple[str, str]]:
    """Return abscissa (empty: time) and ordinate of each curve, by the channels' short names."""
    if target.curve is not None:
        pairs = [(table.name(target.curve.x), table.name(target.curve.y))]
    else:
        pairs = [("", table.name(words)) for words in target.channels or ()]
    for pair in pairs:
        for name in pair:
            if name and table.find(name) is None:
                raise UsageError(
                    f"{target.procedure}: no channel is called `{name}`; {suggestion(name, table.kinds)}"
                )
    return pairs


def _curves(target: Target, folder: Path) -> list[RecordedCurve]:
    mapping = load("mapping", folder / target.mapping).document if target.mapping else None
    if not isinstance(mapping, Mapping | None):
        raise TypeError("not a mapping")
    recording = load_source(folder / str(target.recording), mapping).recording
    filtered = Filtered(recording)
    where = f"{target.procedure}, `contact`"
    contact = quantity(target.contact, TIME, where)
    curves = []
    for abscissa, ordinate in _pairs(target, recording.table):
        x, y = curve_of(filtered, abscissa, ordinate, target.filter)
        kind = recording.table.find(abscissa)
        if not abscissa:
            x = x - contact
        start, end = max(0.0, float(x[0])), float(x[-1])
        if target.window is not None:
            across = kind.dimension if kind is not None else TIME
            start, end = (quantity(t, across, f"{target.procedure}, `window`") for t in target.window)
        slack = 1e-6 * abs(end - start)
        name = curve_name(target.procedure, abscissa, ordinate)
        if not start < end:
            raise UsageError(f"{name}: the window is empty; its end has to lie behind its start")
        if start < x[0] - slack or end > x[-1] + slack:
            raise UsageError(f"{name}: {target.recording} does not cover the window; make it smaller")
        curves.append(
            RecordedCurve(
                procedure=target.procedure,
                abscissa=abscissa,
                ordinate=ordinate,
                words=target.filter,
                x=tuple(x.tolist()),
                y=tuple(y.tolist()),
                start=start,
                end=end,
                points=target.points,
                scored=target.measure == "ISO/TS 18571",
                table=recording.table,
            )
        )
    return curves
