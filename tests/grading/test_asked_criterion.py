"""What a criterion asks can be told without measuring: the same limits and units as the graded one has."""

from __future__ import annotations

import pytest

from certkit.bench.setup import prepare
from certkit.grading import grade_criteria, measure_all
from certkit.grading.asked_criterion import asked_criterion
from certkit.mechanics import simulate


@pytest.mark.parametrize("procedure", ["inverse", "static-knee"])
def test_a_criterion_asks_for_the_limits_that_it_is_graded_by(procedure: str) -> None:
    setup = prepare(procedure)
    channels = setup.legform.channel_table
    recording = simulate(setup.procedure, setup.legform, vehicle=setup.vehicle).recording
    graded = grade_criteria(measure_all(setup.procedure, recording), setup.corridors)
    asked = [asked_criterion(c, setup.corridors, channels) for c in setup.procedure.criteria]
    assert [(c.id, c.title, c.channel, c.unit, c.graded) for c in asked] == [
        (c.id, c.title, c.channel, c.unit, c.graded) for c in graded
    ]
    assert [(c.lower, c.upper) for c in asked] == [(c.lower, c.upper) for c in graded]
