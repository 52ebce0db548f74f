"""U of one criterion: what each source adds by the GUM, the Monte Carlo interval, and what both mean.

The formulas stand in `certkit.studies.propagate_uncertainty`.
"""

from __future__ import annotations

import math
from statistics import NormalDist
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.documents.uncertainty_report import BudgetLine, CriterionUncertainty
from certkit.errors import UsageError
from certkit.grading.decision import COVERAGE, false_accept
from certkit.studies.factors import NormalFactor, Triangular, Uniform

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from certkit.grading.asked_criterion import AskedCriterion
    from certkit.studies.factors import Factor
    from certkit.studies.points import Outcome


class SensorError(Struct, frozen=True):
    """Standard uncertainties of one channel: of its gain as a share, of its offset in the channel's unit."""

    gain: float = 0.0
    offset: float = 0.0


def standard_uncertainty(factor: Factor) -> float:
    """Return the standard deviation of a factor's distribution (JCGM 100, 4.3): (b − a)/√12 of a uniform one.

    Raises
    ------
    UsageError
        When it has none.
    """
    spread = factor.distribution
    if isinstance(spread, Uniform):
        return (spread.high - spread.low) / math.sqrt(12)
    if isinstance(spread, Triangular):
        a, b, c = spread.low, spread.high, spread.mode
        return math.sqrt((a * a + b * b + c * c - a * b - a * c - b * c) / 18)
    if isinstance(spread, NormalFactor):
        return spread.sd
    raise UsageError(f"{factor.name}: a list of values is no tolerance")


def criterion_uncertainty(  # what one criterion's figures rest on
    criterion: AskedCriterion,
    output: str,
    outcomes: tuple[Outcome, Sequence[Outcome], Sequence[Outcome]],
    factors: Sequence[Factor],
    sensor: SensorError,
    risk: float,
    draws: tuple[np.random.Generator, int],
) -> CriterionUncertainty:
    """Return U of one criterion and what it comes from.

    Parameters
    ----------
    criterion : AskedCriterion
    output : str
        Its column in the outcomes.
    outcomes : (Outcome, sequence of Outcome, sequence of Outcome)
        With everything as it should be; of each factor a standard uncertainty above and below; scattered by
        the factors' distributions.
    factors : sequence of Factor
    sensor : SensorError
        Of its channel.
    risk : float
        Wanted probability of false acceptance.
    draws : (Generator, int)
        Where sensor errors are drawn from; how many, where nothing is scattered by runs.
    """
    first, sides, scattered = outcomes
    value = _number(first.outputs, output)
    lines: list[tuple[str, float, str, float | None, float]] = []
    for factor, up, down in zip(factors, sides[::2], sides[1::2], strict=True):
        step = standard_uncertainty(factor)
        change = (_number(up.outputs, output) - _number(down.outputs, output)) / 2
        lines.append((factor.name, step, factor.unit, change / step, change))
    if criterion.shows != "channel":  # no gain moves an instant; a curve's sensors are refused before
        sensor = SensorError()
    if sensor.gain:
        lines.append(("gain", 100 * sensor.gain, "%", None, abs(value) * sensor.gain))
    if sensor.offset:
        lines.append(("offset", sensor.offset, criterion.unit, None, sensor.offset))
    total = math.sqrt(sum(contribution**2 for *_, contribution in lines))
    made = np.array([_number(outcome.outputs, output) for outcome in scattered] or [value] * draws[1])
    values = _measured(made[np.isfinite(made)], sensor, draws[0])
    low, high = np.quantile(values, [0.025, 0.975])
    listed = sorted(
        (
            BudgetLine(
                name=name,
                standard=standard,
                unit=unit,
                sensitivity=sensitivity,
                contribution=contribution,
                share=(contribution / total) ** 2 if total else 0.0,
            )
            for name, standard, unit, sensitivity, contribution in lines
        ),
        key=lambda line: -line.share,
    )
    found = CriterionUncertainty(
        criterion=criterion.id,
        title=criterion.title,
        channel=criterion.channel,
        unit=criterion.unit,
        value=value,
        lower=criterion.lower,
        upper=criterion.upper,
        expanded=COVERAGE * total,
        simulated=float(high - low) / 2,
        farthest=float(max(high - value, value - low)),
        shift=float(values.mean()) - value,
        lines=listed,
    )
    return _with_risk(found, risk) if criterion.graded else found


def _measured(
    values: NDArray[np.float64], sensor: SensorError, chance: np.random.Generator
) -> NDArray[np.float64]:
    """Return true values as sensors with errors would show them."""
    gains = 1 + sensor.gain * chance.normal(size=values.size)
    found: NDArray[np.float64] = values * gains + sensor.offset * chance.normal(size=values.size)
    return found


def _with_risk(found: CriterionUncertainty, risk: float) -> CriterionUncertainty:
    """Fill in what U means for acceptance: JCGM 106, 8.3.2, w = z·u for the wanted risk at one limit."""
    needed = NormalDist().inv_cdf(1 - risk)
    margin = min(
        math.inf if found.lower is None else found.value - found.lower,
        math.inf if found.upper is None else found.upper - found.value,
    )
    allowed = COVERAGE * margin / needed if 0 <= margin < math.inf else None
    changes: dict[str, object] = {
        "false_accept": false_accept(found.value, found.lower, found.upper, found.counted),
        "guard_band": needed * found.counted / COVERAGE,
        "allowed": allowed,
    }
    if allowed is not None and found.counted > allowed and found.lines:
        largest = found.lines[0]
        rest = (found.expanded / COVERAGE) ** 2 - largest.contribution**2
        room = (allowed / COVERAGE) ** 2 - rest
        changes["tighten"] = largest.name
        straight = room > 0 and not found.bent  # else a share of U is no share of its cause
        changes["tighten_to"] = math.sqrt(room) / abs(largest.contribution) if straight else None
    return found.model_copy(update=changes)


def _number(outputs: Mapping[str, float | str | None], name: str) -> float:
    value = outputs.get(name)
    return float(value) if isinstance(value, (int, float)) else math.nan
