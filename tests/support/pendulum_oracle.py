"""The whole pendulum test a second time, see `leg_oracle`: the leg with its flesh on a hinge against the bar.

Exudyn integrates the same forces with its own bodies and joints in `pendulum_in_exudyn`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq

from support.leg_oracle import GRAVITY, REVERSAL, STRIP, LegOracle, Pose, segments_of, tilted_flesh

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure

Vector = np.ndarray


class Pendulum(LegOracle):
    """The leg on its hinge at first contact, and all forces on it."""

    gravity = GRAVITY

    def __init__(self, legform: Legform, procedure: Procedure) -> None:
        rig, flesh = procedure.rig, legform.flesh
        super().__init__(legform, segments_of(legform, procedure))
        self.pin = self.hinge = self.segments[-1].bottom - rig.hinge.offset
        self.pinned, self.free = self.branches(self.pin, upwards=True)
        length = self.top - self.bottom
        self.flesh_mass = self.extra_mass = flesh.mass * length / length.sum()
        self.flesh_height = (self.top + self.bottom) / 2
        self.gap = -np.diff(self.centre + self.flesh_height)
        stopper = rig.stopper
        cover = float(stopper.cover or 0.0)
        strips = math.ceil(stopper.height / STRIP)
        self.strip = stopper.height / strips
        self.band = -stopper.knee_centre_below - (np.arange(strips) + 0.5) * self.strip
        self.off = np.array([s.depth / 2 for s in self.segments]) + flesh.thickness
        self.face = legform.parts["tibia"].depth / 2 + stopper.tibia_face_to_edge - cover
        self.layer = float(flesh.thickness) + cover
        self.loss = (1 - flesh.resilience) / (1 + flesh.resilience)
        heights = np.concatenate([self.centre, self.centre + self.flesh_height]) - self.hinge
        masses = np.concatenate([self.mass, self.flesh_mass])
        self.angle = brentq(lambda angle: self._overlap(self._stiff(angle))[0].max(), 0.0, 0.3, xtol=1e-14)
        fall = GRAVITY * float(masses @ heights) * (math.cos(self.angle) + math.sin(rig.release.angle))
        self.rate = -math.sqrt(2 * fall / float(masses @ heights**2 + self.inertia.sum()))

    def _stiff(self, angle: float) -> Pose:
        """Return the straight leg turned about its hinge."""
        reach = self.centre - self.hinge
        bone = np.stack(
            [-np.sin(angle) * reach, self.hinge + np.cos(angle) * reach, np.full(self.n, angle)], axis=1
        )
        return Pose(bone, np.zeros((self.n, 3)), np.zeros((self.n, 2)), np.zeros((self.n, 2)))

    def start(self) -> Vector:
        a, size = len(self.pinned.bodies), self.n + 2
        total = size + 2 * self.n
        start, speed = np.zeros(total), np.zeros(total)
        s, c = math.sin(self.angle), math.cos(self.angle)

        def place(height: Vector | float, at: slice | int, shift: int) -> None:
            reach = height - self.hinge
            start[at], start[shift_by(at, shift)] = -s * reach, self.hinge + c * reach
            speed[at], speed[shift_by(at, shift)] = -self.rate * c * reach, -self.rate * s * reach

        start[:size], speed[:size] = self.angle, self.rate
        place(self.segments[self.upper].bottom, a, 1)
        place(self.centre + self.flesh_height, slice(size, None, 2), 1)
        return np.concatenate([start, speed])

    def outer(
        self,
        p: Pose,
        on_bone: Vector,
        on_extra: Vector,
        ahead: float,  # noqa: ARG002  # the base's
    ) -> None:
        on_extra[:, 1] += GRAVITY * self.flesh_mass
        self._hang_flesh(p, on_bone, on_extra)
        self._stop(p, on_bone)

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

    def _overlap(self, p: Pose) -> tuple[Vector, Vector, Vector]:
        """Return overlap with the bar, segment, and its derivative by the angle, strip by strip."""
        c, t = np.cos(p.bone[:, 2]), np.tan(p.bone[:, 2])
        low = p.bone[:, 1] + self.bottom * c
        row = (self.band[:, None] < low).sum(axis=1)
        lever = self.band - p.bone[row, 1]
        overlap = p.bone[row, 0] - lever * t[row] + self.off[row] / c[row] - self.face
        return overlap, row, self.off[row] / c[row] * t[row] - lever / c[row] ** 2

    def _stop(self, p: Pose, on_bone: Vector) -> None:
        overlap, row, by_angle = self._overlap(p)
        cosine, t = np.cos(p.bone[row, 2]), np.tan(p.bone[row, 2])
        press, by_cosine = tilted_flesh(self.legform.flesh, self.layer, overlap, cosine)
        rate = p.bone_rate[row]
        closing = rate[:, 0] + t * rate[:, 1] + by_angle * rate[:, 2]
        push = self.strip * press * (1 + self.loss * np.tanh(closing * cosine / REVERSAL))
        np.add.at(on_bone, (row, 0), -push)
        np.add.at(on_bone, (row, 1), -push * t)
        np.add.at(on_bone, (row, 2), -push * by_angle + self.strip * by_cosine * np.sin(p.bone[row, 2]))


def shift_by(at: slice | int, shift: int) -> slice | int:
    """Return the place of the z beside an x."""
    return at + shift if isinstance(at, int) else slice(at.start + shift, at.stop, at.step)
