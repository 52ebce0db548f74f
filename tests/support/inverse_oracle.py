"""The inverse test a second time, see `leg_oracle`: the bare leg on its hanger, hit by the honeycomb."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from support.leg_oracle import GRAVITY, STRIP, LegOracle, Pose, segments_of

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure

Vector = np.ndarray


class Inverse(LegOracle):
    """The leg on its hanger, and the ram at first contact."""

    gravity = -GRAVITY

    def __init__(self, legform: Legform, procedure: Procedure) -> None:
        super().__init__(legform, segments_of(legform, procedure))
        self.pin = self.segments[0].top
        self.pinned, self.free = self.branches(self.pin, upwards=False)
        ram = self.ram = procedure.rig.ram
        self.extra_mass = np.array([float(ram.mass)])
        strips = math.ceil(ram.height / STRIP)
        self.strip = ram.height / strips
        self.band = ram.top_edge - (np.arange(strips) + 0.5) * self.strip
        self.off = np.array([s.depth / 2 for s in self.segments])
        self.width = np.array(
            [ram.width_on_knee if s.part == "knee" else ram.width_on_bones for s in self.segments]
        )
        self.crushed = np.zeros(strips)
        low = ram.top_edge - ram.height
        self.face = max(
            off
            for off, s in zip(self.off, self.segments, strict=True)
            if s.bottom < ram.top_edge and s.top > low
        )

    def start(self) -> Vector:
        a, total = len(self.pinned.bodies), self.n + 4
        start, speed = np.zeros(total), np.zeros(total)
        start[a + 1] = self.segments[self.upper].bottom
        start[self.n + 2], speed[self.n + 2] = self.face, -self.ram.speed
        return np.concatenate([start, speed])

    def _overlap(self, p: Pose) -> tuple[Vector, Vector, Vector, Vector]:
        """Return overlap with the uncrushed face, segment, and its derivatives by height and angle."""
        c, t = np.cos(p.bone[:, 2]), np.tan(p.bone[:, 2])
        low = p.bone[:, 1] + self.bottom * c
        row = (self.band[:, None] < low).sum(axis=1)
        lever = self.band - p.bone[row, 1]
        overlap = p.bone[row, 0] - lever * t[row] + self.off[row] / c[row] - p.flesh[0, 0]
        return overlap, row, t[row], self.off[row] / c[row] * t[row] - lever / c[row] ** 2

    def outer(self, p: Pose, on_bone: Vector, on_extra: Vector, ahead: float) -> None:  # noqa: ARG002  # the base's
        overlap, row, by_height, by_angle = self._overlap(p)
        elastic = np.clip((overlap - self.crushed) / self.ram.elastic_depth, 0.0, 1.0)
        push = self.ram.crush_strength * self.width[row] * self.strip * elastic
        np.add.at(on_bone, (row, 0), -push)
        np.add.at(on_bone, (row, 1), -push * by_height)
        np.add.at(on_bone, (row, 2), -push * by_angle)
        on_extra[0, 0] += push.sum()

    def remember(self, before: Pose, after: Pose, step: float) -> None:
        super().remember(before, after, step)
        self.crushed = np.maximum(self.crushed, self._overlap(after)[0] - self.ram.elastic_depth)
