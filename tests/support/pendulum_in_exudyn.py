"""The pendulum of `pendulum_oracle` with Exudyn's bodies, joints and integrator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import exudyn as exu
import numpy as np
from exudyn import itemInterface as items  # noqa: N813  # the module has that name

from support.leg_oracle import Pose
from support.pendulum_oracle import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

Vector = np.ndarray


def solve_in_exudyn(pendulum: Pendulum, until: float, step: float, sample: float) -> list[Pose]:
    """Return the pendulum's poses every `sample` seconds."""
    mbs = exu.SystemContainer().AddSystem()
    n, hinge = pendulum.n, pendulum.hinge
    heights = np.concatenate([pendulum.centre, pendulum.centre + pendulum.flesh_height])
    nodes, bodies = add_bodies(mbs, pendulum, heights)

    def marker(body: Any, z: float) -> Any:  # noqa: ANN401  # Exudyn's indices
        return mbs.AddMarker(items.MarkerBodyPosition(bodyNumber=body, localPosition=[0.0, z, 0.0]))

    for i in range(n - 1):
        if i != pendulum.upper:
            ends = [marker(bodies[i], pendulum.bottom[i]), marker(bodies[i + 1], pendulum.top[i + 1])]
            mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=ends))
    ground = mbs.AddObject(items.ObjectGround())
    ends = [marker(bodies[-1], hinge - pendulum.centre[-1]), marker(ground, hinge)]
    mbs.AddObject(items.ObjectJointRevolute2D(markerNumbers=ends))

    def pose(q: Vector, rates: Vector) -> Pose:
        q, rates = np.array(q), np.array(rates)
        bone, flesh = q[: 3 * n].reshape(n, 3), q[3 * n :].reshape(n, 2)
        bone[:, 1] += heights[:n]
        flesh[:, 1] += heights[n:]
        return Pose(bone, rates[: 3 * n].reshape(n, 3), flesh, rates[3 * n :].reshape(n, 2))

    def resistance(q: Vector, rates: Vector) -> Vector:
        """Return the forces as they stand on the left of the equation of motion."""
        on_bone, on_flesh = pendulum.forces(pose(q, rates))
        return -np.concatenate([on_bone.ravel(), on_flesh.ravel()])

    size = 5 * n
    zero = np.zeros(size)
    constant = [slopes(resistance, zero, zero, range(size), by_rate=by) for by in (False, True)]
    # Contacts and ligaments change the slopes of the knee's blocks and of the segment below them alone.
    changing = range(3 * pendulum.upper, 3 * (pendulum.upper + 3))

    def jacobian(_m: Any, _t: float, _i: int, q: Any, rates: Any, by_q: float, by_rate: float) -> Vector:  # noqa: ANN401  # Exudyn's signature
        q, rates = np.array(q), np.array(rates)
        parts = []
        for base, by in zip(constant, (False, True), strict=True):
            part = base.copy()
            part[:, changing] = slopes(resistance, q, rates, changing, by_rate=by)
            parts.append(part)
        return by_q * parts[0] + by_rate * parts[1]

    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=nodes,
            massMatrix=np.zeros((size, size)),
            forceUserFunction=lambda _m, _t, _i, q, rates: -resistance(q, rates),
            jacobianUserFunction=jacobian,
        )
    )
    kinds = (exu.OutputVariableType.Coordinates, exu.OutputVariableType.Coordinates_t)
    sensors = [[watch(mbs, node, kind) for node in nodes] for kind in kinds]
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(until / step)
    settings.timeIntegration.endTime = until
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.timeIntegration.newton.modifiedNewtonJacUpdatePerStep = True
    settings.timeIntegration.newton.maxIterations = 60
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = sample
    mbs.SolveDynamic(settings)
    stored = [np.concatenate([mbs.GetSensorStoredData(s)[:, 1:] for s in kind], axis=1) for kind in sensors]
    return [pose(q, rates) for q, rates in zip(*stored, strict=True)]


def slopes(
    function: Callable[[Vector, Vector], Vector], q: Vector, rates: Vector, columns: range, *, by_rate: bool
) -> Vector:
    """Return columns of the function's derivative by coordinates or by rates, by central differences."""
    width = 1e-6 if by_rate else 1e-8
    found = []
    for j in columns:
        ends = []
        for side in (width, -width):
            moved = [q.copy(), rates.copy()]
            moved[by_rate][j] += side
            ends.append(function(*moved))
        found.append((ends[0] - ends[1]) / (2 * width))
    return np.stack(found, axis=1)


def watch(mbs: Any, node: Any, kind: Any) -> Any:  # noqa: ANN401  # Exudyn's indices
    """Add a sensor that keeps a node's coordinates."""
    return mbs.AddSensor(
        items.SensorNode(nodeNumber=node, storeInternal=True, writeToFile=False, outputVariableType=kind)
    )


def add_bodies(mbs: Any, pendulum: Pendulum, heights: Vector) -> tuple[list[Any], list[Any]]:  # noqa: ANN401  # likewise
    """Add segments and flesh, turning about the hinge; return all nodes and the segments' bodies."""
    nodes, bodies = [], []
    for i, height in enumerate(heights.tolist()):
        speed = [-pendulum.rate * (height - pendulum.hinge), 0.0]
        k = i - pendulum.n
        if k < 0:
            start = {"referenceCoordinates": [0.0, height, 0.0], "initialVelocities": [*speed, pendulum.rate]}
            nodes.append(mbs.AddNode(items.NodeRigidBody2D(**start)))
            about = {"mass": pendulum.mass[i], "inertia": pendulum.inertia[i], "nodeNumber": nodes[-1]}
            bodies.append(mbs.AddObject(items.ObjectRigidBody2D(**about)))
        else:
            start = {"referenceCoordinates": [0.0, height], "initialVelocities": speed}
            nodes.append(mbs.AddNode(items.NodePoint2D(**start)))
            mbs.AddObject(items.ObjectMassPoint2D(mass=pendulum.flesh_mass[k], nodeNumber=nodes[-1]))
    return nodes, bodies
