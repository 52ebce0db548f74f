"""A chain of rigid links in minimal coordinates, integrated by scipy: the oracle of the solver's pivots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.solver.world import Assembly, World


@dataclass(frozen=True)
class Chain:
    """Links from top to bottom: length, centre of gravity from the top, mass, inertia, joint law."""

    length: np.ndarray
    arm: np.ndarray
    mass: np.ndarray
    inertia: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray

    @property
    def links(self) -> int:
        return len(self.mass)

    def centres(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the centres of gravity (n, 2) and their Jacobian (n, 2, n + 2); q = x, z, angles."""
        n, angles = self.links, q[2:]
        down = np.stack([np.sin(angles), -np.cos(angles)], axis=1)
        slope = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        weights = np.tril(np.tile(self.length, (n, 1)), -1) + np.diag(self.arm)
        jacobian = np.zeros((n, 2, n + 2))
        jacobian[:, 0, 0] = jacobian[:, 1, 1] = 1.0
        jacobian[:, :, 2:] = np.einsum("ij,jc->icj", weights, slope)
        return q[:2] + weights @ down, jacobian

    def acceleration(self, q: np.ndarray, v: np.ndarray, gravity: tuple[float, float]) -> np.ndarray:
        n, angles, rates = self.links, q[2:], v[2:]
        _, jacobian = self.centres(q)
        down = np.stack([np.sin(angles), -np.cos(angles)], axis=1)
        weights = np.tril(np.tile(self.length, (n, 1)), -1) + np.diag(self.arm)
        bias = -weights @ (down * rates[:, None] ** 2)
        matrix = np.einsum("i,icj,ick->jk", self.mass, jacobian, jacobian)
        matrix[2:, 2:] += np.diag(self.inertia)
        force = np.einsum("i,icj,ic->j", self.mass, jacobian, np.array(gravity) - bias)
        moment = self.stiffness * np.diff(angles) + self.damping * np.diff(rates)
        force[2:-1] += moment
        force[3:] -= moment
        return np.linalg.solve(matrix, force)

    def integrate(
        self, q: np.ndarray, v: np.ndarray, times: np.ndarray, gravity: tuple[float, float] = (0.0, 0.0)
    ) -> np.ndarray:
        """Return q at the times, shape (t, n + 2)."""
        n = len(q)
        solution = solve_ivp(
            lambda _, y: np.concatenate([y[n:], self.acceleration(y[:n], y[n:], gravity)]),
            (times[0], times[-1]),
            np.concatenate([q, v]),
            method="DOP853",
            t_eval=times,
            rtol=1e-10,
            atol=1e-12,
        )
        assert solution.success
        return solution.y[:n].T

    def world(self, q: np.ndarray, v: np.ndarray, gravity: tuple[float, float] = (0.0, 0.0)) -> World:
        """Return the same chain for the solver."""
        assembly = Assembly(gravity=gravity)
        centres, jacobian = self.centres(q)
        speeds = jacobian @ v
        for i in range(self.links):
            assembly.add_body(
                f"link {i}",
                self.mass[i],
                self.inertia[i],
                (*centres[i], q[2 + i]),
                speed=(*speeds[i], v[2 + i]),
            )
        for i in range(self.links - 1):
            rest = self.length[i] - self.arm[i]
            x, z = centres[i] + rest * np.array([np.sin(q[2 + i]), -np.cos(q[2 + i])])
            assembly.add_pivot(i, i + 1, x, z)
            assembly.add(
                JointSpring(
                    upper=i,
                    lower=i + 1,
                    stiffness=self.stiffness[i],
                    damping=self.damping[i],
                    cable_angle=10.0,
                    cable_stiffness=0.0,
                )
            )
        return assembly.finish()


def bone_chain(damping_time: float = 2e-4) -> Chain:
    """Return the shipped femur and tibia in one: eighteen links."""
    height, n = 0.04, 18
    stiffness = np.full(n - 1, 170.0 / height)
    mass = np.full(n, 0.28)
    mass[[0, -1]] = 0.6
    return Chain(
        length=np.full(n, height),
        arm=np.full(n, height / 2),
        mass=mass,
        inertia=mass * (height**2 + 0.09**2) / 12,
        stiffness=stiffness,
        damping=damping_time * stiffness,
    )
