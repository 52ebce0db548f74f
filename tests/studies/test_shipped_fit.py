"""The shipped leg is what the shipped fit comes to, and every leg of the shipped family passes."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.definitions.legform_family import Member
from certkit.definitions.loading.library import load
from certkit.definitions.units import split_quantity
from certkit.errors import UsageError
from certkit.studies.calibration.fit import Task, calibrate, make_ready
from certkit.studies.calibration.identifiability import knowledge
from certkit.studies.calibration.parameter_space import axis_of
from certkit.studies.calibration.search import Misfit, downhill
from certkit.studies.points import Outputs
from certkit.studies.runs import Runs
from certkit.studies.trial import Trial

MEMBERS = 40
FAMILY = load("family", "flex-pli-gtr").document


@pytest.fixture(scope="module")
def task() -> Task:
    return make_ready("flex-pli-gtr")


@pytest.fixture(scope="module")
def outputs(task: Task) -> Outputs:
    return task.trial(task.space.point(task.space.start))


def test_every_graded_channel_lies_within_0_3_half_widths_of_its_corridors_middle(
    task: Task, outputs: Outputs
) -> None:
    distances = {goal.name: goal.distance(outputs[goal.name]) for goal in task.goals if goal.graded}
    assert len(distances) == 14
    assert max(map(abs, distances.values())) <= 0.3, distances


def test_no_fitted_number_stands_on_its_bound(task: Task) -> None:
    shares = dict(zip(task.space.names, task.space.start, strict=True))
    assert all(0.05 <= share <= 0.95 for share in shares.values()), shares


def test_what_the_regulation_fixes_is_not_free(task: Task) -> None:
    fixed = ("knee centre below", "tibia face to edge", "mass.mass", "release", "thickness", "length")
    assert not [name for name in task.space.names if name.endswith(fixed)]
    assert not [target for target in task.sheet.targets if target.to == "reference"]


@pytest.fixture(scope="module")
def table_1() -> Task:
    return make_ready("seed-table-1")


def test_table_1_is_predicted_within_four_per_cent_rms_with_only_the_rams_contact_free(table_1: Task) -> None:
    assert all(name.startswith("inverse-seed/rig.ram.") for name in table_1.space.names)
    outputs = table_1.trial(table_1.space.point(table_1.space.start))
    errors = [100 * (float(outputs[goal.name]) / goal.aim - 1) for goal in table_1.goals]
    assert len(errors) == 7
    assert np.sqrt(np.mean(np.square(errors))) <= 4.0
    assert max(map(abs, errors)) <= 7.0


@pytest.mark.slow
def test_each_value_of_table_1_is_predicted_by_the_other_six(table_1: Task) -> None:
    with Runs(table_1.trial) as runs:
        found = calibrate(table_1, runs)
    errors = [100 * (float(found.left_out[goal.name]) / goal.aim - 1) for goal in table_1.goals]
    assert np.sqrt(np.mean(np.square(errors))) <= 8.0


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


def test_the_family_has_many_legs_that_all_differ() -> None:
    assert len(FAMILY.members) >= MEMBERS
    assert len({tuple(member.values.values()) for member in FAMILY.members}) == len(FAMILY.members)


def test_two_members_cannot_have_one_name() -> None:
    twice = {**FAMILY.model_dump(by_alias=True), "members": [FAMILY.members[0].model_dump()] * 2}
    with pytest.raises(ValueError, match="two members are called"):
        type(FAMILY).model_validate(twice)


@pytest.mark.parametrize("member", FAMILY.members, ids=lambda member: member.id)
def test_every_leg_of_the_family_passes_every_graded_channel_with_flesh_left(member: Member) -> None:
    for procedure in ("pendulum", "inverse"):
        outputs = Trial((procedure,), fixed=member.overrides(procedure))({})
        assert outputs[f"{procedure}/verdict"] == "pass"
        assert float(outputs[f"{procedure}/flesh depth %"]) <= 100
