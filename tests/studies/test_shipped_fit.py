"""The shipped leg is what the shipped fit comes to, and every leg of the shipped family passes."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.errors import UsageError
from certkit.studies.calibration.fit import Task, make_ready
from certkit.studies.calibration.identifiability import knowledge
from certkit.studies.calibration.leg_family import passes
from certkit.studies.calibration.parameter_space import axis_of
from certkit.studies.calibration.search import Misfit, downhill
from certkit.studies.points import Outcome, Outputs
from certkit.studies.quantity import split_quantity
from certkit.studies.runs import Runs
from certkit.studies.trial import Trial

FAMILY = load("family", "flex-pli-gtr").document


@pytest.fixture(scope="module")
def task() -> Task:
    return make_ready("flex-pli-gtr")


@pytest.fixture(scope="module")
def outputs(task: Task) -> Outputs:
    return task.trial(task.space.point(task.space.start))


def test_every_graded_channel_lies_in_the_middle_sixty_per_cent_of_its_corridor(
    task: Task, outputs: Outputs
) -> None:
    distances = {goal.name: goal.distance(outputs[goal.name]) for goal in task.goals if goal.graded}
    assert len(distances) == 14
    assert max(map(abs, distances.values())) <= 0.6, distances


def test_table_1_is_met_within_four_per_cent_rms_and_seven_per_cent_each(
    task: Task, outputs: Outputs
) -> None:
    errors = [100 * (float(outputs[g.name]) / g.aim - 1) for g in task.goals if not g.graded]
    assert len(errors) == 7
    assert np.sqrt(np.mean(np.square(errors))) <= 4.0
    assert max(map(abs, errors)) <= 7.0


def test_the_fit_gives_a_reason_for_all_bounds_and_the_leg_lies_within(task: Task) -> None:
    assert [parameter.path for parameter in task.sheet.parameters if len(parameter.reason.split()) < 3] == []
    for parameter in task.sheet.parameters:
        with pytest.raises(UsageError, match="outside its bounds"):
            axis_of(parameter, {parameter.name: f"1e9 {split_quantity(parameter.lower)[1]}"})


@pytest.mark.slow
def test_the_fit_started_at_the_shipped_leg_stays_there_within_its_uncertainty(task: Task) -> None:
    with Runs(task.trial) as runs:
        misfit = Misfit(runs, task.space, task.goals, task.sheet.search.pull)
        start = np.clip(task.space.start, 0, 1)
        slopes = misfit.jacobian(start)[: len(task.goals)]
        spread = np.sqrt(np.diag(knowledge(task.space, start, slopes).covariance))
        end = downhill(misfit, start, 3, lambda _: None)
    assert np.abs((end - start) / spread).max() < 0.25


def test_the_family_has_at_least_twenty_legs_that_all_differ() -> None:
    assert len(FAMILY.members) >= 20
    assert len({tuple(member.values.values()) for member in FAMILY.members}) == len(FAMILY.members)


def test_two_members_cannot_have_one_name() -> None:
    twice = {**FAMILY.model_dump(by_alias=True), "members": [FAMILY.members[0].model_dump()] * 2}
    with pytest.raises(ValueError, match="two members are called"):
        type(FAMILY).model_validate(twice)


@pytest.mark.parametrize("member", FAMILY.members, ids=lambda member: member.id)
def test_every_leg_of_the_family_passes_every_graded_channel(member: object) -> None:
    own = {f"legform.{path}": value for path, value in member.values.items()}
    procedures = ("pendulum", "inverse")
    outputs = Trial(procedures, fixed=own)({})
    assert passes(Outcome(outputs), procedures)
    assert {outputs["pendulum/verdict"], outputs["inverse/verdict"]} == {"pass"}
