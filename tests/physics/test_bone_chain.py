"""The bone chain against scipy in minimal coordinates and against Exudyn, an independent multibody code."""

from __future__ import annotations

import numpy as np
import pytest
from support.chain_oracle import Chain, bone_chain

from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.solver.time_loop import Plan, run_world

UNTIL = 0.03


def swing(chain: Chain) -> tuple[np.ndarray, np.ndarray]:
    """Return a straight chain that bends itself hard and turns as well."""
    n = chain.links
    q, v = np.zeros(n + 2), np.zeros(n + 2)
    height = np.arange(n) / (n - 1)
    v[2:] = 25.0 * np.sin(2 * np.pi * height) + 6.0
    v[0] = 2.0
    return q, v


def moments(chain: Chain, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Return sample times and the elastic joint moments of the solver, shape (t, n - 1)."""
    world = chain.world(*swing(chain))
    joints = range(chain.links - 1)
    every = round(1e-4 / step)
    run = run_world(
        world, Plan(step, UNTIL, UNTIL, sample=every), [world.place(JointSpring, i, "angle") for i in joints]
    )
    return run.time, run.readings * chain.stiffness


def worst_of_peak(found: np.ndarray, true: np.ndarray) -> tuple[float, float]:
    """Return the worst peak and the worst rms error over all joints, in per cent of the joint's peak."""
    peak = np.abs(true).max(axis=0)
    peaks = np.abs(np.abs(found).max(axis=0) - peak) / peak
    rms = np.sqrt(((found - true) ** 2).mean(axis=0)) / peak
    return 100 * float(peaks.max()), 100 * float(rms.max())


@pytest.fixture(scope="module")
def exact() -> np.ndarray:
    chain = bone_chain()
    q = chain.integrate(*swing(chain), np.arange(0, round(UNTIL / 1e-4) + 1) * 1e-4)
    return np.diff(q[:, 2:], axis=1) * chain.stiffness


def test_bone_chain_follows_minimal_coordinates_within_0_05_per_cent(exact: np.ndarray):
    _, found = moments(bone_chain(), 1e-5)
    peak, rms = worst_of_peak(found, exact)
    assert peak < 0.05
    assert rms < 0.05


def test_halving_the_step_quarters_the_error(exact: np.ndarray):
    errors = [worst_of_peak(moments(bone_chain(), step)[1], exact)[1] for step in (5e-5, 2.5e-5, 1.25e-5)]
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.all(orders > 1.8), (errors, orders)


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # Exudyn renames its settings now and then
def test_bone_chain_agrees_with_exudyn_within_half_a_per_cent():
    pytest.importorskip("exudyn")
    chain = bone_chain()
    theirs = in_exudyn(chain)
    _, ours = moments(chain, 2e-5)
    peak, rms = worst_of_peak(ours, theirs)
    assert peak < 0.5
    assert rms < 0.5


def in_exudyn(chain: Chain) -> np.ndarray:
    """Return the elastic joint moments that Exudyn finds, shape (t, n - 1), every 0.1 ms."""
    import exudyn as exu  # noqa: PLC0415  # skipped where it is not installed
    from exudyn.itemInterface import (  # noqa: PLC0415  # likewise
        CoordinateSpringDamper,
        MarkerBodyPosition,
        MarkerNodeCoordinate,
        NodeRigidBody2D,
        ObjectJointRevolute2D,
        RigidBody2D,
        SensorNode,
    )

    q, v = swing(chain)
    centres, jacobian = chain.centres(q)
    speeds = jacobian @ v
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    bodies, sensors = [], []
    for i in range(chain.links):
        node = mbs.AddNode(
            NodeRigidBody2D(
                referenceCoordinates=[*centres[i], q[2 + i]],
                initialVelocities=[*speeds[i], v[2 + i]],
            )
        )
        body = mbs.AddObject(RigidBody2D(mass=chain.mass[i], inertia=chain.inertia[i], nodeNumber=node))
        bodies.append((node, body))
        sensors.append(
            mbs.AddSensor(
                SensorNode(
                    nodeNumber=node,
                    storeInternal=True,
                    writeToFile=False,
                    outputVariableType=exu.OutputVariableType.Rotation,
                )
            )
        )
    for i in range(chain.links - 1):
        rest = chain.length[i] - chain.arm[i]
        ends = [
            mbs.AddMarker(MarkerBodyPosition(bodyNumber=bodies[i][1], localPosition=[0, -rest, 0])),
            mbs.AddMarker(
                MarkerBodyPosition(bodyNumber=bodies[i + 1][1], localPosition=[0, chain.arm[i + 1], 0])
            ),
        ]
        mbs.AddObject(ObjectJointRevolute2D(markerNumbers=ends))
        turns = [
            mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=bodies[k][0], coordinate=2)) for k in (i, i + 1)
        ]
        mbs.AddObject(
            CoordinateSpringDamper(
                markerNumbers=turns, stiffness=chain.stiffness[i], damping=chain.damping[i]
            )
        )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(UNTIL / 1e-5)
    settings.timeIntegration.endTime = UNTIL
    settings.timeIntegration.generalizedAlpha.spectralRadius = 1.0
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = 1e-4
    mbs.SolveDynamic(settings)
    angles = np.stack([mbs.GetSensorStoredData(s)[:, -1] for s in sensors], axis=1)
    return np.diff(angles, axis=1) * chain.stiffness
