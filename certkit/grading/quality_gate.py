"""The quality gate: a simulated run that leaves its numerical limits is an error, never a verdict."""

from __future__ import annotations

import math
from typing import Protocol

from certkit.documents.result import Quality, QualityCheck
from certkit.reasons import Reason

ENERGY_LIMIT = 0.5
"""Percent of the energy turned over."""
JOINT_GAP_LIMIT = 0.02
"""Millimetres between the two sides of a joint."""
STEP_CHANGE_LIMIT = 0.5
"""Percent by which halving the time step may change a criterion."""
PENETRATION_LIMIT = 2.0
"""Millimetres that rigid bodies may overlap; contacts are springs, so they overlap a little under load."""


class Figures(Protocol):
    """The quality figures that a simulation yields (`certkit.mechanics`)."""

    @property
    def energy_error_percent(self) -> float:
        """Largest imbalance over the energy turned over."""

    @property
    def joint_gap_mm(self) -> float:
        """Largest distance between the two halves of a joint."""

    @property
    def penetration_mm(self) -> float:
        """Deepest overlap of bodies in contact."""

    @property
    def steps(self) -> int:
        """Number of time steps."""

    @property
    def time_step(self) -> float:
        """Seconds."""


def grade_quality(
    figures: Figures,
    *,
    step_change_percent: float | None = None,
    solver_seconds: float | None = None,
    penetration_limit: float = PENETRATION_LIMIT,
) -> Quality:
    """Hold a run's quality figures against their limits.

    Parameters
    ----------
    figures : Figures
    step_change_percent : float, optional
        Largest change of a criterion when the step is halved (`certkit.grading.refinement`); None when
        nobody looked.
    solver_seconds : float, optional
        Processor time, for information.
    penetration_limit : float
        Millimetres.

    Returns
    -------
    Quality
        Its verdict is `pass` or `error`. A figure that is not a number is beyond every limit.
    """
    rows = [
        ("energy-balance", figures.energy_error_percent, ENERGY_LIMIT, "%"),
        ("joint-gap", figures.joint_gap_mm, JOINT_GAP_LIMIT, "mm"),
        ("penetration", figures.penetration_mm, penetration_limit, "mm"),
    ]
    if step_change_percent is not None:
        rows.append(("step-change", step_change_percent, STEP_CHANGE_LIMIT, "%"))
    checks = [_check(*row) for row in rows]
    change = None if step_change_percent is None else checks[-1].value
    return Quality(
        verdict="pass" if all(check.verdict == "pass" for check in checks) else "error",
        energy_error_percent=checks[0].value,
        joint_gap_mm=checks[1].value,
        penetration_mm=checks[2].value,
        step_change_percent=change,
        steps=figures.steps,
        time_step=figures.time_step,
        solver_seconds=solver_seconds,
        checks=checks,
    )


def _check(code: str, value: float, limit: float, unit: str) -> QualityCheck:
    # The document holds no NaN; what is not a number is written down as far out of its limit as can be.
    shown = value if math.isfinite(value) else 1e300
    return QualityCheck(
        coded_title=Reason.of(code),
        value=shown,
        limit=limit,
        unit=unit,
        verdict="pass" if shown <= limit else "error",
    )
