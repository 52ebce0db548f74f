"""The leg in free flight begins where the procedure says, however it is tilted."""

from __future__ import annotations

import math

import pytest

from certkit.bench.setup import prepare
from certkit.mechanics import simulate


@pytest.mark.parametrize("angle", [-20.0, 0.0, 5.0, 30.0])
def test_a_tilted_leg_ends_as_far_above_the_ground_as_an_upright_one(angle: float) -> None:
    overrides = {"rig.free flight.angle": f"{angle} deg", "run.until": "1 ms"}
    setup = prepare("vehicle", overrides=overrides)
    run = simulate(setup.procedure, setup.legform, vehicle=setup.vehicle)
    assert run.rig.front is not None
    assert setup.vehicle is not None
    leg = run.rig.leg
    _, z, turned = run.run.frames[0, leg.bodies[-1]]
    end = z + math.cos(turned) * (leg.bottom - leg.centres[-1])
    lowest = min(run.rig.front.strips, key=lambda strip: strip.z)
    ground = lowest.z - lowest.height / 2 - float(setup.vehicle.groups["F1"].low or 0.0)
    # It falls and flies for half a step before the first frame.
    assert end - ground == pytest.approx(0.075, abs=1e-6)
