"""Channels of an OpenRadioss run held against each other: columns that were shifted cannot agree.

A converter that shifts columns, or writes impulses where forces should be, leaves a table that looks
whole. Mechanics tells it: no mass is negative, a part's momentum is its mass times the velocity
of its centre, its kinetic energy is at least p²/(2m), and a node's
displacement is the integral of its velocity.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.integral import running_integral

if TYPE_CHECKING:
    from certkit.exchange.fe.radioss_channels import Channels

_ENERGY = 0.01
"""Part of the largest energy that rounding of 32-bit values may take away."""

_MOMENTUM = 1e-3
"""Part of a part's largest momentum by which mass times velocity may be off."""

_MOTION = 0.05
"""Parts of a node's own and of the largest displacement that its integrated velocity may be off."""

_PLATEAU = 10
"""Rows at the end over which a column that does not change, and is not zero, is no contact force."""

_REMEDY = "its columns may be shifted: convert the run again, or read the native file (…T01)"


def require_consistent(channels: Channels) -> None:
    """Refuse channels that contradict each other.

    Raises
    ------
    DataError
        With the object, the row and what to do.
    """
    source = channels.source
    for name, variables in channels.parts.items():
        mass, momentum, energy = (variables.get(key) for key in ("MASS", "XMOM", "KE"))
        if mass is None:
            continue
        if np.any(mass < 0):
            row = int(np.argmax(mass < 0)) + 1
            raise DataError(f"{source}: the mass of `{name}` is negative in row {row}; {_REMEDY}")
        if momentum is None:
            continue
        velocity = variables.get("VX")
        weightless = (mass == 0) & (momentum != 0)
        # A rigid body's row is zero but for its velocity.
        apart = np.zeros_like(weightless)
        if velocity is not None and np.any(momentum):
            apart = np.abs(momentum - mass * velocity) > _MOMENTUM * float(np.abs(momentum).max())
        if np.any(weightless | apart):
            row = int(np.argmax(weightless | apart)) + 1
            raise DataError(
                f"{source}: momentum, mass and velocity of `{name}` contradict each other in row "
                f"{row}; {_REMEDY}"
            )
        if energy is None or not np.all(mass > 0):
            continue
        least = momentum**2 / (2.0 * mass)
        short = least > energy + _ENERGY * max(float(energy.max()), float(least.max()))
        if np.any(short):
            row = int(np.argmax(short)) + 1
            raise DataError(
                f"{source}: `{name}` has less kinetic energy in row {row} than its momentum and mass need; "
                f"{_REMEDY}"
            )
    _require_motion(channels)
    if not channels.impulses:
        _require_forces(channels)


def _require_motion(channels: Channels) -> None:
    """Hold the nodes' displacements against the integrals of their velocities (trapezoids)."""
    moving = {n: v for n, v in channels.nodes.items() if "DX" in v and "VX" in v}
    largest = max((float(np.abs(v["DX"]).max()) for v in moving.values()), default=0.0)
    for name, variables in moving.items():
        moved, velocity = variables["DX"] - variables["DX"][0], variables["VX"]
        off = np.abs(moved - running_integral(velocity, channels.time))
        near = _MOTION * (largest + float(np.abs(moved).max()))
        if np.any(off > near):
            row = int(np.argmax(off > near)) + 1
            raise DataError(
                f"{channels.source}: the displacement of node `{name}` is not the integral of its velocity "
                f"(row {row}); {_REMEDY}"
            )


def _require_forces(channels: Channels) -> None:
    """Refuse contact columns that end on a plateau: impulses, where the conversion should hold forces."""
    for name, variables in channels.contacts.items():
        force = variables.get("FNX")
        if force is None or force.size <= _PLATEAU:
            continue
        end, largest = force[-_PLATEAU:], float(np.abs(force).max())
        if largest > 0 and np.ptp(end) <= 1e-6 * largest and abs(float(end[-1])) > 0.5 * largest:
            raise DataError(
                f"{channels.source}: contact `{name}` ends on {float(end[-1]):.6g} and stays there, as an "
                "impulse does and no force; convert with the …_TITLES file, or read the native file (…T01)"
            )
