"""Sections on the bench's own procedures: verdicts, the middle of the corridors, step and energy."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import certkit
from certkit.definitions.loading.library import names
from docs.make.markdown import figure, table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from certkit.documents.result import CriterionResult, Result

FLESH_DEPTH = "flesh depth over its thickness"
CERTIFYING = ("pendulum", "inverse")
STEPS = (20.0, 10.0, 5.0, 2.5)
"""Time steps of the refinement, µs."""


def all_procedures(tell: Callable[[str], None]) -> dict[str, Result]:
    """Run every shipped procedure."""
    results = {}
    for name in names("procedure"):
        tell(f"run {name}")
        results[name] = certkit.run(name)
    return results


def procedures_table(results: dict[str, Result]) -> str:
    """Return verdict and quality figures of each procedure."""
    rows = []
    for name, result in results.items():
        quality = result.quality
        if quality is None:
            continue
        change = quality.step_change_percent
        rows.append(
            (
                f"`{name}`",
                result.verdict,
                f"{quality.energy_error_percent:.3f} %",
                f"{quality.joint_gap_mm:.4f} mm",
                f"{quality.penetration_mm:.2f} mm" if quality.penetration_mm is not None else "",
                next((f"{c.value:.0f} %" for c in quality.checks if c.title == FLESH_DEPTH), "–"),
                "–" if change is None else f"{change:.3f} %",
                f"{quality.steps:,}".replace(",", "\u202f"),
                f"{quality.time_step * 1e6:g} µs",
            )
        )
    heads = (
        "procedure",
        "verdict",
        "energy error",
        "joint gap",
        "penetration",
        "flesh depth of its thickness",
        "step halved",
        "steps",
        "time step",
    )
    return table(heads, rows)


def middles_table(results: dict[str, Result]) -> str:
    """Return where each graded value of the two dynamic tests lies in its corridor."""
    rows = []
    for name in CERTIFYING:
        for each in results[name].criteria:
            if not each.graded:
                continue
            off = from_middle(each)
            numerical = each.uncertainty.numerical if each.uncertainty else None
            rows.append(
                (
                    f"`{name}`",
                    each.id,
                    _shown(each.value, each.unit),
                    f"{each.lower:g} to {each.upper:g}",
                    "–" if off is None else f"{round(100 * off):+d} %".replace("-", "−"),
                    "–" if numerical is None else f"± {numerical:.2g} {each.unit}",
                )
            )
    heads = ("test", "channel", "value", "corridor", "off the middle, of the half-width", "numerical")
    return table(heads, rows)


def farthest(results: dict[str, Result]) -> float:
    """Return the largest distance of a graded dynamic value from its corridor's middle, in half-widths."""
    found = [
        abs(off)
        for name in CERTIFYING
        for each in results[name].criteria
        if each.graded and (off := from_middle(each)) is not None
    ]
    return max(found)


def from_middle(criterion: CriterionResult) -> float | None:
    """Return the distance of a value from the middle of its corridor, in half-widths."""
    value, lower, upper = criterion.value, criterion.lower, criterion.upper
    if value is None or lower is None or upper is None:
        return None
    return (2 * value - lower - upper) / (upper - lower)


def steps_table(procedure: str, tell: Callable[[str], None]) -> str:
    """Return the graded values at several time steps, and the order at which they settle."""
    runs = []
    for step in STEPS:
        tell(f"run {procedure} at {step:g} µs")
        overrides = {"run.time step": f"{step:g} µs"}
        runs.append(certkit.run(procedure, overrides=overrides, refine=False))
    rows = []
    for index, criterion in enumerate(runs[0].criteria):
        if not criterion.graded:
            continue
        values = [run.criteria[index].value for run in runs]
        known = [value for value in values if value is not None]
        if len(known) < len(values):
            continue
        rows.append(
            (criterion.id, *(f"{value:.4f}" for value in known), criterion.unit, _order(known), _left(known))
        )
    heads = ("channel", *(f"{step:g} µs" for step in STEPS), "unit", "order", "left at the smallest step")
    return table(heads, rows)


def _order(values: Sequence[float]) -> str:
    """Return the order observed over the first three steps, each half of the one before."""
    first, second = abs(values[0] - values[1]), abs(values[1] - values[2])
    return "–" if not first or not second else f"{math.log2(first / second):.1f}"


def _left(values: Sequence[float]) -> str:
    """Return the last change, of the value."""
    return f"{abs(values[-1] - values[-2]) / abs(values[-1]) * 100:.3f} %" if values[-1] else "–"


def _shown(value: float | None, unit: str) -> str:
    return "–" if value is None else f"{figure(value)} {unit}"
