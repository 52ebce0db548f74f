"""Numbers of a legform's flesh that no law could use are refused where they are written."""

from __future__ import annotations

import pytest

import certkit
from certkit.errors import DefinitionError


@pytest.mark.parametrize("speed", ["0 m/s", "-1 m/s"])
def test_friction_cannot_turn_by_a_step(speed: str):
    with pytest.raises(DefinitionError, match="above zero"):
        certkit.run("pendulum", overrides={"legform.flesh.reversal speed": speed})


def test_foam_springs_back_no_softer_than_it_was_pressed():
    change = {"legform": "fe-leg", "legform.flesh.foam.elastic modulus": "0.5 MPa"}
    with pytest.raises(
        DefinitionError, match=r"elastic modulus.*more than the curve's first slope, 0\.7 MPa"
    ):
        certkit.run("pendulum", overrides=change)


def test_an_element_of_foam_is_a_piece_of_a_leg():
    change = {"legform": "fe-leg", "legform.flesh.foam.element": "0.2 mm"}
    with pytest.raises(DefinitionError, match="an element of a leg's foam is 2 to 50 mm long"):
        certkit.run("pendulum", overrides=change)


def test_a_sleeve_bends_by_its_foam_or_by_a_stiffness_of_its_own():
    change = {"legform": "fe-leg", "legform.flesh.bending stiffness": "9 N·m²"}
    with pytest.raises(DefinitionError, match="leave one of them out"):
        certkit.run("pendulum", overrides=change)
