"""What each force law does, seen on two bodies at a time."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.definitions.fixtures.rig_builder import GROUND
from certkit.mechanics.force_laws import LAWS
from certkit.mechanics.force_laws.condyle_contact import CondyleContact
from certkit.mechanics.force_laws.flesh_compression import FleshCompression
from certkit.mechanics.force_laws.flesh_suspension import FleshSuspension
from certkit.mechanics.force_laws.honeycomb import Honeycomb
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.law import ForceLaw, OutlinePiece
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.mechanics.force_laws.loading_ram_force import LoadingRamForce
from certkit.mechanics.force_laws.ram_nose_contact import RamNoseContact
from certkit.mechanics.force_laws.sliding_guide import SlidingGuide
from certkit.mechanics.force_laws.support_roller import SupportRoller
from certkit.mechanics.records import WORD, Record, record_type
from certkit.mechanics.solver.time_loop import Plan, Trajectory, run_world
from certkit.mechanics.solver.world import Assembly

STEP = 1e-5


def balance(run: Trajectory) -> np.ndarray:
    return run.kinetic + run.stored.sum(axis=1) + run.dissipated.sum(axis=1)


def condyle_on_trough(friction: float, slope: float) -> Trajectory:
    """Let a block stand on two condyles in fixed troughs, pulled aside by `slope` times its weight."""
    assembly = Assembly(gravity=(9.81 * slope, -9.81))
    upper = assembly.add_body("block", 2.0, 0.004, (0.0, 0.047, 0.0), damping=35.0)
    lower = assembly.add_body("base", 1.0, 0.01, (0.0, -0.045, 0.0))
    assembly.add_pivot(lower, GROUND, -0.05, -0.045)
    assembly.add_pivot(lower, GROUND, 0.05, -0.045)
    for x in (-0.04, 0.04):
        assembly.add(
            CondyleContact(
                upper=upper,
                lower=lower,
                condyle_x=x,
                condyle_z=0.02 - 0.047,
                trough_x=x,
                trough_z=0.06 + 0.045,
                clearance=0.04,
                radius=0.02,
                stiffness=1e6,
                damping=100.0,
                friction=friction,
                tangential_stiffness=5e5,
            )
        )
    return run_world(assembly.finish(), Plan(STEP, 1.0, 1.0, sample=100), tracked=[upper])


def test_friction_holds_a_load_at_rest_without_creep():
    x = condyle_on_trough(friction=0.3, slope=0.15).tracks[:, 0, 0]
    assert abs(x[-1]) < 1e-4
    assert abs(x[-1] - x[len(x) // 2]) < 1e-9


def test_beyond_friction_the_condyle_slides_up_its_trough_until_both_balance():
    run = condyle_on_trough(friction=0.1, slope=0.3)
    # At rest the pull leans from the contact's normal by the angle of friction.
    slope = np.arcsin(run.tracks[-1, 0, 0] / 0.04)
    assert slope == pytest.approx(np.arctan(0.3) - np.arctan(0.1), abs=1e-3)
    assert run.dissipated[-1].sum() > 0
    assert np.abs(balance(run) - balance(run)[0]).max() < 1e-3 * run.dissipated[-1].sum()


def test_a_cable_pulls_and_never_pushes():
    assembly = Assembly()
    ends = [assembly.add_body(f"end {i}", 1.0, 0.0, (0.1 * i, 0.0, 0.0)) for i in range(2)]
    assembly.add(
        LigamentCable(upper=ends[0], lower=ends[1], length=0.1, stiffness=1e4, preload=100.0, damping=5.0)
    )
    world = assembly.finish()
    run = run_world(
        world, Plan(STEP, 0.2, 0.2), [world.place(LigamentCable, 0, n) for n in ("elongation", "tension")]
    )
    elongation, tension = run.readings.T
    assert np.all(tension >= 0)
    assert np.all(tension[elongation < -0.0101] == 0)
    assert tension[0] == pytest.approx(100.0, rel=1e-3)
    assert np.abs(balance(run) - balance(run)[0]).max() < 1e-3 * balance(run)[0]


def bar_against(
    law: type[ForceLaw], numbers: dict[str, float], speed: float, until: float
) -> tuple[Trajectory, Assembly]:
    """Let a bar of 2 kg fly with `speed` against a fixed face of one law, 20 strips of 4 mm."""
    assembly = Assembly()
    bar = assembly.add_body("bar", 2.0, 0.03, (-0.001, 0.0, 0.0), speed=(speed, 0.0, 0.0))
    assembly.add_outline(OutlinePiece(bar, 0.2, -0.2, 0.0, 0.05))
    for i in range(20):
        assembly.add(law(carrier=GROUND, face_x=0.0, face_z=0.038 - 0.004 * i, height=0.004, **numbers))
    world = assembly.finish()
    force = [world.place(law, i, "force") for i in range(20)]
    return run_world(world, Plan(STEP, until, until), force, [bar]), assembly


FLESH = {
    "compression": 1e6,
    "layer": 0.03,
    "compacted_at": 0.027,
    "wall": 2e9,
    "loss": 0.0,
    "reversal": 1.0,
    "thickness": 0.0,
}


def test_flesh_without_loss_gives_back_what_it_takes_and_stiffens():
    run, _ = bar_against(FleshCompression, FLESH, 3.0, 0.05)
    deepest = run.tracks[:, 0, 0].max()
    k = 1e6 * 0.08
    assert (
        pytest.approx(k * deepest**2 * (0.5 + 0.25 * (deepest / 0.03) ** 2), rel=1e-3) == 0.5 * 2.0 * 3.0**2
    )
    assert run.readings.sum(axis=1).max() == pytest.approx(
        k * deepest * (1 + (deepest / 0.03) ** 2), rel=1e-3
    )
    assert (run.tracks[-1, 0, 0] - run.tracks[-2, 0, 0]) / STEP == pytest.approx(-3.0, rel=1e-4)


def test_flesh_ends_at_the_bone():
    run, _ = bar_against(FleshCompression, FLESH, 12.0, 0.05)
    assert 0.027 < run.tracks[:, 0, 0].max() < 0.030
    assert run.flesh_depth == pytest.approx(run.tracks[:, 0, 0].max() / 0.03, rel=1e-3)
    assert (run.tracks[-1, 0, 0] - run.tracks[-2, 0, 0]) / STEP == pytest.approx(-12.0, rel=1e-3)


def test_internal_friction_of_flesh_is_full_above_its_reversal_speed():
    """A slow blow loses the share of a fast one only where friction turns at a far lower speed still."""
    kept = {}
    for reversal in (0.01, 1.0, 100.0):
        run, _ = bar_against(FleshCompression, FLESH | {"loss": 1 / 3, "reversal": reversal}, 1.0, 0.1)
        kept[reversal] = ((run.tracks[-1, 0, 0] - run.tracks[-2, 0, 0]) / STEP) ** 2
    assert kept[0.01] == pytest.approx(0.5, rel=0.01)
    assert kept[0.01] < kept[1.0] < kept[100.0]
    assert kept[100.0] > 0.98


@pytest.mark.parametrize("resilience", [0.3, 0.5, 0.8])
def test_flesh_gives_back_the_share_of_its_work_that_is_its_resilience(resilience: float):
    lossy = FLESH | {"loss": (1 - resilience) / (1 + resilience)}
    run, _ = bar_against(FleshCompression, lossy, 10.0, 0.05)
    back = (run.tracks[-1, 0, 0] - run.tracks[-2, 0, 0]) / STEP
    # At the turning point friction is not yet full: a little less is lost.
    assert (back / 10.0) ** 2 == pytest.approx(resilience, rel=0.03)
    assert (back / 10.0) ** 2 > resilience
    lost = 0.5 * 2.0 * (10.0**2 - back**2)
    assert run.dissipated[-1].sum() == pytest.approx(lost, rel=1e-3)


@pytest.mark.parametrize("tilt", [0.3, 0.9])
def test_flesh_on_a_tilted_leg_keeps_the_energy_that_it_does_not_lose(tilt: float):
    assembly = Assembly()
    place = (-0.01 - 0.05 * np.sin(tilt), 0.0, tilt)
    bar = assembly.add_body("bar", 2.0, 0.03, place, speed=(12.0, 0.0, 5.0))
    assembly.add_outline(OutlinePiece(bar, 0.2, -0.2, 0.0, 0.05))
    for i in range(20):
        z = 0.038 - 0.004 * i
        assembly.add(FleshCompression(carrier=GROUND, face_x=0.0, face_z=z, height=0.004, **FLESH))
    run = run_world(assembly.finish(), Plan(5e-6, 0.02, 0.02), [], [bar])
    assert run.flesh_depth > 0.5
    assert np.abs(balance(run) - balance(run)[0]).max() < 1e-3 * balance(run)[0]


def test_flesh_and_honeycomb_in_series_carry_the_same_force():
    honeycomb = FLESH | {"strength": 4e5, "elastic_depth": 1e-3, "thickness": 1e-9}
    run, _ = bar_against(Honeycomb, honeycomb, 10.0, 0.05)
    force = run.readings.sum(axis=1)
    assert force.max() == pytest.approx(4e5 * 0.05 * 0.08, rel=1e-9)
    # 4e5 Pa · 0.05 m crush it where k·d·(1 + (d/t)²) is as much.
    deep = run.flesh_depth * 0.03
    assert 1e6 * deep * (1 + (deep / 0.03) ** 2) == pytest.approx(4e5 * 0.05, rel=1e-3)


def test_honeycomb_never_pushes_harder_than_its_strength_and_never_pulls():
    run, _ = bar_against(Honeycomb, FLESH | {"strength": 4e5, "elastic_depth": 1e-3}, 10.0, 0.05)
    force = run.readings.sum(axis=1)
    strength = 4e5 * 0.05 * 0.08
    assert force.max() == pytest.approx(strength, rel=1e-12)
    assert force.min() == 0
    crushed = run.tracks[:, 0, 0].max() - 1e-3
    assert run.dissipated[-1].sum() == pytest.approx(strength * crushed, rel=1e-3)
    back = (run.tracks[-1, 0, 0] - run.tracks[-2, 0, 0]) / STEP
    assert -back == pytest.approx(np.sqrt(2 * 0.5 * strength * 1e-3 / 2.0), rel=1e-2)


def test_steel_cables_stiffen_a_joint_beyond_their_angle():
    assembly = Assembly()
    for i in range(2):
        assembly.add_body(f"link {i}", 0.3, 2e-4, (0.0, -0.04 * i, 0.0), speed=(0.0, 0.0, 60.0 * (2 * i - 1)))
    assembly.add_pivot(0, 1, 0.0, -0.02)
    assembly.add(
        JointSpring(upper=0, lower=1, stiffness=1000.0, damping=0.0, cable_angle=0.02, cable_stiffness=9000.0)
    )
    world = assembly.finish()
    run = run_world(
        world, Plan(STEP, 0.01, 0.01), [world.place(JointSpring, 0, n) for n in ("moment", "angle")]
    )
    moment, angle = run.readings.T
    assert np.abs(angle).max() > 0.021
    expected = 1000 * angle + 9000 * np.sign(angle) * np.clip(np.abs(angle) - 0.02, 0, None)
    assert moment == pytest.approx(expected, abs=1e-9)


def two_guided_blocks(speed: float, damping: float) -> Trajectory:
    """Let a turned block slide across another against the guide between them; slide and force are read."""
    assembly = Assembly()
    upper = assembly.add_body("upper", 2.0, 0.004, (0.0, 0.045, 0.0), speed=(speed, 0.0, 3.0))
    lower = assembly.add_body("lower", 2.5, 0.005, (0.0, -0.045, 0.0))
    assembly.add(
        SlidingGuide(
            upper=upper,
            lower=lower,
            upper_x=0.03,
            upper_z=-0.045,
            lower_x=0.03,
            free_travel=0.004,
            stiffness=3e5,
            damping=damping,
        )
    )
    world = assembly.finish()
    probes = [world.place(SlidingGuide, 0, reading) for reading in ("slide", "force")]
    return run_world(world, Plan(STEP, 0.03, 0.03), probes, [upper, lower])


def test_a_guide_leaves_the_blocks_free_within_its_travel_and_holds_them_beyond():
    run = two_guided_blocks(speed=2.0, damping=0.0)
    slide, force = run.readings.T
    assert np.abs(slide).max() > 0.005
    assert np.all(force[np.abs(slide) <= 0.004] == 0)
    assert force == pytest.approx(np.sign(slide) * 3e5 * np.clip(np.abs(slide) - 0.004, 0, None), abs=1e-6)


@pytest.mark.parametrize("damping", [0.0, 80.0])
def test_a_guide_keeps_momentum_and_its_energy_is_accounted_for(damping: float):
    run = two_guided_blocks(speed=2.0, damping=damping)
    speed = np.diff(run.tracks, axis=0) / STEP
    mass, inertia = np.array([2.0, 2.5]), np.array([0.004, 0.005])
    middle = (run.tracks[1:] + run.tracks[:-1]) / 2
    momentum = (mass[:, None] * speed[:, :, :2]).sum(axis=1)
    turning = middle[:, :, 0] * speed[:, :, 1] - middle[:, :, 1] * speed[:, :, 0]
    angular = (inertia * speed[:, :, 2] + mass * turning).sum(axis=1)
    assert np.ptp(momentum, axis=0) == pytest.approx([0, 0], abs=1e-9)
    assert np.ptp(angular) < 2e-5 * np.abs(angular).max()
    assert np.abs(balance(run) - balance(run)[0]).max() < 1e-3 * balance(run)[0]
    assert (
        run.dissipated[-1].sum() == pytest.approx(0, abs=1e-9)
        if damping == 0
        else run.dissipated[-1].sum() > 0.01
    )


def test_every_law_is_a_record_with_bodies_that_exist_and_a_name_of_its_own():
    assert len({law.words() for law in LAWS}) == len(LAWS)
    for law in LAWS:
        assert record_type(law).itemsize == WORD * len(record_type(law).names)
        assert law.__doc__
        assert issubclass(law, ForceLaw)


def test_a_record_field_of_another_type_is_refused():
    class Named(Record):
        name: str

    with pytest.raises(TypeError, match=r"Named\.name must be one of"):
        record_type(Named)


def swinging_flesh(damping: float, offset: float) -> Trajectory:
    """Let a piece of flesh swing across and along a turning bone; its shifts are read."""
    assembly = Assembly()
    bone = assembly.add_body("bone", 0.5, 0.002, (0.0, 0.0, 0.4), speed=(0.0, 0.0, 2.0))
    beside = (0.001 + offset * np.cos(0.4), 0.01 + offset * np.sin(0.4), 0.0)
    flesh = assembly.add_body("flesh", 0.2, 0.0, beside, speed=(0.5, -0.3, 0.0))
    assembly.add(
        FleshSuspension(
            bone=bone,
            flesh=flesh,
            height=0.01,
            offset=offset,
            stiffness_across=4e4,
            stiffness_along=9e4,
            damping_across=damping,
            damping_along=damping,
        )
    )
    world = assembly.finish()
    shifts = [world.place(FleshSuspension, 0, name) for name in ("shift_across", "shift_along")]
    return run_world(world, Plan(STEP, 0.05, 0.05), shifts, [bone, flesh])


@pytest.mark.parametrize("damping", [0.0, 8.0])
@pytest.mark.parametrize("offset", [0.0, -0.043])
def test_flesh_on_its_bone_keeps_momentum_spin_and_energy(damping: float, offset: float):
    run = swinging_flesh(damping, offset)
    speed, middle = np.diff(run.tracks, axis=0) / STEP, (run.tracks[1:] + run.tracks[:-1]) / 2
    mass = np.array([0.5, 0.2])
    momentum = (mass[:, None] * speed[:, :, :2]).sum(axis=1)
    turning = middle[:, :, 0] * speed[:, :, 1] - middle[:, :, 1] * speed[:, :, 0]
    spin = 0.002 * speed[:, 0, 2] + (mass * turning).sum(axis=1)
    assert np.ptp(momentum, axis=0) == pytest.approx([0, 0], abs=1e-9)
    assert np.ptp(spin) < 1e-4 * np.abs(spin).max()
    assert np.abs(balance(run) - balance(run)[0]).max() < 1e-3 * balance(run)[0]
    last = np.abs(run.readings[-1000:]).max()
    assert (last < 0.5 * np.abs(run.readings).max()) == (damping > 0)


def test_the_loading_ram_follows_its_schedule_and_its_work_moves_the_body():
    assembly = Assembly()
    ram = assembly.add_body("ram", 2.0, 0.0, (0.3, 0.0, 0.0), guided=True)
    start, points = assembly.add_curve([(0.0, 0.0), (0.01, 100.0), (0.03, 100.0)])
    assembly.add(
        LoadingRamForce(ram=ram, station=0.0, start=0.3, schedule_start=start, schedule_points=points)
    )
    world = assembly.finish()
    states = [world.place(LoadingRamForce, 0, name) for name in ("force", "travel")]
    run = run_world(world, Plan(STEP, 0.05, 0.05), states)
    force, travel = run.readings.T
    assert force == pytest.approx(np.interp(run.time, [0.0, 0.01, 0.05], [0.0, 100.0, 100.0]), abs=1e-9)
    assert travel[-1] == pytest.approx(0.5 * 100 / 2.0 * (0.04**2 + 0.01 * 0.04 + 0.01**2 / 3), rel=1e-4)
    assert run.kinetic[-1] == pytest.approx(-run.dissipated[-1].sum(), rel=1e-4)


def test_a_ram_nose_bounces_off_a_block_and_pushes_only():
    assembly = Assembly()
    ram = assembly.add_body("ram", 1.0, 0.0, (0.151, 0.0, 0.0), speed=(-2.0, 0.0, 0.0), guided=True)
    block = assembly.add_body("block", 1.0, 0.003, (0.0, 0.0, 0.0))
    assembly.add(RamNoseContact(ram=ram, block=block, radius=0.05, face=0.1, stiffness=1e6))
    world = assembly.finish()
    states = [world.place(RamNoseContact, 0, name) for name in ("depth", "force")]
    run = run_world(world, Plan(STEP, 0.01, 0.01), states, [ram, block])
    depth, force = run.readings.T
    assert np.all(force >= 0)
    assert np.all(force[depth <= 0] == 0)
    assert force.max() == pytest.approx(2.0 * np.sqrt(0.5 * 1e6), rel=1e-3)  # v·√(k·m_red)
    after = (run.tracks[-1, :, 0] - run.tracks[-2, :, 0]) / STEP
    assert after == pytest.approx([0.0, -2.0], abs=1e-4)  # equal masses exchange their speeds


def test_a_roller_holds_a_falling_bar_by_its_weight_at_rest():
    assembly = Assembly(gravity=(-9.81, 0.0))
    bar = assembly.add_body("bar", 2.0, 0.03, (0.0, 0.0, 0.0), damping=300.0)
    assembly.add_outline(OutlinePiece(bar, 0.2, -0.2, 0.0, 0.0))
    for z in (0.1, -0.1):
        assembly.add(SupportRoller(station=z, stiffness=1e5, damping=50.0))
    world = assembly.finish()
    forces = [world.place(SupportRoller, i, "force") for i in range(2)]
    run = run_world(world, Plan(1e-4, 0.5, 0.5), forces)
    assert run.readings[-1] == pytest.approx([9.81, 9.81], rel=1e-6)
