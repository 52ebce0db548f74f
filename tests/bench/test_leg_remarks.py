"""A leg is told of where its cables act or its knee cannot be at rest; the shipped ones are not."""

from __future__ import annotations

import pytest

from certkit import run

MCL = "legform.knee.ligaments.MCL.preload"
COARSE = {f"legform.parts.{bone}.segments": "2" for bone in ("femur", "tibia")}


def codes(overrides: dict[str, str]) -> set[str]:
    result = run("pendulum", overrides={"run.until": "60 ms", **overrides}, refine=False)
    known = {"cables-tight", "knee-bends-at-rest", "knee-slides-at-rest"}
    return {reason.code for reason in result.coded_remarks} & known


@pytest.mark.parametrize(
    ("overrides", "told"),
    [
        ({}, set()),
        # Cables act beyond an angle of one joint: with fewer joints each bends further at the same moment.
        (COARSE, {"cables-tight"}),
        ({**COARSE, **{f"legform.parts.{bone}.cable angle": "1 rad" for bone in ("femur", "tibia")}}, set()),
        ({MCL: "6000 N"}, {"knee-bends-at-rest"}),
        ({"legform.knee.condyles.friction": "0"}, {"knee-slides-at-rest"}),
    ],
    ids=["shipped", "two segments a bone", "two segments, loose cables", "one tight ligament", "smooth knee"],
)
def test_what_the_model_passes_over_is_told(overrides: dict[str, str], told: set[str]) -> None:
    assert codes(overrides) == told


def test_a_slack_ligament_pulls_on_nothing_at_rest() -> None:
    """Below zero its preload is the stretch that it lacks: the blocks rest on the others' pull alone."""
    from certkit.definitions.loading.library import load  # noqa: PLC0415
    from certkit.mechanics.legform.knee import resting_forces  # noqa: PLC0415

    slack, loose = (
        load("legform", "flex-pli-gtr", overrides={MCL.removeprefix("legform."): force}).document.knee
        for force in ("-500 N", "0 N")
    )
    assert resting_forces(slack) == resting_forces(loose)
