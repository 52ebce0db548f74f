"""The lumped leg of the finite-element leg follows that leg's own tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from certkit.definitions.loading.library import load
from certkit.studies.calibration.fit import Task, make_ready
from certkit.studies.points import Outputs

FIT = Path(__file__).parents[2] / "examples" / "calibrate" / "fe-leg" / "fit.yaml"
JUDGED = ("T1", "T2", "T3", "T4", "F1", "F2", "F3", "MCL")


@pytest.fixture(scope="module")
def task() -> Task:
    return make_ready(FIT)


@pytest.fixture(scope="module")
def outputs(task: Task) -> Outputs:
    return task.trial(task.space.point(task.space.start))


@pytest.mark.parametrize("procedure", ["fe-pendulum", "fe-inverse"])
@pytest.mark.parametrize("channel", JUDGED)
def test_a_history_is_followed_within_six_per_cent_and_its_peak_within_five(
    outputs: Outputs, procedure: str, channel: str
) -> None:
    assert outputs[f"{procedure}/{channel} over time rms %"] <= 6
    assert abs(outputs[f"{procedure}/{channel} over time peak error %"]) <= 5


def test_static_curves_are_followed_within_six_per_cent(task: Task, outputs: Outputs) -> None:
    static = [curve.name for curve in task.trial.curves if curve.abscissa]
    assert len(static) == 5
    for name in static:
        assert outputs[f"{name} rms %"] <= 6
        assert abs(outputs[f"{name} peak error %"]) <= 5


def test_the_runs_can_be_trusted(task: Task, outputs: Outputs) -> None:
    for procedure in task.trial.procedures:
        assert outputs[f"{procedure}/verdict"] == "not evaluated"
        assert outputs[f"{procedure}/energy error %"] < 0.1


def test_the_rigs_are_as_the_recordings_say_and_nothing_of_them_is_free(task: Task) -> None:
    assert all(parameter.path.startswith("legform.") for parameter in task.sheet.parameters)


def test_no_number_of_the_fitted_leg_stands_on_a_bound(task: Task) -> None:
    for axis in task.space.axes:
        assert 0.03 < axis.share(axis.start) < 0.97, axis.name


def test_what_was_fitted_says_so_and_keeps_near_to_what_the_finite_element_leg_has() -> None:
    leg = load("legform", "fe-leg").document
    assert leg.parts["femur"].bending_stiffness.confidence == "calibrated"
    assert "fit fe-leg" in leg.parts["femur"].bending_stiffness.source
    assert leg.parts["femur"].bending_stiffness == pytest.approx(182, rel=0.03)
    assert leg.parts["tibia"].bending_stiffness == pytest.approx(172, rel=0.03)
    assert leg.knee.parallel_stiffness == pytest.approx(128, rel=0.1)
