"""The whole pendulum test a second time: minimal coordinates, scipy's integrator, force laws written anew.

Exudyn integrates the same forces with its own bodies and joints in `pendulum_in_exudyn`. Only the legform's
and the rig's documents and the masses of the segments are shared with `certkit.mechanics`. Without friction
in the knee, whose memory of stick and slip is no function of the state.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.integrate import solve_ivp

from certkit.mechanics.legform.segments import leg_segments

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure

GRAVITY = 9.81
STRIPS = 60
Vector = np.ndarray


@dataclass(frozen=True)
class Pose:
    """Places, angles and their rates of segments (n, 3), and of flesh (n, 2)."""

    bone: Vector
    bone_rate: Vector
    flesh: Vector
    flesh_rate: Vector


class Pendulum:
    """The leg on its hinge, upright at first contact, and all forces on it."""

    def __init__(self, legform: Legform, procedure: Procedure) -> None:
        rig = procedure.rig
        self.legform = legform
        segments = leg_segments(legform)
        segments[0] = segments[0].with_mass(rig.added_mass.mass, segments[0].top + rig.added_mass.offset)
        self.segments = segments
        self.n = len(segments)
        self.mass = np.array([s.mass for s in segments])
        self.inertia = np.array([s.inertia for s in segments])
        self.centre = np.array([s.centre for s in segments])
        self.top = np.array([s.top for s in segments]) - self.centre
        self.bottom = np.array([s.bottom for s in segments]) - self.centre
        self.hinge = segments[-1].bottom - rig.hinge.offset
        length = self.top - self.bottom
        self.flesh_mass = legform.flesh.mass * length / length.sum()
        self.flesh_height = (self.top + self.bottom) / 2
        self.gap = -np.diff(self.centre + self.flesh_height)
        self.upper = next(i for i, s in enumerate(segments) if s.part == "knee")
        self.stiffness, self.damping = self._joints()
        stopper = rig.stopper
        edge = -stopper.below_knee_centre + stopper.height / 2
        self.band = edge - (np.arange(STRIPS) + 0.5) * stopper.height / STRIPS
        self.strip = stopper.height / STRIPS
        self.off = np.array([s.depth / 2 for s in segments]) + legform.flesh.thickness
        self.face = max(
            off
            for off, s in zip(self.off, segments, strict=True)
            if s.bottom < edge and s.top > edge - stopper.height
        )
        arm = self.mass @ (self.centre - self.hinge) + self.flesh_mass @ (
            self.centre + self.flesh_height - self.hinge
        )
        about = (
            self.inertia.sum()
            + self.mass @ (self.centre - self.hinge) ** 2
            + self.flesh_mass @ (self.centre + self.flesh_height - self.hinge) ** 2
        )
        fall = GRAVITY * arm * (1 + math.sin(rig.release.angle))
        self.rate = -math.sqrt(2 * fall / about)
        self.knee = self._knee_forces_at_rest()

    def _joints(self) -> tuple[Vector, Vector]:
        stiffness, damping = np.zeros(self.n - 1), np.zeros(self.n - 1)
        for i, (a, b) in enumerate(pairwise(self.segments)):
            if a.part == b.part == "knee":
                stiffness[i] = self.legform.knee.parallel_stiffness
                continue
            bone = self.legform.parts[b.part if a.part == "knee" else a.part]
            stiffness[i] = bone.bending_stiffness * bone.segments / bone.length
            stiffness[i] *= 1.0 if a.part == b.part else bone.block_joint
            damping[i] = bone.damping_time * stiffness[i]
        return stiffness, damping

    def _knee_forces_at_rest(self) -> Vector:
        """Return the normal forces of both condyles under the ligaments' preloads."""
        down = moment = 0.0
        for ligament in self.legform.knee.ligaments.values():
            f, t = np.array(ligament.femur, float), np.array(ligament.tibia, float)
            pull = ligament.preload * (t - f) / np.linalg.norm(t - f)
            down -= pull[1]
            moment += f[0] * pull[1] - f[1] * pull[0]
        offset = self.legform.knee.condyles.offset
        return np.array([(down + moment / offset) / 2, (down - moment / offset) / 2])

    def forces(self, p: Pose) -> tuple[Vector, Vector]:
        """Return forces and torque on the segments, shape (n, 3), and forces on the flesh, shape (n, 2)."""
        on_bone, on_flesh = np.zeros((self.n, 3)), np.zeros((self.n, 2))
        on_bone[:, 1] += GRAVITY * self.mass
        on_flesh[:, 1] += GRAVITY * self.flesh_mass
        moment = self.stiffness * np.diff(p.bone[:, 2]) + self.damping * np.diff(p.bone_rate[:, 2])
        on_bone[:-1, 2] += moment
        on_bone[1:, 2] -= moment
        self._hold_knee(p, on_bone)
        self._hang_flesh(p, on_bone, on_flesh)
        self._stop(p, on_bone)
        return on_bone, on_flesh

    def _point(self, p: Pose, body: int, local: tuple[float, float]) -> tuple[Vector, Vector, Vector]:
        """Return place, velocity and lever of a segment's point given from the knee centre."""
        c, s = math.cos(p.bone[body, 2]), math.sin(p.bone[body, 2])
        x, z = local[0], local[1] - self.centre[body]
        lever = np.array([c * x - s * z, s * x + c * z])
        turn = p.bone_rate[body, 2] * np.array([-lever[1], lever[0]])
        return p.bone[body, :2] + lever, p.bone_rate[body, :2] + turn, lever

    def elongation(self, p: Pose, name: str) -> float:
        ligament = self.legform.knee.ligaments[name]
        ends = [self._point(p, self.upper + k, e)[0] for k, e in enumerate((ligament.femur, ligament.tibia))]
        rest = math.dist(ligament.femur, ligament.tibia)
        return math.dist(*ends) - rest

    def _pair(self, on_bone: Vector, levers: tuple[Vector, Vector], force: Vector) -> None:
        """Add a force on the femur block and its reaction on the tibia block."""
        for body, lever, f in zip((self.upper, self.upper + 1), levers, (force, -force), strict=True):
            on_bone[body, :2] += f
            on_bone[body, 2] += lever[0] * f[1] - lever[1] * f[0]

    def _hold_knee(self, p: Pose, on_bone: Vector) -> None:
        knee = self.legform.knee
        for name, ligament in knee.ligaments.items():
            a, va, la = self._point(p, self.upper, ligament.femur)
            b, vb, lb = self._point(p, self.upper + 1, ligament.tibia)
            along = (b - a) / np.linalg.norm(b - a)
            elastic = max(ligament.preload + ligament.stiffness * self.elongation(p, name), 0.0)
            rate = float((vb - va) @ along)
            tension = max(elastic + ligament.damping * rate, 0.0) if elastic > 0 else 0.0
            self._pair(on_bone, (la, lb), tension * along)
        c = knee.condyles
        for side, rest in zip((-1, 1), self.knee, strict=True):
            high = c.trough_radius + max(rest, 0.0) / c.stiffness
            a, va, la = self._point(p, self.upper, (side * c.offset, c.radius))
            b, vb, lb = self._point(p, self.upper + 1, (side * c.offset, high))
            apart = float(np.linalg.norm(a - b))
            normal = (a - b) / apart
            depth = apart - (c.trough_radius - c.radius)
            if depth > 0:
                # Without friction the force goes through both middles.
                force = max(c.stiffness * depth + c.damping * float((va - vb) @ normal), 0.0)
                self._pair(on_bone, (la, lb), -force * normal)

    def _hang_flesh(self, p: Pose, on_bone: Vector, on_flesh: Vector) -> None:
        flesh = self.legform.flesh
        c, s = np.cos(p.bone[:, 2]), np.sin(p.bone[:, 2])
        d, v = p.flesh - p.bone[:, :2], p.flesh_rate - p.bone_rate[:, :2]
        w = p.bone_rate[:, 2]
        local = np.stack([c * d[:, 0] + s * d[:, 1], c * d[:, 1] - s * d[:, 0]], axis=1)
        rate = np.stack([c * v[:, 0] + s * v[:, 1], c * v[:, 1] - s * v[:, 0]], axis=1)
        rate += np.stack([w * local[:, 1], -w * local[:, 0]], axis=1)
        omega = 2 * math.pi * np.array([flesh.across, flesh.along], dtype=float)
        shift = local - np.stack([np.zeros(self.n), self.flesh_height], axis=1)
        force = self.flesh_mass[:, None] * (omega**2 * shift + 2 * flesh.damping_ratio * omega * rate)
        out = np.stack([c * force[:, 0] - s * force[:, 1], s * force[:, 0] + c * force[:, 1]], axis=1)
        on_bone[:, :2] += out
        on_bone[:, 2] += local[:, 0] * force[:, 1] - local[:, 1] * force[:, 0]
        on_flesh -= out
        chord = p.flesh[1:] - p.flesh[:-1]
        length = np.linalg.norm(chord, axis=1)
        tension = np.clip(flesh.tension * (length / self.gap - 1), 0, None)
        pull = (tension / length)[:, None] * chord
        on_flesh[:-1] += pull
        on_flesh[1:] -= pull

    def _stop(self, p: Pose, on_bone: Vector) -> None:
        flesh = self.legform.flesh
        c, t = np.cos(p.bone[:, 2]), np.tan(p.bone[:, 2])
        low = p.bone[:, 1] + self.bottom * c
        row = (self.band[:, None] < low).sum(axis=1)
        lever = self.band - p.bone[row, 1]
        depth = p.bone[row, 0] - lever * t[row] + self.off[row] / c[row] - self.face
        press = flesh.compression * self.strip * depth * (1 + (depth / flesh.thickness) ** 2)
        press = np.where(depth > 0, press, 0.0)
        np.add.at(on_bone, (row, 0), -press)
        np.add.at(on_bone, (row, 1), -press * t[row])
        np.add.at(on_bone, (row, 2), -press * (self.off[row] / c[row] * t[row] - lever / c[row] ** 2))

    def moment(self, p: Pose, height: float) -> float:
        """Return the bending moment at a height, by linear interpolation between joints."""
        heights = np.array([s.bottom for s in self.segments[:-1]])
        moments = self.stiffness * np.diff(p.bone[:, 2]) + self.damping * np.diff(p.bone_rate[:, 2])
        bone = np.delete(np.arange(self.n - 1), self.upper)
        return float(np.interp(height, heights[bone][::-1], moments[bone][::-1]))


@dataclass(frozen=True)
class Branch:
    """A chain of segments from a base point upwards (+1) or downwards (-1): one angle a segment."""

    bodies: Vector
    length: Vector
    arm: Vector
    sign: int

    def move(self, base: Vector, speed: Vector, q: Vector, w: Vector) -> tuple[Vector, ...]:
        """Return places and speeds (n, 2), Jacobian by angles (n, 2, n), acceleration by turning alone."""
        along = np.stack([-np.sin(q), np.cos(q)], axis=1) * self.sign
        across = np.stack([-np.cos(q), -np.sin(q)], axis=1) * self.sign
        reach = np.tril(np.tile(self.length, (len(q), 1)), -1) + np.diag(self.arm)
        jacobian = np.einsum("ij,jc->icj", reach, across)
        return base + reach @ along, speed + jacobian @ w, jacobian, -reach @ (along * w[:, None] ** 2)


def solve(pendulum: Pendulum, times: Vector) -> list[Pose]:
    """Integrate the pendulum in minimal coordinates; return its poses at the times.

    Coordinates: angles of tibia and tibia block from the hinge up; place of the lower end of the femur
    block, angles of femur block and femur from there up; places of the flesh.
    """
    n, k = pendulum.n, pendulum.upper + 1
    length = pendulum.top - pendulum.bottom
    low = np.arange(n - 1, k - 1, -1)
    high = np.arange(k - 1, -1, -1)
    tibia = Branch(low, length[low].copy(), -pendulum.bottom[low], 1)
    below = pendulum.segments[-1].bottom - pendulum.hinge
    tibia.length[0] += below
    tibia.arm[0] += below
    femur = Branch(high, length[high], -pendulum.bottom[high], 1)
    a, b = len(low), len(high)
    size = a + 2 + b
    total = size + 2 * n

    def unfold(y: Vector) -> tuple[Pose, Vector, Vector]:
        """Return pose, Jacobian of the segments' places (n, 2, size), their acceleration by turning."""
        q, v = y[:total], y[total:]
        bone, rate = np.zeros((n, 3)), np.zeros((n, 3))
        jacobian, bias = np.zeros((n, 2, size)), np.zeros((n, 2))
        hinge = np.array([0.0, pendulum.hinge])
        parts = (
            (tibia, hinge, np.zeros(2), slice(0, a)),
            (femur, q[a : a + 2], v[a : a + 2], slice(a + 2, size)),
        )
        for branch, base, speed, angles in parts:
            at = branch.bodies
            place, velocity, slope, turning = branch.move(base, speed, q[angles], v[angles])
            bone[at, :2], rate[at, :2], bias[at] = place, velocity, turning
            bone[at, 2], rate[at, 2] = q[angles], v[angles]
            jacobian[at, :, angles] = slope
        jacobian[high, 0, a] = jacobian[high, 1, a + 1] = 1.0
        return Pose(bone, rate, q[size:].reshape(n, 2), v[size:].reshape(n, 2)), jacobian, bias

    angle_of = np.zeros(n, dtype=int)
    angle_of[low] = np.arange(a)
    angle_of[high] = a + 2 + np.arange(b)

    def slope(_t: float, y: Vector) -> Vector:
        p, jacobian, bias = unfold(y)
        on_bone, on_flesh = pendulum.forces(p)
        matrix = np.einsum("i,icj,ick->jk", pendulum.mass, jacobian, jacobian, optimize=True)
        matrix[angle_of, angle_of] += pendulum.inertia
        force = np.einsum("icj,ic->j", jacobian, on_bone[:, :2] - pendulum.mass[:, None] * bias)
        force[angle_of] += on_bone[:, 2]
        flesh = on_flesh / pendulum.flesh_mass[:, None]
        return np.concatenate([y[total:], np.linalg.solve(matrix, force), flesh.ravel()])

    start, speed = np.zeros(total), np.zeros(total)
    flesh_height = pendulum.centre + pendulum.flesh_height
    start[a + 1] = pendulum.segments[pendulum.upper].bottom
    start[size + 1 :: 2] = flesh_height
    speed[angle_of] = pendulum.rate
    speed[a] = -pendulum.rate * (start[a + 1] - pendulum.hinge)
    speed[size::2] = -pendulum.rate * (flesh_height - pendulum.hinge)
    solution = solve_ivp(
        slope,
        (times[0], times[-1]),
        np.concatenate([start, speed]),
        method="DOP853",
        t_eval=times,
        rtol=1e-6,
        atol=1e-8,
        max_step=2e-4,
    )
    assert solution.success
    return [unfold(y)[0] for y in solution.y.T]
