"""A leg is told of where its cables act or its knee cannot be at rest; the shipped ones are not."""

from __future__ import annotations

import pytest

from certkit import run
from certkit.bench.leg_remarks import flesh_pressed_twice
from certkit.bench.setup import prepare

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


@pytest.mark.parametrize(
    ("procedure", "overrides", "told"),
    [
        ("pendulum", {}, []),
        ("inverse", {}, []),
        ("vehicle", {}, []),
        (
            "pendulum",
            {"rig.release.angle": "20 deg", "rig.added mass.mass": "5.5 kg"},
            ["release angle", "added mass"],
        ),
        ("inverse", {"rig.ram.speed": "12 m/s"}, ["speed"]),
        ("vehicle", {"specimen.flesh": "off"}, ["legform mass"]),
        ("vehicle", {"rig.free flight.angle": "5 deg"}, ["pitch"]),
    ],
)
def test_a_model_that_no_such_test_would_be_made_with_says_so(
    procedure: str, overrides: dict[str, str], told: list[str]
) -> None:
    result = run(procedure, overrides={"run.until": "60 ms", **overrides}, refine=False)
    outside = [r for r in result.coded_remarks if r.code == "model-outside-condition"]
    assert sorted(str(reason.parameters["quantity"]) for reason in outside) == sorted(told)


def test_a_leg_that_falls_through_the_ground_says_when() -> None:
    """So slow that the front hardly holds it, it falls by g·t²/2: 5 mm in 32 ms, 17.7 mm in 60 ms."""
    flight = {"end above ground": "5 mm", "speed": "0.2 m/s"}
    overrides = {"run.until": "60 ms", **{f"rig.free flight.{key}": value for key, value in flight.items()}}
    result = run("vehicle", overrides=overrides, refine=False)
    (reason,) = (r for r in result.coded_remarks if r.code == "leg-below-ground")
    assert reason.parameters["time"] == pytest.approx(32.0, abs=1.5)
    assert reason.parameters["depth"] == pytest.approx(12.7, rel=0.1)


def test_a_slack_ligament_pulls_on_nothing_at_rest() -> None:
    """Below zero its preload is the stretch that it lacks: the blocks rest on the others' pull alone."""
    from certkit.definitions.loading.library import load  # noqa: PLC0415
    from certkit.mechanics.legform.knee import resting_forces  # noqa: PLC0415

    slack, loose = (
        load("legform", "flex-pli-gtr", overrides={MCL.removeprefix("legform."): force}).document.knee
        for force in ("-500 N", "0 N")
    )
    assert resting_forces(slack) == resting_forces(loose)


def test_two_flat_faces_at_one_height_press_on_one_layer_of_flesh_and_are_told() -> None:
    told = {"vehicle.groups.F4.low": "400 mm"}
    overlapping, apart = (prepare("vehicle", overrides=each).vehicle for each in (told, {}))
    assert overlapping is not None
    assert apart is not None
    (remark,) = flesh_pressed_twice(overlapping)
    assert (remark.code, remark.parameters["shared"]) == ("faces-at-one-height", pytest.approx(55.0))
    assert flesh_pressed_twice(apart) == []
    result = run("vehicle", overrides={"run.until": "5 ms", **told}, refine=False)
    assert remark.code in {each.code for each in result.coded_remarks}
