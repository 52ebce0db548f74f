"""A legform is data: a made-up one runs, is exported to ISO-MME, read again and graded, by YAML alone."""

from __future__ import annotations

from pathlib import Path

import pytest

import certkit
from certkit.bench.sources import load_source
from certkit.definitions.loading.library import load

LIBRARY = Path(__file__).parents[1] / "data" / "made-up-legform"
PROCEDURES = ["tall-inverse", "tall-pendulum", "tall-vehicle"]


@pytest.fixture(scope="module", params=PROCEDURES)
def result(request: pytest.FixtureRequest) -> certkit.Result:
    return certkit.run(request.param, library=LIBRARY, refine=False)


def test_its_chain_has_an_upper_body_of_seven_segments_above_the_femur():
    leg = load("legform", "tall-leg", library=LIBRARY).document
    assert leg.chain == ("torso", "pelvis", "femur", "knee", "tibia")
    assert leg.parts["torso"].segments + leg.parts["pelvis"].segments == 7


def test_every_gauge_of_it_is_recorded_and_its_corridors_hold(result: certkit.Result):
    wanted = {"P1", "F1", "T1", "T2", "T3", "T4", "T5", "inner", "cross", "knee pull", "contact force"}
    assert wanted <= set(result.channels.series)
    # Its heavy upper body still bends it when the pendulum's record ends, so that no peak is known there.
    verdict = "not evaluated" if result.procedure == "tall-pendulum" else "pass"
    assert {c.id: c.verdict for c in result.criteria if c.graded} == {"T5": verdict, "inner": verdict}
    assert result.quality.energy_error_percent < 0.5


def test_exported_to_iso_mme_it_is_recognised_by_its_fine_location_and_graded_alike(
    result: certkit.Result, tmp_path: Path
):
    archive = tmp_path / "test.zip"
    certkit.export(result, archive, library=LIBRARY)
    read = load_source(archive, library=LIBRARY).recording
    assert read.table.impactor == "XL-1"
    assert set(read.channels) == set(result.channels.series)
    again = certkit.grade(result.procedure, archive, library=LIBRARY)
    for criterion in result.criteria:
        assert again.criteria[criterion.id].value == pytest.approx(criterion.value, rel=1e-6)
        assert again.criteria[criterion.id].verdict == criterion.verdict


def test_corridors_of_another_impactor_hold_nothing_for_it():
    change = {"criteria.T1.corridor": "r127-inverse/T1"}
    result = certkit.run("tall-inverse", library=LIBRARY, overrides=change, refine=False)
    assert result.criteria["T1"].verdict == "not evaluated"
