"""The contact alone: leg and front led along the run's own motion, and what the contact law makes of it.

Neither the leg's bending nor the front's springs have a part in it: what is off here is off by the contact
law, or by the outlines of the faces.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.bench.contact_places import AXIS, axis_nodes
from certkit.bench.group_checks import contact_figures, group_checks

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.bench.checked_run import CheckedRun
    from certkit.bench.setup import Setup
    from certkit.documents.self_check import SelfCheck
    from certkit.exchange.fe.node_motion import NodeMotion

    Values = NDArray[np.float64]

KNEE = "leg_knee"
"""Lines of nodes in the middle of the knee's blocks begin with this."""
INTERVAL = 2e-4
"""s between two places that the leg and the front are led through."""


def leg_nodes(motion: NodeMotion | None) -> Values | None:
    """Return the nodes along the leg from the lowest, shape (nodes, instants, 2), or that there are none."""
    return None if motion is None else axis_nodes(motion, (AXIS, KNEE))


def contact_alone(run: CheckedRun, setup: Setup, nodes: Values) -> SelfCheck:
    """Compare the contact force on each group, the worst first.

    Parameters
    ----------
    run : CheckedRun
    setup : Setup
    nodes : ndarray, shape (nodes, instants, 2)
        See `leg_nodes`.
    """
    from scipy.interpolate import CubicSpline  # noqa: PLC0415  # slow to import, only here

    from certkit.mechanics.contact_drive import LedMotion, drive_contact  # noqa: PLC0415  # a solver

    if setup.vehicle is None or run.data.motion is None:
        raise ValueError("a contact is checked with a procedure that hits a vehicle, and a recorded motion")
    seen = run.data.motion.time
    time = np.arange(run.time[0], min(run.until, float(seen[-1])), INTERVAL)
    moved = {group.name: np.array(group.displacement[: run.time.size]) for group in run.result.groups}
    led = LedMotion(
        time=time,
        contact=run.start,
        axis=CubicSpline(seen, nodes, axis=1)(time),
        groups={name: np.interp(time, run.time, x) for name, x in moved.items()},
    )
    own, pressed = drive_contact(setup.procedure, setup.legform, setup.vehicle, led)
    forces = {name: np.interp(run.time, own, force, right=0.0) for name, force in pressed.items()}
    faces = {name: x for name, x in moved.items() if name in run.contacts}
    check = group_checks(run, "contact alone", faces, forces)
    total = sum(forces.values(), np.zeros_like(run.time))
    return check.model_copy(
        update={
            "groups": tuple(sorted(check.groups, key=lambda g: -(g.force_rms_percent or 0.0))),
            "mean_percent": None,
            "worst_percent": None,
            "within": None,
            **contact_figures(run, check.groups, total),
        }
    )
