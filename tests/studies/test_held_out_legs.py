"""Legs from other seeds, kept out of the family: their values lie where the family's are."""

from __future__ import annotations

from functools import cache

import pytest

from certkit.definitions.legform_family import Member
from certkit.definitions.loading.library import load
from certkit.studies.trial import Trial

CASES = {
    "pendulum": ("pendulum", ""),
    "inverse": ("inverse", ""),
    "saloon": ("vehicle", "generic-saloon"),
    "suv": ("vehicle", "generic-suv"),
    "sports car": ("vehicle", "generic-sports-car"),
}
CRITERIA = ("T1", "T2", "T3", "T4", "F1", "F2", "F3", "MCL", "ACL", "PCL")
FAMILY = load("family", "flex-pli-gtr").document.members
OTHERS = load("family", "flex-pli-gtr-others").document.members


@cache
def values(case: str, number: int, *, other: bool = False) -> dict[str, float | str | None]:
    """Run a case with a leg of the family, or one kept out of it; -1 is the shipped leg."""
    procedure, vehicle = CASES[case]
    leg: Member | None = None if number < 0 else (OTHERS if other else FAMILY)[number]
    fixed = {} if leg is None else leg.overrides(procedure)
    outputs = Trial((procedure,), fixed={**fixed, **({"vehicle": vehicle} if vehicle else {})})({})
    return {name.partition("/")[2]: value for name, value in outputs.items()}


def test_the_legs_kept_out_are_no_members_and_no_starts_of_the_family() -> None:
    starts = load("family", "flex-pli-gtr-basins").document.members
    known = {tuple(member.values.values()) for member in (*FAMILY, *starts)}
    assert len(OTHERS) == 5
    assert not known & {tuple(member.values.values()) for member in OTHERS}


@pytest.mark.parametrize("number", range(len(OTHERS)))
@pytest.mark.parametrize("procedure", ["pendulum", "inverse"])
def test_the_legs_kept_out_pass_both_tests_too(procedure: str, number: int) -> None:
    assert values(procedure, number, other=True)["verdict"] == "pass"


@pytest.mark.slow
def test_nine_tenths_of_their_values_lie_inside_the_familys_range() -> None:
    inside = []
    for case in CASES:
        legs = [values(case, number) for number in range(-1, len(FAMILY))]
        assert all(leg["verdict"] != "error" for leg in legs)
        assert max(float(leg["flesh depth %"] or 0.0) for leg in legs) <= 100
        for name in CRITERIA:
            family = [float(leg[name]) for leg in legs]
            others = [float(values(case, number, other=True)[name]) for number in range(len(OTHERS))]
            inside += [min(family) <= value <= max(family) for value in others]
    assert len(inside) == 250
    assert sum(inside) >= 0.9 * len(inside)
