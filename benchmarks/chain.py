"""The bone chain: our solver against Exudyn and against a tight compiled loop, all at the same accuracy."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from clock import Row

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from support.chain_oracle import Chain, bone_chain
from tight import tight_chain

from certkit.errors import RunError
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.solver.time_loop import Plan, run_world

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    Solved = tuple[NDArray[np.float64], float]

UNTIL = 0.03
EVERY = 1e-4
REPEATS = 7
ACCURACY = 0.05  # per cent of each joint's peak moment
STEPS = tuple(EVERY / n for n in (1, 2, 3, 4, 5, 7, 10, 20, 40, 100))


def rows() -> Iterator[Row]:
    """Yield the ratios."""
    chain = bone_chain()
    start = swing(chain)
    times = np.arange(0, round(UNTIL / EVERY) + 1) * EVERY
    exact = np.diff(chain.integrate(*start, times)[:, 2:], axis=1) * chain.stiffness
    step, ours = matched(lambda h: in_certkit(chain, start, h), exact)
    yield Row(f"bone chain, certkit at {step:.3g} s for {ACCURACY} % peak", ours * 1e3, "ms")
    step, tight = matched(lambda h: in_tight_loop(chain, start, h), exact)
    yield Row(f"bone chain, tight compiled loop at {step:.3g} s", tight * 1e3, "ms")
    yield Row("certkit / tight compiled loop", ours / tight, "", 1.5, "most")
    try:
        import exudyn  # noqa: F401, PLC0415  # a development dependency
    except ImportError:
        print("Exudyn is not installed: no comparison")
        return
    step, theirs = matched(lambda h: in_exudyn(chain, start, h), exact)
    yield Row(f"bone chain, Exudyn at {step:.3g} s", theirs * 1e3, "ms")
    yield Row("Exudyn / certkit", theirs / ours, "", 14.0, "least")


def swing(chain: Chain) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a straight chain that bends itself hard and turns as well."""
    n = chain.links
    q, v = np.zeros(n + 2), np.zeros(n + 2)
    v[2:] = 25.0 * np.sin(2 * np.pi * np.arange(n) / (n - 1)) + 6.0
    v[0] = 2.0
    return q, v


def matched(run: Callable[[float], Solved], exact: NDArray[np.float64]) -> tuple[float, float]:
    """Return the longest step that reaches the accuracy, and the least seconds of solving with it."""
    peak = np.abs(exact).max(axis=0)
    for step in STEPS:
        try:
            found, _ = run(step)
        except RunError:
            continue  # too long a step: the solver says so
        if not np.isfinite(found).all():
            continue
        error = 100 * float((np.abs(np.abs(found).max(axis=0) - peak) / peak).max())
        if error <= ACCURACY:
            return step, min(run(step)[1] for _ in range(REPEATS))
    raise SystemExit("no step reaches the accuracy")


def in_certkit(chain: Chain, start: tuple[NDArray[np.float64], NDArray[np.float64]], step: float) -> Solved:
    """Return the elastic joint moments every 0.1 ms, shape (t, joints), and the seconds."""
    world = chain.world(*start)
    plan = Plan(step, UNTIL, UNTIL, sample=round(EVERY / step), frame=10_000)
    probes = [world.place(JointSpring, i, "angle") for i in range(chain.links - 1)]
    run = run_world(world, plan, probes)
    return run.readings * chain.stiffness, run.seconds


def in_tight_loop(
    chain: Chain, start: tuple[NDArray[np.float64], NDArray[np.float64]], step: float
) -> Solved:
    """Return the same from the tight compiled loop."""
    begun = time.process_time()
    found = tight_chain(chain, *start, step, UNTIL, round(EVERY / step))
    return found, time.process_time() - begun


def in_exudyn(chain: Chain, start: tuple[NDArray[np.float64], NDArray[np.float64]], step: float) -> Solved:
    """Return the same from Exudyn's generalised-alpha solver, without numerical damping."""
    import exudyn as exu  # noqa: PLC0415  # a development dependency
    from exudyn import itemInterface as Item  # noqa: PLC0415  # short for ten uses

    q, v = start
    centres, jacobian = chain.centres(q)
    speeds = jacobian @ v
    mbs = exu.SystemContainer().AddSystem()
    nodes, bodies = [], []
    for i in range(chain.links):
        nodes.append(
            mbs.AddNode(
                Item.NodeRigidBody2D(
                    referenceCoordinates=[*centres[i], q[2 + i]], initialVelocities=[*speeds[i], v[2 + i]]
                )
            )
        )
        bodies.append(
            mbs.AddObject(Item.RigidBody2D(mass=chain.mass[i], inertia=chain.inertia[i], nodeNumber=nodes[i]))
        )
    rotation = exu.OutputVariableType.Rotation
    sensors = [
        mbs.AddSensor(
            Item.SensorNode(
                nodeNumber=node, storeInternal=True, writeToFile=False, outputVariableType=rotation
            )
        )
        for node in nodes
    ]
    for i in range(chain.links - 1):
        rest = chain.length[i] - chain.arm[i]
        ends = [
            mbs.AddMarker(Item.MarkerBodyPosition(bodyNumber=bodies[i], localPosition=[0, -rest, 0])),
            mbs.AddMarker(
                Item.MarkerBodyPosition(bodyNumber=bodies[i + 1], localPosition=[0, chain.arm[i + 1], 0])
            ),
        ]
        mbs.AddObject(Item.ObjectJointRevolute2D(markerNumbers=ends))
        turns = [
            mbs.AddMarker(Item.MarkerNodeCoordinate(nodeNumber=nodes[k], coordinate=2)) for k in (i, i + 1)
        ]
        mbs.AddObject(
            Item.CoordinateSpringDamper(
                markerNumbers=turns, stiffness=chain.stiffness[i], damping=chain.damping[i]
            )
        )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(UNTIL / step)
    settings.timeIntegration.endTime = UNTIL
    settings.timeIntegration.generalizedAlpha.spectralRadius = 1.0
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = EVERY
    begun = time.process_time()
    mbs.SolveDynamic(settings)
    seconds = time.process_time() - begun
    angles = np.stack([mbs.GetSensorStoredData(s)[:, -1] for s in sensors], axis=1)
    return np.diff(angles, axis=1) * chain.stiffness, seconds
