"""Numbers that no part can have are refused where they stand, before anything is computed with them."""

from __future__ import annotations

import pytest

from certkit.bench.setup import prepare
from certkit.errors import DefinitionError

KNEE, FLESH, FEMUR = "legform.knee", "legform.flesh", "legform.parts.femur"


@pytest.mark.parametrize(
    ("procedure", "path", "value", "told"),
    [
        # Friction that drives, flesh that gives back more than it took, springs that push apart.
        ("pendulum", f"{KNEE}.condyles.friction", "-0.3", "this ratio has to be zero or above"),
        ("vehicle", "vehicle.friction", "-0.2", "this ratio has to be zero or above"),
        ("pendulum", f"{FLESH}.resilience", "150 %", "this ratio has to be from 0 to 1"),
        ("pendulum", f"{FLESH}.damping ratio", "-0.5", "this ratio has to be zero or above"),
        ("pendulum", f"{FEMUR}.block joint", "-1.4", "this ratio has to be above zero"),
        ("pendulum", f"{FEMUR}.damping time", "-0.2 ms", "this time has to be zero or above"),
        (
            "vehicle",
            "vehicle.springs.spoiler foam.unloading",
            "0 N/mm",
            "this stiffness has to be above zero",
        ),
        # Things without a size, or turned inside out.
        ("pendulum", f"{FEMUR}.depth", "-90 mm", "this length has to be above zero"),
        ("pendulum", f"{KNEE}.depth", "0 mm", "this length has to be above zero"),
        ("pendulum", f"{FLESH}.thickness", "-30 mm", "this length has to be above zero"),
        ("pendulum", f"{FLESH}.compacted at", "31 mm", "has to be below `thickness`"),
        ("pendulum", f"{KNEE}.condyles.stiffness", "0 N/m", "this stiffness has to be above zero"),
        ("pendulum", f"{KNEE}.condyles.trough radius", "20 mm", "a trough has a larger radius"),
        ("pendulum", "rig.stopper.height", "0 mm", "this length has to be above zero"),
        ("pendulum", "rig.stopper.cover", "-5 mm", "this length has to be zero or above"),
        (
            "vehicle",
            "vehicle.springs.spoiler foam.bottoming.at",
            "-70 mm",
            "this length has to be zero or above",
        ),
        # Tests that do not take place.
        ("vehicle", "rig.free flight.end above ground", "-75 mm", "this length has to be zero or above"),
        ("vehicle", "rig.free flight.speed", "0 km/h", "this speed has to be above zero"),
        ("pendulum", "rig.release.angle", "400 deg", "this angle has to be within 90 deg"),
        ("inverse", "rig.ram.speed", "-11.1 m/s", "this speed has to be above zero"),
        ("pendulum", "run.until", "0 ms", "this time has to be above zero"),
    ],
)
def test_a_number_that_no_part_can_have_is_refused(procedure: str, path: str, value: str, told: str) -> None:
    with pytest.raises(DefinitionError, match=told):
        prepare(procedure, overrides={path: value})


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (f"{KNEE}.condyles.friction", "0"),
        (f"{FLESH}.resilience", "100 %"),
        (f"{FLESH}.tension", "0 N"),
        (f"{FEMUR}.cable angle", "0 rad"),
        (f"{KNEE}.ligaments.MCL.preload", "-500 N"),
        ("rig.hinge.offset", "-20 mm"),
        ("rig.stopper.knee centre below", "-30 mm"),
    ],
)
def test_a_number_at_its_bound_and_a_place_on_the_other_side_are_taken(path: str, value: str) -> None:
    assert prepare("pendulum", overrides={path: value}).procedure.procedure == "pendulum"
