"""Decision rules: how a value, its limits and its uncertainty become a verdict (ILAC-G8, JCGM 106).

Simple acceptance compares the value with the limits; it is the default because the regulation prescribes
absolute limits. With a guard band w = r·U the acceptance interval is narrowed by w at each limit; inside
the corridor but within w of a limit is `conditional`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import UsageError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.documents.result import Verdict

COVERAGE = 2.0
"""Coverage factor k of an expanded uncertainty: U = k·u."""


class DecisionRule(Struct, frozen=True):
    """A decision rule.

    Parameters
    ----------
    ratio : float
        r of the guard band w = r·U; 0 is simple acceptance.
    """

    ratio: float = 0.0

    def __post_init__(self) -> None:
        """Refuse a ratio that would widen the limits."""
        if not (math.isfinite(self.ratio) and self.ratio >= 0):
            raise UsageError(f"the guard band's ratio r is {self.ratio}; it has to be 0 or more")

    @property
    def reason(self) -> Reason:
        """Name the rule as the certificate does."""
        return Reason.of("guard-band", ratio=self.ratio) if self.ratio else Reason.of("simple-acceptance")


SIMPLE_ACCEPTANCE = DecisionRule()


class Decision(Struct, frozen=True):
    """What a rule decides.

    Parameters
    ----------
    verdict : Verdict
    margin : float or None
        Distance to the nearer limit, negative outside.
    guard_band : float or None
        w, in the unit of the value.
    false_accept : float or None
        Probability that the true value lies outside the limits though the value was accepted.
    reason : Reason or None
        Why, where the verdict alone does not say it.
    """

    verdict: Verdict
    margin: float | None
    guard_band: float | None = None
    false_accept: float | None = None
    reason: Reason | None = None


def decide(
    rule: DecisionRule,
    value: float,
    lower: float | None,
    upper: float | None,
    expanded: float | None = None,
    *,
    exclusive: bool = False,
) -> Decision:
    """Decide on a value.

    Parameters
    ----------
    rule : DecisionRule
    value : float
        A value that is not finite is never accepted.
    lower, upper : float or None
        Limits; both belong to the corridor. A side without a limit is open.
    expanded : float, optional
        Expanded uncertainty U (k = 2) in the unit of the value.
    exclusive : bool
        The limits do not belong to the corridor.

    Returns
    -------
    Decision
    """
    undecidable = _undecidable(rule, value, (lower, upper), expanded)
    if undecidable is not None:
        return Decision("not evaluated", None, reason=undecidable)
    margin = min(
        math.inf if lower is None else value - lower,
        math.inf if upper is None else upper - value,
    )
    if margin < 0 or (exclusive and margin == 0):
        return Decision("fail", margin)
    risk = None if expanded is None else false_accept(value, lower, upper, expanded)
    if rule.ratio == 0 or expanded is None:
        return Decision("pass", margin, false_accept=risk)
    band = rule.ratio * expanded
    if margin < band:
        return Decision("conditional", margin, band, risk, Reason.of("inside-guard-band"))
    return Decision("pass", margin, band, risk)


def _undecidable(
    rule: DecisionRule, value: float, limits: tuple[float | None, float | None], expanded: float | None
) -> Reason | None:
    """Say why nothing can be decided; None when something can."""
    given = [limit for limit in limits if limit is not None]
    if not math.isfinite(value):
        return Reason.of("value-not-finite")
    if not given or any(math.isnan(limit) for limit in given):
        return Reason.of("corridor-without-limit")
    if expanded is not None and not (math.isfinite(expanded) and expanded >= 0):
        return Reason.of("uncertainty-not-finite")
    if expanded is None and rule.ratio > 0:
        return Reason.of("uncertainty-missing")
    return None


def false_accept(value: float, lower: float | None, upper: float | None, expanded: float) -> float:
    """Return the probability that the true value lies outside the limits (JCGM 106, specific risk, normal).

    Parameters
    ----------
    value, lower, upper : float
        Measured value and limits; None is an open side.
    expanded : float
        Expanded uncertainty U = 2·u; 0 is a sure measurement.
    """
    scale = math.sqrt(2.0) * expanded / COVERAGE
    if scale == 0:
        outside = (lower is not None and value < lower) or (upper is not None and value > upper)
        return 1.0 if outside else 0.0
    below = 0.0 if lower is None else 0.5 * math.erfc((value - lower) / scale)
    above = 0.0 if upper is None else 0.5 * math.erfc((upper - value) / scale)
    return below + above
