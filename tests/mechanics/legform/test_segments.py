"""The built leg has the regulated masses, centres of gravity and inertias."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certkit.definitions.legform_parts import FarFlesh
from certkit.definitions.loading.library import load
from certkit.errors import RunError
from certkit.mechanics.legform.leg import add_leg
from certkit.mechanics.legform.segments import assembled, bone_segments, leg_segments
from certkit.mechanics.solver.world import Assembly

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform


@pytest.fixture(scope="module")
def legform() -> Legform:
    return load("legform", "flex-pli-gtr").document


@pytest.mark.parametrize(
    ("part", "top", "mass", "mass_tolerance", "cg", "cg_tolerance", "inertia", "inertia_tolerance"),
    [
        ("femur", 0.433, 2.46, 0.12, 0.159, 0.008, 0.0325, 0.0016),
        ("knee", 0.094, 4.28, 0.21, 0.092, 0.005, 0.0180, 0.0009),
        ("tibia", -0.091, 2.64, 0.13, 0.202, 0.010, 0.0467, 0.0023),
    ],
)
def test_each_part_lies_within_the_tolerances_as_remembered(  # noqa: PLR0917  # one column a quantity
    legform: Legform,
    part: str,
    top: float,
    mass: float,
    mass_tolerance: float,
    cg: float,
    cg_tolerance: float,
    inertia: float,
    inertia_tolerance: float,
):
    built = assembled(leg_segments(legform, part))
    assert built[0] == pytest.approx(mass, abs=mass_tolerance)
    assert top - built[1] == pytest.approx(cg, abs=cg_tolerance)
    assert built[2] == pytest.approx(inertia, abs=inertia_tolerance)


def test_each_part_meets_its_own_document_exactly(legform: Legform):
    for part, top in (("femur", 0.433), ("knee", 0.094), ("tibia", -0.091)):
        mass, centre, inertia = assembled(leg_segments(legform, part))
        section = legform.knee if part == "knee" else legform.parts[part]
        assert mass == pytest.approx(section.mass, rel=1e-12)
        assert top - centre == pytest.approx(section.centre_of_gravity, rel=1e-12)
        assert inertia == pytest.approx(section.inertia, rel=1e-12)


def test_the_leg_weighs_13_2_kg_with_flesh_and_9_38_kg_without(legform: Legform):
    for flesh, total in ((True, 13.2), (False, 9.38)):
        assembly = Assembly()
        add_leg(assembly, legform, leg_segments(legform), flesh=flesh)
        assert assembly.masses()[:, 0].sum() == pytest.approx(total, abs=1e-9)


def test_the_leg_is_928_mm_long_without_a_gap(legform: Legform):
    segments = leg_segments(legform)
    assert segments[0].top - segments[-1].bottom == pytest.approx(0.928)
    assert all(upper.bottom == pytest.approx(lower.top, abs=1e-12) for upper, lower in pairwise(segments))
    assert len(segments) == 8 + 2 + 10
    assert all(segment.mass > 0 and segment.inertia > 0 for segment in segments)


def test_the_number_of_segments_changes_no_mass(legform: Legform):
    finer = legform.parts["tibia"].model_copy(update={"segments": 40})
    coarse, fine = (
        assembled(bone_segments("tibia", legform.parts["tibia"], 0.0)),
        assembled(bone_segments("tibia", finer, 0.0)),
    )
    assert fine == pytest.approx(coarse, rel=1e-12)


def test_an_inertia_no_bone_can_have_is_refused(legform: Legform):
    impossible = legform.parts["tibia"].model_copy(update={"inertia": 0.01})
    with pytest.raises(
        RunError, match=r"no distribution of the tibia's mass .* has to be from 0\.0\d+ to 0\.\d+"
    ):
        bone_segments("tibia", impossible, 0.0)


@given(
    length=st.floats(0.1, 0.5),
    depth=st.floats(0.01, 0.4),
    centre_of_gravity=st.floats(-0.1, 0.6),
    inertia=st.floats(0.001, 0.5),
    mass=st.floats(0.5, 12.0),
)
def test_a_bone_that_can_be_cut_is_told_from_one_that_cannot_by_its_definition(**numbers: float):
    bone = load("legform", "flex-pli-gtr").document.parts["tibia"].model_copy(update=numbers)
    try:
        cut = bool(bone_segments("tibia", bone, 0.0))
    except RunError:
        cut = False
    assert cut == (bone.spread_fault() is None)


def test_flesh_on_both_sides_has_the_mass_of_the_flesh_and_stands_in_the_middle_of_each(legform: Legform):
    far = FarFlesh.model_validate(
        {
            "origin": {"source": "for the test", "confidence": "estimated"},
            "share": 0.4,
            "across": "90 Hz",
            "along": "60 Hz",
            "damping ratio": 0.1,
        }
    )
    both = legform.model_copy(update={"flesh": legform.flesh.model_copy(update={"far_side": far})})
    segments = leg_segments(both)
    assembly = Assembly()
    add_leg(assembly, both, segments, flesh=True)
    world = assembly.finish()
    bodies = {
        n: (m, p[0]) for n, m, p in zip(world.names, world.mass, world.pose, strict=True) if "flesh" in n
    }
    far_ones = [value for name, value in bodies.items() if name.startswith("far")]
    assert len(bodies) == 2 * len(segments)
    assert sum(mass for mass, _ in bodies.values()) == pytest.approx(legform.flesh.mass)
    assert sum(mass for mass, _ in far_ones) == pytest.approx(0.4 * legform.flesh.mass)
    assert all(x < 0 for _, x in far_ones)
    places = sorted({round(abs(x), 9) for _, x in bodies.values()})
    assert places == [
        pytest.approx((depth + legform.flesh.thickness) / 2) for depth in sorted({s.depth for s in segments})
    ]


def test_flesh_that_is_open_at_the_knee_lies_behind_the_bones_alone():
    leg = load("legform", "fe-leg").document
    far = leg.flesh.far_side.model_copy(update={"at_knee": 0.0})
    opened = leg.model_copy(update={"flesh": leg.flesh.model_copy(update={"far_side": far})})
    masses = []
    for each in (opened, leg):
        assembly = Assembly()
        segments = leg_segments(each)
        add_leg(assembly, each, segments, flesh=True)
        world = assembly.finish()
        masses.append(dict(zip(world.names, world.mass, strict=True)))
    knee = {f"far flesh {i + 1}" for i, segment in enumerate(segments) if segment.is_knee}
    assert not knee & masses[0].keys()
    assert knee <= masses[1].keys()
    for found in masses:
        behind = sum(mass for name, mass in found.items() if name.startswith("far"))
        assert behind == pytest.approx(leg.flesh.mass * leg.flesh.far_side.share)
