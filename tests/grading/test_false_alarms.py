"""Good recordings raise no doubt: noise, offsets, hum, filters, rates and digits as in laboratories."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

import certkit
from certkit.bench.setup import prepare
from certkit.definitions.channels import MOMENT
from certkit.grading import measure_all
from certkit.signals import Recording
from tests.support.laboratory_records import CASES, CONDITIONS, as_measured, leg_channels

MEASURED = Path(__file__).parents[2] / "examples/measured"


@pytest.mark.parametrize(
    "case", range(len(CASES)), ids=lambda case: "-".join(map(str, CASES[case][1].values()))
)
def test_no_doubt_is_cast_on_forty_good_recordings(case: int):
    name, changes = CASES[case]
    sheet = prepare(name, overrides=changes).procedure
    made = leg_channels(case)
    graded = {criterion.id for criterion in sheet.criteria if criterion.corridor is not None}
    for seed in range(40):
        measured = measure_all(sheet, as_measured(made, 1000 * case + seed))
        said = {n: v.doubt or v.reason for n, v in measured.values.items() if n in graded}
        assert {n: str(reason) for n, reason in said.items() if reason is not None} == {}, seed
        assert measured.remarks == (), seed


@pytest.mark.parametrize("late", [0.0045, 0.002, -0.0045])
@pytest.mark.parametrize("case", range(len(CASES)))
def test_no_doubt_is_cast_where_the_trigger_comes_a_little_late_or_early(case: int, late: float):
    sheet = prepare(CASES[case][0], overrides=CASES[case][1]).procedure
    made = leg_channels(case)
    for seed in range(5):
        good = as_measured(made, seed)
        recorded = replace(good, time=good.time - round(late / good.interval) * good.interval)
        measured = measure_all(sheet, recorded)
        said = {c.id: measured.values[c.id].doubt for c in sheet.criteria if c.corridor is not None}
        assert {n: str(reason) for n, reason in said.items() if reason is not None} == {}, seed


def test_a_simulation_that_is_said_to_be_measured_is_remarked_on():
    """Its rest is filled in, without a digit of noise."""
    sheet = prepare("pendulum").procedure
    made = leg_channels(0)
    step = made.interval
    time = step * np.arange(-2000, made.time.size)
    channels = {
        name: replace(each, values=np.concatenate([np.full(2000, each.values[0]), each.values]))
        for name, each in made.channels.items()
    }
    said = Recording("measured", time, channels, conditions=CONDITIONS, table=made.table, source="made up")
    assert [remark.code for remark in measure_all(sheet, said).remarks] == ["silent-at-rest"]


@pytest.mark.parametrize("case", [2, 3, 4])
@pytest.mark.parametrize("phase", [0.0, 2.0, 4.0])
def test_no_doubt_is_cast_on_a_leg_that_swings_in_flight(case: int, phase: float):
    sheet = prepare(CASES[case][0], overrides=CASES[case][1]).procedure
    for seed in range(5):
        good = as_measured(leg_channels(case), seed)
        swing = np.cos(2 * np.pi * 30.0 * good.time + phase) * np.exp(-np.maximum(good.time, 0.0) / 0.01)
        channels = {
            name: replace(each, values=each.values + (8.0 * swing if each.dimension == MOMENT else 0.0))
            for name, each in good.channels.items()
        }
        measured = measure_all(sheet, replace(good, channels=channels))
        said = {c.id: measured.values[c.id].doubt for c in sheet.criteria if c.corridor is not None}
        assert {n: str(reason) for n, reason in said.items() if reason is not None} == {}, seed


@pytest.mark.parametrize("data", ["FLX-0007-pendulum.zip", "FLX-0007-pendulum.csv"])
def test_no_doubt_is_cast_on_the_shipped_measured_test(data: str):
    mapping = MEASURED / "mapping.yaml" if data.endswith("csv") else None
    result = certkit.grade("pendulum", MEASURED / data, mapping=mapping)
    assert result.verdict == "pass"


@pytest.mark.parametrize("procedure", ["pendulum", "inverse"])
def test_no_doubt_is_cast_on_a_simulated_test(procedure: str):
    result = certkit.run(procedure, refine=False)
    assert {c.id: c.verdict for c in result.criteria if c.graded and c.verdict != "pass"} == {}


def test_no_doubt_is_cast_on_a_simulated_blow_of_the_bonnets_leading_edge():
    """Ligaments are stretched in other proportions there than by a bumper; units are those of the solver."""
    high = {"rig.free flight.end above ground": "380 mm"}
    result = certkit.run("vehicle", overrides=high, refine=False)
    assert {c.id: c.reason for c in result.criteria if c.graded and c.verdict == "not evaluated"} == {}
