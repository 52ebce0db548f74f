"""The leg a second time: minimal coordinates, a Runge-Kutta integrator, force laws written anew.

Only the documents of legform and rig and the masses of the segments are shared with `certkit.mechanics`. What
a law remembers (stick and slip in the knee, crushed honeycomb) is brought up to date after each step; within
a step it is guessed from the speed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from certkit.mechanics.legform.segments import leg_segments

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure
    from certkit.mechanics.legform.segments import Segment

GRAVITY = 9.81
STRIP = 0.004  # m: obstacles are cut as the model cuts them, whose strips are part of it
REVERSAL = 1.0  # m/s, of the flesh's internal friction
TANGENTIAL = 0.5  # of the condyles' normal stiffness
Vector = np.ndarray


@dataclass(frozen=True)
class Pose:
    """Places, angles and their rates of segments (n, 3), of flesh (n, 2) or of a ram (1, 2)."""

    bone: Vector
    bone_rate: Vector
    flesh: Vector
    flesh_rate: Vector


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


class LegOracle:
    """A leg pinned at one end, and all forces inside it.

    Subclasses set `pin` (height), `pinned` and `free` (branches), `extra_mass` of what moves besides the
    segments, and add their own forces in `outer`.
    """

    pin: float
    pinned: Branch
    free: Branch
    extra_mass: Vector
    gravity: float

    def __init__(self, legform: Legform, segments: list[Segment]) -> None:
        self.legform = legform
        self.segments = segments
        self.n = len(segments)
        self.mass = np.array([s.mass for s in segments])
        self.inertia = np.array([s.inertia for s in segments])
        self.centre = np.array([s.centre for s in segments])
        self.top = np.array([s.top for s in segments]) - self.centre
        self.bottom = np.array([s.bottom for s in segments]) - self.centre
        self.upper = next(i for i, s in enumerate(segments) if s.part == "knee")
        self.stiffness, self.damping = self._joints()
        self.rest = self._knee_forces_at_rest()
        self.slip = self._slip_at_rest()

    def branches(self, pin: float, *, upwards: bool) -> tuple[Branch, Branch]:
        """Return the chain from the pin to the knee, and the one beyond that begins at the other block."""
        length, k = self.top - self.bottom, self.upper + 1
        if upwards:
            near, far = np.arange(self.n - 1, k - 1, -1), np.arange(k - 1, -1, -1)
            arm, gap, sign = -self.bottom, self.segments[-1].bottom - pin, 1
        else:
            near, far = np.arange(k), np.arange(k, self.n)
            arm, gap, sign = self.top, pin - self.segments[0].top, -1
        reach, centre = length[near].copy(), arm[near].copy()
        reach[0] += gap
        centre[0] += gap
        return Branch(near, reach, centre, sign), Branch(far, length[far], arm[far], sign)

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

    def _pulls(self) -> list[tuple[Vector, Vector]]:
        """Return where each ligament pulls on the femur block, and its preload there."""
        found = []
        for ligament in self.legform.knee.ligaments.values():
            f, t = np.array(ligament.femur, float), np.array(ligament.tibia, float)
            found.append((f, ligament.preload * (t - f) / np.linalg.norm(t - f)))
        return found

    def _knee_forces_at_rest(self) -> Vector:
        """Return the normal forces of both condyles under the ligaments' preloads."""
        down = -sum(pull[1] for _, pull in self._pulls())
        moment = sum(f[0] * pull[1] - f[1] * pull[0] for f, pull in self._pulls())
        offset = self.legform.knee.condyles.offset
        return np.array([(down + moment / offset) / 2, (down - moment / offset) / 2])

    def _slip_at_rest(self) -> Vector:
        """Return the springs of stick and slip that hold the preloads' pull across the knee."""
        condyles = self.legform.knee.condyles
        across = sum(pull[0] for _, pull in self._pulls())
        held = across * self.rest / self.rest.sum()
        bound = condyles.friction * self.rest
        return np.clip(held, -bound, bound) / (TANGENTIAL * condyles.stiffness)

    def forces(self, p: Pose, ahead: float = 0.0) -> tuple[Vector, Vector]:
        """Return forces and torque on the segments (n, 3), and on what else moves, `ahead` s into a step."""
        on_bone, on_extra = np.zeros((self.n, 3)), np.zeros((len(self.extra_mass), 2))
        on_bone[:, 1] += self.gravity * self.mass
        moment = self.stiffness * np.diff(p.bone[:, 2]) + self.damping * np.diff(p.bone_rate[:, 2])
        on_bone[:-1, 2] += moment
        on_bone[1:, 2] -= moment
        self._hold_knee(p, on_bone, ahead)
        self.outer(p, on_bone, on_extra, ahead)
        return on_bone, on_extra

    def outer(self, p: Pose, on_bone: Vector, on_extra: Vector, ahead: float) -> None:
        """Add the forces from outside the bare leg."""
        raise NotImplementedError

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
        return math.dist(*ends) - math.dist(ligament.femur, ligament.tibia)

    def _pair(self, on_bone: Vector, levers: tuple[Vector, Vector], force: Vector) -> None:
        """Add a force on the femur block and its reaction on the tibia block."""
        for body, lever, f in zip((self.upper, self.upper + 1), levers, (force, -force), strict=True):
            on_bone[body, :2] += f
            on_bone[body, 2] += lever[0] * f[1] - lever[1] * f[0]

    def _hold_knee(self, p: Pose, on_bone: Vector, ahead: float) -> None:
        for name, ligament in self.legform.knee.ligaments.items():
            a, va, la = self._point(p, self.upper, ligament.femur)
            b, vb, lb = self._point(p, self.upper + 1, ligament.tibia)
            along = (b - a) / np.linalg.norm(b - a)
            elastic = max(ligament.preload + ligament.stiffness * self.elongation(p, name), 0.0)
            rate = float((vb - va) @ along)
            tension = max(elastic + ligament.damping * rate, 0.0) if elastic > 0 else 0.0
            self._pair(on_bone, (la, lb), tension * along)
        c = self.legform.knee.condyles
        for side, touch in enumerate(self._touches(p)):
            if touch is None:
                continue
            normal, force, levers, sliding = touch
            spring = self._held(side, force, sliding * ahead)
            tangent = np.array([-normal[1], normal[0]])
            push = -force * normal - TANGENTIAL * c.stiffness * spring * tangent
            self._pair(on_bone, levers, push)

    def _held(self, side: int, force: float, slid: float) -> float:
        """Return a spring of stick and slip after the contact has slid on."""
        c = self.legform.knee.condyles
        bound = c.friction * force / (TANGENTIAL * c.stiffness)
        return min(max(self.slip[side] + slid, -bound), bound)

    def _touches(self, p: Pose) -> list[tuple[Vector, float, tuple[Vector, Vector], float] | None]:
        """Return normal, normal force, levers and sliding speed of each condyle; None where it is lifted."""
        c = self.legform.knee.condyles
        found: list[tuple[Vector, float, tuple[Vector, Vector], float] | None] = []
        for side, rest in zip((-1, 1), self.rest, strict=True):
            high = c.trough_radius + max(rest, 0.0) / c.stiffness
            a, va, la = self._point(p, self.upper, (side * c.offset, c.radius))
            b, vb, lb = self._point(p, self.upper + 1, (side * c.offset, high))
            apart = float(np.linalg.norm(a - b))
            normal = (a - b) / apart
            depth = apart - (c.trough_radius - c.radius)
            if depth <= 0:
                found.append(None)
                continue
            # The contact lies on the condyle, a radius beyond its middle.
            on_a, on_b = c.radius * normal, (a - b) + c.radius * normal
            wa, wb = p.bone_rate[self.upper, 2], p.bone_rate[self.upper + 1, 2]
            apace = va + wa * np.array([-on_a[1], on_a[0]]) - vb - wb * np.array([-on_b[1], on_b[0]])
            force = max(c.stiffness * depth + c.damping * float(apace @ normal), 0.0)
            sliding = float(apace @ np.array([-normal[1], normal[0]]))
            found.append((normal, force, (la + on_a, lb + on_b), sliding))
        return found

    def remember(self, before: Pose, after: Pose, step: float) -> None:
        """Bring what the laws remember up to date after a step."""
        earlier, later = self._touches(before), self._touches(after)
        for side in range(2):
            now = later[side]
            if now is None:
                self.slip[side] = 0.0
                continue
            first = earlier[side]
            mean = now[3] if first is None else (first[3] + now[3]) / 2
            self.slip[side] = self._held(side, now[1], mean * step)

    def moment(self, p: Pose, height: float) -> float:
        """Return the bending moment at a height, by linear interpolation between joints."""
        heights = np.array([s.bottom for s in self.segments[:-1]])
        moments = self.stiffness * np.diff(p.bone[:, 2]) + self.damping * np.diff(p.bone_rate[:, 2])
        bone = np.delete(np.arange(self.n - 1), self.upper)
        return float(np.interp(height, heights[bone][::-1], moments[bone][::-1]))

    # Coordinates: angles from the pin to the knee; place of the other block's near end; angles from there on;
    # places of what else moves.
    def unfold(self, y: Vector) -> tuple[Pose, Vector, Vector]:
        """Return pose, Jacobian of the segments' places (n, 2, size), their acceleration by turning."""
        a, b, extra = len(self.pinned.bodies), len(self.free.bodies), len(self.extra_mass)
        size = a + 2 + b
        total = size + 2 * extra
        q, v = y[:total], y[total:]
        bone, rate = np.zeros((self.n, 3)), np.zeros((self.n, 3))
        jacobian, bias = np.zeros((self.n, 2, size)), np.zeros((self.n, 2))
        parts = (
            (self.pinned, np.array([0.0, self.pin]), np.zeros(2), slice(0, a)),
            (self.free, q[a : a + 2], v[a : a + 2], slice(a + 2, size)),
        )
        for branch, base, speed, angles in parts:
            at = branch.bodies
            place, velocity, slope, turning = branch.move(base, speed, q[angles], v[angles])
            bone[at, :2], rate[at, :2], bias[at] = place, velocity, turning
            bone[at, 2], rate[at, 2] = q[angles], v[angles]
            jacobian[at, :, angles] = slope
        jacobian[self.free.bodies, 0, a] = jacobian[self.free.bodies, 1, a + 1] = 1.0
        moving = q[size:].reshape(extra, 2), v[size:].reshape(extra, 2)
        return Pose(bone, rate, *moving), jacobian, bias

    def slope(self, y: Vector, ahead: float) -> Vector:
        """Return the derivative of coordinates and rates."""
        p, jacobian, bias = self.unfold(y)
        on_bone, on_extra = self.forces(p, ahead)
        matrix = np.einsum("i,icj,ick->jk", self.mass, jacobian, jacobian, optimize=True)
        a = len(self.pinned.bodies)
        angle_of = np.zeros(self.n, dtype=int)
        angle_of[self.pinned.bodies] = np.arange(a)
        angle_of[self.free.bodies] = a + 2 + np.arange(len(self.free.bodies))
        matrix[angle_of, angle_of] += self.inertia
        force = np.einsum("icj,ic->j", jacobian, on_bone[:, :2] - self.mass[:, None] * bias)
        force[angle_of] += on_bone[:, 2]
        extra = on_extra / self.extra_mass[:, None]
        return np.concatenate([y[len(y) // 2 :], np.linalg.solve(matrix, force), extra.ravel()])

    def start(self) -> Vector:
        """Return coordinates and rates at first contact."""
        raise NotImplementedError

    def march(self, until: float, step: float, stride: int) -> tuple[Vector, list[Pose]]:
        """Integrate by the classical Runge-Kutta method; return times and poses of every `stride`-th step."""
        y, poses, times = self.start(), [], []
        now = self.unfold(y)[0]
        for k in range(round(until / step) + 1):
            if k % stride == 0:
                poses.append(now)
                times.append(k * step)
            k1 = self.slope(y, 0.0)
            k2 = self.slope(y + step / 2 * k1, step / 2)
            k3 = self.slope(y + step / 2 * k2, step / 2)
            k4 = self.slope(y + step * k3, step)
            y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            before, now = now, self.unfold(y)[0]
            self.remember(before, now, step)
        return np.array(times), poses

    def channels(self, poses: list[Pose]) -> dict[str, Vector]:
        """Return the gauges' and ligaments' histories."""
        known = self.legform.channels.items()
        heights = {n: self.legform.gauge_height(c) for n, c in known if c.measures == "bending moment"}
        found = {name: np.array([self.moment(p, height) for p in poses]) for name, height in heights.items()}
        return found | {
            name: np.array([self.elongation(p, name) for p in poses]) for name in ("MCL", "ACL", "PCL")
        }


def tilted_flesh(flesh: object, layer: float, overlap: Vector, cosine: Vector) -> tuple[Vector, Vector]:
    """Return force along x and its torque by the tilt's cosine, both per unit height; zero where apart.

    The flesh is compressed across the leg, over a length of one over the cosine: p(d)/cos θ·d(overlap·cos θ).
    """
    k = float(flesh.compression) * float(flesh.thickness) / layer
    compacted = float(flesh.compacted_at) / float(flesh.thickness) * layer
    depth = np.maximum(overlap, 0.0) * cosine
    over = np.maximum(depth - compacted, 0.0)
    wall = float(flesh.wall)
    force = k * (depth + depth**3 / layer**2) + wall * over**2 / (2 * (layer - compacted))
    stored = k * (depth**2 / 2 + depth**4 / (4 * layer**2)) + wall * over**3 / (6 * (layer - compacted))
    return force, force * depth / cosine**2 - stored / cosine**2


def segments_of(legform: Legform, procedure: Procedure) -> list[Segment]:
    """Return the leg's segments with the mass that the rig adds."""
    segments = leg_segments(legform)
    added = procedure.rig.added_mass
    if added is not None:
        segments[0] = segments[0].with_mass(added.mass, segments[0].top + added.offset)
    return segments
