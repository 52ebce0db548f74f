"""Numbers of a legform's flesh that no law could use are refused where they are written."""

from __future__ import annotations

import pytest

import certkit
from certkit.errors import DefinitionError


@pytest.mark.parametrize("speed", ["0 m/s", "-1 m/s"])
def test_friction_cannot_turn_by_a_step(speed: str):
    with pytest.raises(DefinitionError, match="above zero"):
        certkit.run("pendulum", overrides={"legform.flesh.reversal speed": speed})
