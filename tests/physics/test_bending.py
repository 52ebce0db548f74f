"""Three-point bending of the segmented bones against the equilibrium of the same chain."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.mechanics import simulate


def equilibrium(
    segments: int, length: float, stiffness: float, span: float, force: float
) -> tuple[float, float]:
    """Return deflection and moment at mid-span of a chain on two rollers fixed in space, by finite rotations.

    Half the chain by symmetry, angle by angle from mid-span outwards: a joint at some distance along the
    span from its roller carries F/2 times that distance.
    """
    half = segments // 2
    h, k = length / segments, stiffness * segments / length

    def angles_for(mid_angle: float) -> tuple[np.ndarray, float]:
        # From mid-span outwards: the first link leans by half the mid joint's angle.
        angle, along, angles = mid_angle / 2, 0.0, [mid_angle / 2]
        for _ in range(half - 1):
            along += h * np.cos(angle)
            angle += force / 2 * (span / 2 - along) / k
            angles.append(angle)
        return np.array(angles), k * mid_angle - force / 2 * span / 2

    low, high = 0.0, 1.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if angles_for(middle)[1] < 0 else (low, middle)
    angles, _ = angles_for(low)
    along = np.concatenate([[0.0], np.cumsum(h * np.cos(angles))])
    rise = np.concatenate([[0.0], np.cumsum(h * np.sin(angles))])
    # The roller stands under the last link, or under its rigid extension.
    last = len(angles) - 1
    deflection = rise[last] + (span / 2 - along[last]) * np.tan(angles[last])
    return float(deflection), k * low


CASES = [("static-femur", "femur", 0.330, 4606.0), ("static-tibia", "tibia", 0.410, 3707.0)]


@pytest.mark.parametrize(("name", "part", "span", "force"), CASES)
def test_deflection_is_that_of_the_chain_s_equilibrium_within_half_a_per_cent(
    name: str, part: str, span: float, force: float
):
    legform = load("legform", "flex-pli-gtr").document
    run = simulate(load("procedure", name).document, legform).recording
    bone = legform.parts[part]
    for level in (len(run.time) // 2, len(run.time) - 1):
        at = run["ram force"].values[level]
        deflection, moment = equilibrium(
            bone.segments, float(bone.length), float(bone.bending_stiffness), span, at
        )
        assert run["mid deflection"].values[level] == pytest.approx(deflection, rel=5e-3)
        assert run["mid moment"].values[level] == pytest.approx(moment, rel=2e-3)
    assert run["ram force"].values[-1] == pytest.approx(force)
    assert run["mid moment"].values[-1] == pytest.approx(380.0, rel=5e-3)


@pytest.mark.parametrize(("name", "part", "span", "force"), CASES)
def test_at_small_load_deflection_is_linear(name: str, part: str, span: float, force: float):
    legform = load("legform", "flex-pli-gtr").document
    run = simulate(load("procedure", name).document, legform).recording
    bone = legform.parts[part]
    h = float(bone.length) / bone.segments
    # Unit-load method: each joint turns by M h / EI, its unit moment is half its distance from the roller.
    joints = np.abs(np.arange(1, bone.segments) - bone.segments / 2) * h
    arms = np.clip(span / 2 - joints, 0, None)
    compliance = (arms**2 / 4).sum() * h / float(bone.bending_stiffness)
    assert run["ram force"].values[1] == pytest.approx(force / 20)
    assert run["mid deflection"].values[1] == pytest.approx(force / 20 * compliance, rel=5e-3)


def test_at_rest_the_work_of_the_ram_is_stored_or_spent():
    quality = simulate(
        load("procedure", "static-femur").document, load("legform", "flex-pli-gtr").document
    ).quality
    assert quality.energy_error_percent < 0.1
