"""The quality gate: a simulated run that leaves its numerical limits is an error, never a verdict."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol

from certkit.documents.result import Quality, QualityCheck
from certkit.documents.rounding import rounded_residual
from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.grading.front_limits import FrontUse
    from certkit.grading.refinement import StepChange

ENERGY_LIMIT = 0.5
"""Percent of the energy turned over."""
JOINT_GAP_LIMIT = 0.02
"""Millimetres between the two sides of a joint."""
STEP_CHANGE_LIMIT = 0.5
"""Percent by which halving the time step may change a criterion."""
PENETRATION_LIMIT = 2.0
"""Millimetres that rigid bodies may overlap; contacts are springs, so they overlap a little under load."""
FLESH_DEPTH_LIMIT = 100.0
"""Percent of its thickness by which flesh may be compressed: there it ends, at the bone."""


TRAVEL_LIMIT = 300.0
"""Millimetres that a group of a front may travel: there the radiator and the engine stand. An estimate;
the softest of the shipped fronts has 101. A group whose `room` is known is held against that."""
ROOM_LIMIT = 100.0
"""Percent of its room that a group may travel, and of its curve that an extracted spring may be shortened."""


class QualityFigures(Protocol):
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
    def flesh_depth_percent(self) -> float:
        """Largest depth of the flesh over its thickness; 0 where no flesh is compressed."""

    @property
    def steps(self) -> int:
        """Number of time steps."""

    @property
    def time_step(self) -> float:
        """Seconds."""


def grade_quality(
    figures: QualityFigures,
    *,
    step_change: StepChange | None = None,
    solver_seconds: float | None = None,
    front: FrontUse | None = None,
) -> Quality:
    """Hold a run's quality figures against their limits.

    Parameters
    ----------
    figures : QualityFigures
    step_change : StepChange, optional
        Largest change of a criterion when the step is halved (`certkit.grading.refinement`); None when
        nobody looked.
    solver_seconds : float, optional
        Processor time, for information.
    front : FrontUse, optional
        How far a vehicle's front went into its rooms and curves; None without a vehicle.

    Returns
    -------
    Quality
        Its verdict is `pass` or `error`. A figure that is not a number is beyond every limit.
    """
    step = figures.time_step / 2
    smaller = Reason.of("take-a-smaller-step", step=step)
    checks = [
        _check("energy-balance", figures.energy_error_percent, ENERGY_LIMIT, "%", smaller),
        _check("joint-gap", figures.joint_gap_mm, JOINT_GAP_LIMIT, "mm", smaller),
        _check(
            "penetration", figures.penetration_mm, PENETRATION_LIMIT, "mm", Reason.of("stiffen-the-contacts")
        ),
    ]
    if figures.flesh_depth_percent:
        depth = figures.flesh_depth_percent
        checks.append(_check("flesh-depth", depth, FLESH_DEPTH_LIMIT, "%", Reason.of("stiffen-the-wall")))
    if front is not None:
        checks += _front_checks(front)
    if step_change is not None:
        most = Reason.of("criterion-changes-most", criterion=step_change.criterion, step=step)
        checks.append(_check("step-change", step_change.percent, STEP_CHANGE_LIMIT, "%", most))
    return Quality(
        verdict="pass" if all(check.verdict == "pass" for check in checks) else "error",
        energy_error_percent=checks[0].value,
        joint_gap_mm=checks[1].value,
        penetration_mm=checks[2].value,
        step_change_percent=None if step_change is None else checks[-1].value,
        steps=figures.steps,
        time_step=figures.time_step,
        solver_seconds=solver_seconds,
        checks=checks,
    )


def _front_checks(front: FrontUse) -> list[QualityCheck]:
    """Hold a front against the room behind its groups, and its springs against their curves."""
    checks = [_check("group-travel", front.travel_mm, TRAVEL_LIMIT, "mm", Reason.of("hold-the-groups"))]
    if front.room is not None:
        remedy = Reason.of("hold-the-group", group=front.room.name)
        checks.append(_check("group-room", front.room.percent, ROOM_LIMIT, "%", remedy))
    if front.springs is not None:
        remedy = Reason.of("extract-further", spring=front.springs.name)
        checks.append(_check("spring-range", front.springs.percent, ROOM_LIMIT, "%", remedy))
    return checks


def _check(code: str, value: float, limit: float, unit: str, remedy: Reason) -> QualityCheck:
    # The document holds no NaN; what is not a number is written down as far out of its limit as can be.
    shown = rounded_residual(value) if math.isfinite(value) else 1e300
    kept = shown <= limit
    return QualityCheck(
        coded_title=Reason.of(code),
        value=shown,
        limit=limit,
        unit=unit,
        verdict="pass" if kept else "error",
        remedy=None if kept else remedy,
    )
