"""Where a run's contact forces act on its leg."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.bench.contact_places import recorded_forces
from certkit.exchange.fe.node_motion import NodeMotion
from tests.support.synthetic_extraction import extraction

TIMES = np.linspace(0.0, 0.045, 46)
END = 0.3
"""m: height of the leg's lower end."""


def still(*places: tuple[float, float]) -> dict[str, np.ndarray]:
    return {f"node {k}": np.tile(place, (TIMES.size, 1)) for k, place in enumerate(places)}


@pytest.mark.parametrize("heights", [(0.22, 0.28, 0.32), (0.22, 0.28)])
def test_no_force_is_lost_below_the_legs_end(heights: tuple[float, ...]) -> None:
    """A face that reaches below the leg, or lies below it altogether, presses on what there is of the leg."""
    axis = still(*((0.0, END + 0.1 * k) for k in range(8)))
    motion = NodeMotion(TIMES, {"leg_axis": axis, "F1": still(*((0.05, z) for z in heights))})
    result = extraction()
    forces = [f for f in recorded_forces(result, motion, face=0.028, thickness=0.03) if f.group == "F1"]
    whole = next(path.force for path in result.paths if path.name == "leg – F1")
    assert sum(f.force for f in forces) == pytest.approx(np.array(whole))
    assert all(f.height.min() > END for f in forces if np.any(f.force))
