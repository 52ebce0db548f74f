"""Studies, optimisations and calibrations in some lines for a terminal, from their documents alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.number_format import MISSING, fixed, plain, signed, signed_significant, significant
from certkit.reporting.plaintext import aligned

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.documents.calibration_report import CalibrationReport
    from certkit.documents.optimum_report import OptimumReport
    from certkit.documents.rounding import FigureOrWord
    from certkit.documents.study_report import Effect, StudyReport


def study_text(document: StudyReport) -> str:
    """Return the chances to stay inside, or else the strongest effect on each output."""
    runs = f"{document.runs} runs" + (f", {document.failed} failed" if document.failed else "")
    if document.chances:
        unknown = document.chances[-1].unknown
        runs += f"; {unknown} that failed or were not evaluated count as outside" if unknown else ""
        most = {output: effect for effect, output in _strongest(document)}
        heads = ("criterion", "inside", "probability", "95 % interval", "moved most by", "share")
        rows = [
            (
                c.criterion,
                f"{c.inside} of {c.runs}",
                f"{c.probability:.3f}",
                f"{c.lower:.3f} to {c.upper:.3f}",
                most[c.criterion].factor if c.criterion in most else "",
                f"{100 * most[c.criterion].share:.0f} %" if c.criterion in most else "",
            )
            for c in document.chances
        ]
        return f"{aligned(heads, rows, right=(1, 2, 3, 5))}\n{runs}"
    names = ("output", "moved most by", "effect", "unit")
    moved = [
        (output, most.factor, signed_significant(most.effect, 4), document.output_units.get(output, ""))
        for most, output in _strongest(document)
    ]
    return f"{aligned(names, moved, right=(2,))}\n{runs}"


def _strongest(document: StudyReport) -> list[tuple[Effect, str]]:
    """Return the strongest effect on each output, with the output."""
    return [
        (max((e for e in document.effects if e.output == output), key=lambda e: e.share), output)
        for output in dict.fromkeys(effect.output for effect in document.effects)
        if output in document.outputs
    ]


def optimum_text(document: OptimumReport) -> str:
    """Return the best settings."""
    head = (
        "keeps all limits with the margin"
        if document.keeps_all_limits
        else "no settings keep all limits with the margin"
    )
    percent = fixed(100 * abs(document.slack), 1)
    tight = (
        f"tightest limit: {percent} % of it to spare beyond the margin"
        if document.slack >= 0
        else f"tightest limit: missed with the margin by {percent} % of it"
    )
    settings = (f"--set '{setting}'" for setting in document.settings)
    return "\n".join([f"{head} ({document.runs} runs); {tight}", *settings])


CURVE_HEADS = ("curve", "rms % before", "after", "peak", "after", "unit", "error %", "late by ms")


PASSES = {
    True: "every graded criterion passes",
    False: "not every graded criterion passes",
    None: "nothing is graded",
}


def calibration_text(document: CalibrationReport) -> str:
    """Return the values before and after, and how well the parameters are known."""
    heads = ("value", "should be", "before", "after", "unit", "distance")
    rows = [
        (v.name, plain(v.aim, 4), _figure(v.before), _figure(v.after), v.unit, signed(v.distance_after, 2))
        for v in document.values
    ]
    before, after = document.rms_before, document.rms_after
    distances = f"rms distance {before:.3f} before, {after:.3f} after ({document.runs} runs)"
    curves = [
        (
            curve.name,
            _figure(curve.before.rms_percent, fixed, 1),
            _figure(curve.after.rms_percent, fixed, 1),
            _figure(curve.recorded_peak),
            _figure(curve.after.peak),
            curve.unit,
            _figure(curve.after.peak_error_percent, signed, 1),
            _figure(curve.after.time_error_ms, signed, 1),
        )
        for curve in document.curves
    ]
    lines = [
        *([aligned(heads, rows, right=(1, 2, 3, 5))] if rows else []),
        *([aligned(CURVE_HEADS, curves, right=(1, 2, 3, 4, 6, 7))] if curves else []),
        distances,
        PASSES[document.passes],
    ]
    left_out = [v for v in document.values if isinstance(v.left_out, float)]
    if left_out:
        errors = [100 * (float(v.left_out or 0.0) / v.aim - 1) for v in left_out]
        rms = (sum(error**2 for error in errors) / len(errors)) ** 0.5
        each = ", ".join(f"{v.name} {signed(error, 1)} %" for v, error in zip(left_out, errors, strict=True))
        lines.append(f"each value predicted by the others: {rms:.1f} % rms ({each})")
    if document.basins:
        reached = ", ".join(f"{basin.rms:.3f}" for basin in document.basins)
        lines.append(f"other searches came to rms {reached}")
    if document.family is not None:
        family = document.family
        lines.append(
            f"family of {family.members}: {family.coverage:.0%} of the bounds, evenness "
            f"{family.evenness:.2f}, {family.dimensions:.1f} directions, nearest neighbours at "
            f"{family.distance:.2f} of an even spread"
        )
    open_ones = [parameter.name for parameter in document.parameters if not parameter.determined]
    if open_ones:
        lines.append(f"not determined by these tests: {', '.join(open_ones)}")
    on_bounds = [parameter.name for parameter in document.parameters if parameter.on_bound]
    if on_bounds:
        lines.append(f"on a bound: {', '.join(on_bounds)}")
    if document.nearer_elsewhere:
        lines.append("another search came nearer than this fit; take `start: anywhere`")
    if document.rms_after > 1:
        lines.append("the targets are not met, on the whole: deviations of the parameters are too small")
    return "\n".join(lines)


def _figure(
    value: FigureOrWord | None, form: Callable[[float | None, int], str] = significant, digits: int = 4
) -> str:
    return form(value, digits) if isinstance(value, float) else MISSING
