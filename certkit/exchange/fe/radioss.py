"""From OpenRadioss channels to part histories: the traps that are in every such file, handled in one place.

Both the native file and its conversion to CSV arrive here as `Block`s of variables. The traps:

- a rigid body's part row is all zero: its momentum is its mass times the velocity of its main node;
- the mass of a crushed solid drifts: the initial mass counts;
- contact channels are impulses in the native file, and their central difference, under the same names, in
  the CSV.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from certkit.errors import DataError
from certkit.exchange.fe.consistency import require_consistent
from certkit.exchange.fe.histories import ContactHistory, PartHistories, PartHistory, Units, match_one

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import RigidBody
    from certkit.exchange.fe.histories import Place
    from certkit.exchange.fe.radioss_channels import Channels

    Values = NDArray[np.float64]


def impulse_of_differences(force: Values, time: Values) -> Values:
    """Undo a central difference: return the impulse whose central difference `force` is.

    The converter writes F_i = (J_(i+1) − J_(i−1)) / (t_(i+1) − t_(i−1)) and zero in the first and last row.
    The relation is exactly invertible from rest; a plain cumulative integral would be 0.1 to 0.3 % off.

    Parameters
    ----------
    force, time : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (n,)
        Impulse, zero in the first two rows.
    """
    impulse = np.zeros_like(force)
    gained = force[1:-1] * (time[2:] - time[:-2])
    impulse[2::2] = np.cumsum(gained[0::2])
    impulse[3::2] = np.cumsum(gained[1::2])
    return impulse


def part_histories(channels: Channels, units: Units, rigid_bodies: Mapping[str, RigidBody]) -> PartHistories:
    """Turn channels in the file's units into SI part histories.

    Raises
    ------
    DataError
        When a part is a rigid body that the case does not describe, or a described one is not there.
    """
    source = channels.source
    require_consistent(channels)
    notes = list(channels.notes)
    if channels.unread:
        notes.append(f"columns that are not read: {', '.join(channels.unread[:12])}")
    for name in rigid_bodies:
        match_one(name, channels.parts, "part", source)
    parts = {}
    for name, variables in channels.parts.items():
        if name in rigid_bodies:
            parts[name] = _rigid(name, rigid_bodies[name], channels, units)
            notes.append(f"{name}: momentum from its mass and the velocity of node {rigid_bodies[name].node}")
        else:
            parts[name] = _deformable(name, variables, units, source)
            drift = _drift(variables)
            if drift > 0.01:
                notes.append(
                    f"{name}: the file's mass drifts by {100 * drift:.0f} %; the initial mass is used"
                )
    parts = {name: replace(part, id=channels.part_ids.get(name)) for name, part in parts.items()}
    contacts = {}
    for name, variables in channels.contacts.items():
        recorded = _variable(variables, "FNX", name, source) + variables.get("FTX", 0.0)
        impulse = recorded if channels.impulses else impulse_of_differences(recorded, channels.time)
        contacts[name] = ContactHistory(impulse * units.momentum)
    if contacts and not channels.impulses:
        notes.append("contact impulses recovered from the central differences that the converter writes")
    return PartHistories(
        time=channels.time * units.time,
        parts=parts,
        nodes={n: v["DX"] * units.length for n, v in channels.nodes.items() if "DX" in v},
        node_places={n: p for n, v in channels.nodes.items() if (p := _node_place(v, units))},
        contacts=contacts,
        energies={n: v * units.energy for n, v in channels.energies.items()},
        notes=tuple(notes),
        source=source,
        files={source: channels.digest},
    )


def _rigid(name: str, body: RigidBody, channels: Channels, units: Units) -> PartHistory:
    node = channels.nodes[match_one(body.node, channels.nodes, "node", channels.source)]
    velocity = _variable(node, "VX", body.node, channels.source) * (units.length / units.time)
    displacement = _variable(node, "DX", body.node, channels.source) * units.length
    if not np.any(velocity):
        raise DataError(
            f"{channels.source}: node `{body.node}` of rigid body `{name}` never moves; name its main "
            "node in the case"
        )
    mass = float(body.mass)
    return PartHistory(mass, mass * velocity, displacement, displacement, start=_node_place(node, units))


def _node_place(node: Mapping[str, Values], units: Units) -> Place | None:
    """Return a node's place at the start, m; None where the file does not tell it."""
    if not all(axis in node for axis in "XYZ"):
        return None
    x, y, z = (float(node[axis][0] - node.get(f"D{axis}", [0.0])[0]) * units.length for axis in "XYZ")
    return (x, y, z)


def _deformable(name: str, variables: Mapping[str, Values], units: Units, source: str) -> PartHistory:
    momentum = _variable(variables, "XMOM", name, source)
    mass = _variable(variables, "MASS", name, source)
    if not np.any(momentum) and not mass[0] > 0:
        # A rigid body nobody described; it may still be unused, so it only counts when a group names it.
        return PartHistory()
    position = variables.get("XCG")
    return PartHistory(
        mass=float(mass[0]) * units.mass,
        momentum=momentum * units.momentum,
        displacement=None if position is None else (position - position[0]) * units.length,
        start=_centre(variables, units),
    )


def _centre(variables: Mapping[str, Values], units: Units) -> Place | None:
    """Return a part's centre at the start, m; None where the file does not tell it."""
    at = [
        float(variables[key][0]) * units.length if key in variables else None for key in ("XCG", "YCG", "ZCG")
    ]
    return None if at[0] is None and at[2] is None else (at[0], at[1], at[2])


def _drift(variables: Mapping[str, Values]) -> float:
    mass = variables.get("MASS")
    if mass is None or not mass[0] > 0:
        return 0.0
    return float(np.max(np.abs(mass - mass[0])) / mass[0])


def _variable(variables: Mapping[str, Values], name: str, owner: str, source: str) -> Values:
    if name not in variables:
        raise DataError(f"{source}: `{owner}` has no {name}; add it to the solver's /TH request")
    return variables[name]
