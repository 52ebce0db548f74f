"""Quantities are what pint says they are."""

from __future__ import annotations

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from certkit.definitions.units import UNITS, alike, dimensions, parse_quantity

SPELLED = {
    "°": "degree",
    "°C": "degC",
    "N·m": "N*m",
    "kN·m": "kN*m",
    "N·mm": "N*mm",
    "g·m²": "g*m**2",
    "psi": "psi",
}
SI = {
    "length": "m",
    "mass": "kg",
    "time": "s",
    "angle": "rad",
    "speed": "m/s",
    "acceleration": "m/s**2",
    "force": "N",
    "moment": "N*m",
    "stiffness": "N/m",
    "damping": "N*s/m",
    "rotational stiffness": "N*m/rad",
    "rotational damping": "N*m*s/rad",
    "bending stiffness": "N*m**2",
    "inertia": "kg*m**2",
    "pressure": "Pa",
    "foundation stiffness": "N/m**2",
    "line load": "N/m",
    "frequency": "Hz",
    "energy": "J",
    "temperature": "K",
    "temperature difference": "K",
}
PAIRS = [(dimension, unit) for dimension, table in UNITS.items() for unit in table if dimension in SI]


def oracle(value: float, unit: str, dimension: str, registry: pint.UnitRegistry) -> float:
    spelled = SPELLED.get(unit, unit).replace("·", "*").replace("²", "**2")
    if dimension == "acceleration" and unit == "g":
        spelled = "standard_gravity"
    return float(registry.Quantity(value, spelled).to(SI[dimension]).magnitude)


@pytest.fixture(scope="module")
def registry() -> pint.UnitRegistry:
    return pint.UnitRegistry()


def test_pint_is_asked_about_every_dimension_but_plain_numbers():
    assert set(UNITS) - set(SI) == {"ratio", "count"}


@pytest.mark.parametrize(("dimension", "unit"), PAIRS)
def test_every_unit_is_worth_what_pint_says(dimension: str, unit: str, registry: pint.UnitRegistry):
    assert parse_quantity(f"2.5 {unit}", dimension) == pytest.approx(
        oracle(2.5, unit, dimension, registry), rel=1e-12
    )


@pytest.mark.parametrize("text", ["5 Nm", "5 N·m", "5 N*m", "5 N * m", "5N·m", "5.0e0 N⋅m"])
def test_a_moment_may_be_spelt_in_several_ways(text: str):
    assert parse_quantity(text, "moment") == 5.0


def test_ratios_are_plain_numbers_or_per_cent():
    assert parse_quantity(0.2, "ratio") == 0.2
    assert parse_quantity("20 %", "ratio") == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("text", "dimension", "said"),
    [
        ("25", "length", "has no unit"),
        ("25 kg", "length", "has the unit `kg`; a length is written in mm"),
        ("mm", "length", "is not a number with a unit"),
        ("1e999 m", "length", "is not a finite number"),
        (True, "length", "expected a length"),
        (None, "length", "expected a length"),
        ([1], "ratio", "expected a ratio"),
        ("nan mm", "length", "is not a number with a unit"),
    ],
)
def test_what_is_no_quantity_is_refused_with_what_would_do(text: object, dimension: str, said: str):
    with pytest.raises(ValueError, match=said):
        parse_quantity(text, dimension)


def test_a_text_may_be_a_quantity_of_several_dimensions():
    assert dimensions("3 g") == ["mass", "acceleration"]
    assert dimensions("3 apples") == []


def test_a_message_repeats_no_more_than_the_beginning_of_a_long_text():
    with pytest.raises(ValueError, match="…") as caught:
        parse_quantity("x" * 10_000, "length")
    assert len(str(caught.value)) < 200


def test_quantities_of_one_kind_are_read_in_one_unit():
    assert alike(["235 N·m", "0.272 kN·m"]) == ([235.0, 272.0], [])


def test_quantities_of_different_kinds_are_told_apart():
    values, wrong = alike(["3 g", "5 kg", "7 m"])
    assert values == []
    assert wrong == [(2, "`7 m` is another kind of quantity than the mass before it")]


@given(st.text(max_size=30), st.sampled_from(sorted(UNITS)))
def test_any_text_is_a_finite_number_or_a_value_error(text: str, dimension: str):
    try:
        value = parse_quantity(text, dimension)
    except ValueError:
        return
    assert abs(value) < float("inf")
