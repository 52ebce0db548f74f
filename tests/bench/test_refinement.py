"""What a reported run says of its own numerical error is what finer runs show."""

from __future__ import annotations

import pytest

from certkit.bench.run_simulation import run
from certkit.bench.setup import prepare
from certkit.grading import criterion_values, measure_all, numerical_uncertainties
from certkit.mechanics import simulate


def test_the_numerical_uncertainty_is_that_of_half_the_step_and_of_twice_the_iterations() -> None:
    setup = prepare("inverse")
    done = simulate(setup.procedure, setup.legform)
    half = simulate(setup.procedure, setup.legform, time_step=0.5 * done.quality.time_step)
    patient = simulate(setup.procedure, setup.legform, iterations=2 * done.quality.iterations)
    values, halved, iterated = (
        criterion_values(measure_all(setup.procedure, each.recording)) for each in (done, half, patient)
    )
    by_step = numerical_uncertainties(values, halved)
    said = {c.id: c.uncertainty.numerical for c in run("inverse").criteria if c.uncertainty is not None}
    assert said.keys() == by_step.keys()
    for name, uncertainty in by_step.items():
        value, other = values[name], iterated[name]
        assert value is not None
        assert other is not None
        assert uncertainty > 0
        assert said[name] == pytest.approx(uncertainty + abs(other - value), rel=1e-3)
