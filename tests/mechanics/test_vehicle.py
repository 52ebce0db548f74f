# ruff: noqa: E501  # a table reads best with one line a case
"""The leg against a front: the springs' law, the contact without steps, the direction of every change."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from certkit.definitions.fixtures.rig_builder import GROUND
from certkit.definitions.loading.library import load
from certkit.definitions.loading.overrides import overrides_from
from certkit.definitions.vehicle import Spring, Vehicle
from certkit.errors import DefinitionError, RunError
from certkit.identification.spring_law import Branch, SpringLaw
from certkit.mechanics import Simulation, simulate
from certkit.mechanics.force_laws.vehicle_spring import VehicleSpring
from certkit.mechanics.rig.front_faces import face_strips
from certkit.mechanics.rig.spring_curve import loading_curve
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import Assembly

SHIPPED = ["generic-saloon", "generic-suv", "generic-sports-car"]


def hit(
    vehicle: str | Path, *changes: str, flight: tuple[str, ...] = (), step: float | None = None
) -> Simulation:
    sheet = load("procedure", "vehicle", overrides=overrides_from(flight)).document
    legform = load("legform", "flex-pli-gtr").document
    return simulate(
        sheet,
        legform,
        vehicle=load("vehicle", vehicle, overrides=overrides_from(changes)).document,
        time_step=step,
    )


def peak(run: Simulation, channel: str) -> float:
    """Return the largest value up to 40 ms: what comes later is the rebound."""
    return float(run.recording[channel].values[: round(0.04 / run.recording.interval)].max())


@pytest.fixture(scope="module")
def saloon() -> Simulation:
    return hit("generic-saloon")


# --- one spring --------------------------------------------------------------------------------------------


def bounce(law: SpringLaw, speed: float, mass: float = 2.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Throw a mass at one spring; return shortening, its rate and the force."""
    assembly = Assembly()
    body = assembly.add_body("mass", mass, 0.0, (0.0, 0.0, 0.0), speed=(speed, 0.0, 0.0), guided=True)
    push = [(x, f) for x, f in zip(law.shortening, law.force, strict=True) if x >= 0]
    pull = (
        [(-x, -f) for x, f in zip(law.shortening, law.force, strict=True) if x <= 0][::-1]
        if law.tension
        else []
    )
    push_start, push_points = assembly.add_curve(push)
    pull_start, pull_points = assembly.add_curve(pull)
    assembly.add(
        VehicleSpring(
            first=body,
            second=GROUND,
            rest=0.0,
            push_start=push_start,
            push_points=push_points,
            pull_start=pull_start,
            pull_points=pull_points,
            unloading=law.branch.stiffness,
            residual=law.branch.residual,
            permanent_set=law.branch.permanent_set,
            damping=law.damping,
        )
    )
    world = assembly.finish()
    wanted = [world.place(VehicleSpring, 0, reading) for reading in ("shortening", "force")]
    run = run_world(world, Plan(step=1e-5, until=0.03, longest=0.03), wanted, [body])
    x, force = run.readings.T
    return x, np.gradient(x, 1e-5), force


LAWS = {
    "hysteretic": SpringLaw((0.0, 0.01, 0.05), (0.0, 3000.0, 5000.0), Branch(8e5, 0.2, 0.1)),
    "permanent set": SpringLaw((0.0, 0.01, 0.05), (0.0, 3000.0, 3500.0), Branch(5e5)),
    "softening": SpringLaw((0.0, 0.004, 0.008, 0.05), (0.0, 3000.0, 1500.0, 4000.0), Branch(9e5, 0.1)),
    "damped": SpringLaw((0.0, 0.05), (0.0, 9000.0), Branch(4e5, 0.3), damping=40.0),
    "pulling": SpringLaw((-0.05, 0.0, 0.05), (-6000.0, 0.0, 9000.0), Branch(6e5, 0.2), tension=True),
    "plastic and pulling": SpringLaw((-0.05, 0.0, 0.01, 0.05), (-6000.0, 0.0, 3000.0, 3300.0), Branch(5e5), tension=True),
}  # fmt: skip


@pytest.mark.parametrize("name", LAWS)
def test_a_spring_follows_the_law_that_extraction_fits(name: str) -> None:
    law = LAWS[name]
    x, v, force = bounce(law, 3.0)
    wanted = law.total_force(x, v)
    assert np.abs(force - wanted)[2:].max() < 2e-3 * np.abs(wanted).max()


def test_a_spring_without_tension_lets_go_and_never_pulls() -> None:
    x, _, force = bounce(LAWS["damped"], 3.0)
    assert x[-1] < 0
    assert force.min() >= 0
    assert force[-1] == 0


def test_a_hysteretic_spring_gives_back_only_the_area_under_its_branch() -> None:
    law = LAWS["permanent set"]
    x, v, _ = bounce(law, 3.0)
    peak_force = float(np.interp(x.max(), law.shortening, law.force))
    given_back = 0.5 * peak_force**2 / law.branch.stiffness
    assert 0.5 * 2.0 * v[-10] ** 2 == pytest.approx(given_back, rel=0.01)


def spring(**given: object) -> Spring:
    data = {
        "between": ["a", "ground"],
        "loading": [["0 mm", "0 N"], ["10 mm", "1000 N"]],
        "origin": {"source": "test", "confidence": "estimated"},
    }
    return Spring.model_validate({**data, **given})


def test_a_gap_is_free_travel() -> None:
    push, pull = loading_curve(spring(gap="5 mm"))
    assert np.allclose(push, [(0.0, 0.0), (0.005, 0.0), (0.015, 1000.0)])
    assert pull == []


def test_bottoming_stiffens_a_spring_beyond_its_travel() -> None:
    push, _ = loading_curve(spring(bottoming={"at": "20 mm", "stiffness": "500 N/mm"}))
    x, f = np.array(push).T
    assert np.interp(0.02, x, f) == pytest.approx(2000.0)
    assert np.interp(0.022, x, f) == pytest.approx(2200.0 + 1000.0)


def test_a_spring_that_also_pulls_does_so_as_it_pushes_unless_told_otherwise() -> None:
    push, pull = loading_curve(spring(tension=True))
    assert push == pull
    _, own = loading_curve(
        spring(tension=True, loading=[["-10 mm", "-300 N"], ["0 mm", "0 N"], ["10 mm", "1000 N"]])
    )
    assert np.allclose(own, [(0.0, 0.0), (0.01, 300.0)])


# --- the faces ---------------------------------------------------------------------------------------------


def front(**changes: object) -> Vehicle:
    lower = {"kind": "fascia", "mass": "1 kg", "position": "0 mm", "low": "400 mm", "high": "500 mm"}
    data = {
        "vehicle": "two",
        "title": "two groups",
        "origin": {"source": "test", "confidence": "estimated"},
        "groups": {
            "A": lower,
            "B": {**lower, "low": "500 mm", "high": "600 mm", "position": "10 mm", **changes},
        },
        "springs": {
            f"behind {name}": {
                "between": [name, "ground"],
                "loading": [["0 mm", "0 N"], ["100 mm", "8000 N"]],
            }
            for name in "AB"
        },
    }
    return Vehicle.model_validate(data)


def test_neighbouring_faces_share_the_height_between_their_middles() -> None:
    strips = face_strips(front(), 0.0)
    shares = {round(s.z, 3): s.share for s in strips if s.lower == "A" and s.upper == "B"}
    heights = sorted(shares)
    assert heights[0] >= 0.45
    assert heights[-1] <= 0.55
    steps = np.diff([shares[z] for z in heights])
    assert np.all(steps > 0)
    assert steps.max() < 0.1


def test_faces_of_different_kinds_or_with_a_gap_between_them_stay_apart() -> None:
    for changes in ({"kind": "hood"}, {"low": "520 mm"}):
        assert all(s.lower == s.upper for s in face_strips(front(**changes), 0.0))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("low: 200 mm, high: 270 mm, ", "low: 200 mm, ", "a face has low, high and position"),
        ("low: 200 mm, high: 270 mm", "low: 270 mm, high: 200 mm", "`high` is not above `low`"),
        ("[22 mm, 1540 N], [80 mm, 2961 N]", "[80 mm, 2961 N], [22 mm, 1540 N]", "shortenings have to rise"),
        ("[22 mm, 1540 N]", "[22 mm, -1540 N]", "pulls where it is pressed"),
        ("[22 mm, 1540 N]", "[22 mm, 1540]", "has no unit"),
        ("residual: 0.2, damping: 60 N·s/m, bottoming: {at: 70 mm", "residual: 1.2, damping: 60 N·s/m, bottoming: {at: 70 mm", "between 0 and 1"),
        ("damping: 60 N·s/m", "damping: -60 N·s/m", "is negative"),
        ("mass: 0.3 kg, low: 200 mm", "mass: 0 kg, low: 200 mm", "greater than zero"),
        ("between: [F1, E1]", "between: [F1, E9]", "no group `E9`"),
        ("  latch support mount: {between: [E5, ground]", "  latch support mount: {between: [E5, E5]", "both ends are `E5`"),
        ("friction: 0.2", "friktion: 0.2", "friktion"),
        ("  E4: {kind: engine room, mass: 2.0 kg}", "  E4: {kind: engine room, mass: 2.0 kg}\n  E9: {kind: engine room, mass: 2.0 kg}", "nothing holds `E9`"),
    ],
)  # fmt: skip
def test_a_damaged_vehicle_file_is_refused_with_its_place(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    path = tmp_path / "car.yaml"
    text = load("vehicle", "generic-saloon").text
    assert old in text
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(DefinitionError, match=message) as caught:
        load("vehicle", path)
    assert ":" in str(caught.value).split("car.yaml", 1)[1][:2]


def test_a_leg_that_flies_past_is_an_error() -> None:
    with pytest.raises(RunError, match="flies past the front"):
        hit("generic-saloon", flight=("rig.free flight.end above ground=1500 mm",))


def test_the_forces_on_the_faces_add_up_to_the_contact_force(saloon: Simulation) -> None:
    assert saloon.front is not None
    faces = saloon.front.contact
    total = sum(np.array(series.values) for series in faces.series.values())
    every = round(faces.interval / saloon.recording.interval)
    whole = saloon.recording["contact force"].values[::every]
    assert np.abs(total - whole).max() < 1e-6 * total.max()


def test_the_front_takes_the_momentum_that_the_leg_loses(saloon: Simulation) -> None:
    impulse = saloon.recording["contact force"].values.sum() * saloon.recording.interval
    leg = 13.2 * 40 / 3.6
    assert 1.0 * leg < impulse < 1.6 * leg  # stopped, and thrown back by less than it came with


# --- the shipped fronts ------------------------------------------------------------------------------------


@pytest.mark.parametrize("vehicle", SHIPPED)
def test_energy_and_step_of_a_shipped_front_are_far_inside_their_limits(vehicle: str) -> None:
    run, half = hit(vehicle), hit(vehicle, step=1e-5)
    assert run.quality.energy_error_percent < 0.3
    assert run.quality.flesh_depth_percent < 100
    assert run.quality.joint_gap_mm < 0.02
    for channel in ("T1", "T2", "T3", "T4", "MCL", "ACL", "PCL"):
        assert peak(half, channel) == pytest.approx(peak(run, channel), rel=0.005)


@pytest.mark.parametrize("vehicle", SHIPPED)
def test_a_shipped_front_is_plausible(vehicle: str) -> None:
    run = hit(vehicle)
    tibia = max(peak(run, c) for c in ("T1", "T2", "T3", "T4"))
    assert 150 < tibia < 350
    assert 0.010 < peak(run, "MCL") < 0.025
    assert len(load("vehicle", vehicle).document.groups) == 14


@pytest.mark.parametrize(
    "flight", ["end above ground=25 mm", "end above ground=200 mm", "speed=15 m/s", "angle=8 deg"]
)
@pytest.mark.parametrize("vehicle", SHIPPED)
def test_high_low_fast_and_oblique_hits_keep_their_energy(vehicle: str, flight: str) -> None:
    assert hit(vehicle, flight=(f"rig.free flight.{flight}",)).quality.energy_error_percent < 0.5


def test_a_late_second_contact_with_a_group_far_behind_keeps_its_energy() -> None:
    run = hit("generic-saloon", "groups.H1.position=200 mm", "groups.F1.position=120 mm")
    assert run.front is not None
    assert max(run.front.contact.series["H1"].values) > 0
    assert run.quality.energy_error_percent < 0.1


# --- directions: three-point bending of the leg between lower stiffener, bumper and hood --------------------


def test_a_leg_with_an_edge_at_its_knee_keeps_its_energy_along_faces_that_fold() -> None:
    assert hit("fe-front").quality.energy_error_percent < 0.15


def scaled(vehicle: str, spring: str, factor: float) -> str:
    points = load("vehicle", vehicle).document.springs[spring].loading
    text = ", ".join(f"[{1e3 * x:g} mm, {factor * f:g} N]" for x, f in points)
    return f"springs.{spring}.loading=[{text}]"


STIFFENER, BUMPER = "spoiler foam", "middle foam"


@pytest.mark.parametrize("vehicle", SHIPPED)
def test_the_stiffer_the_bumper_in_the_middle_the_more_the_leg_bends_over_it(vehicle: str) -> None:
    # The bumper is the middle support, the spoiler and the hood are the outer ones: what the middle one takes
    # over bends tibia and knee.
    soft, own, stiff = (hit(vehicle, scaled(vehicle, BUMPER, f)) for f in (0.5, 1.0, 2.0))
    for channel in ("T1", "MCL"):
        assert peak(soft, channel) < peak(own, channel) < peak(stiff, channel)


@pytest.mark.parametrize("vehicle", SHIPPED)
def test_the_stiffer_the_spoiler_the_less_the_leg_bends_over_the_bumper(vehicle: str) -> None:
    # The outer support takes load off the middle one and turns the tibia with the femur.
    soft, own, stiff = (hit(vehicle, scaled(vehicle, STIFFENER, f)) for f in (0.5, 1.0, 2.0))
    assert peak(soft, "T1") > peak(own, "T1") > peak(stiff, "T1")
    assert max(peak(soft, "MCL"), peak(own, "MCL")) > peak(stiff, "MCL")


@pytest.mark.parametrize("vehicle", SHIPPED)
def test_the_higher_the_front_the_more_the_upper_tibia_is_bent(vehicle: str) -> None:
    # Raised by 50 mm, the lower support moves up the tibia less than the bumper's force moves towards the
    # knee:
    # more of the leg's mass hangs below the supports and the bending arm at T1 grows; lowered, it shrinks.
    up, own, down = (
        hit(vehicle, flight=(f"rig.free flight.end above ground={z} mm",)) for z in (25, 75, 125)
    )
    assert peak(up, "T1") > peak(own, "T1") > peak(down, "T1")
