"""The contact forces of a run as single forces, and where on the leg each of them acts.

A group's contact force is divided among its nodes on the middle line by how deep each of them lies in the
leg's flesh, p ∝ d·(1 + (d/t)²), with the depth d from the leg's axis nodes and the flesh's thickness t.
Shells meet before their middle planes do: depths count from the deepest node's at first contact.
Nodes beyond the leg's ends meet nothing of it. Without axis nodes the whole force acts at the group's
foremost node, without any node at the middle of its face.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.mechanics.rig.recorded_forces import RecordedForce

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.documents.extraction import ExtractionResult
    from certkit.exchange.fe.node_motion import NodeMotion

    Values = NDArray[np.float64]

AXIS = "leg_axis"
"""Lines of nodes on the leg's axis begin with this."""


FIRST = 1e-4
"""Share of the whole impulse that tells the first contact."""


ONE = 1e-4
"""m: nodes of the axis that ever come nearer to each other than this are one."""

FAR = 1.0
"""m: by this less deep counts what is beyond an end of the leg, so that it is met where nothing else is."""

END = 1e-3
"""m: how far from its ends a force acts on the leg at least."""


def recorded_forces(
    result: ExtractionResult, motion: NodeMotion | None, *, face: float, thickness: float
) -> list[RecordedForce]:
    """Return the impactor's contact forces with their places.

    Parameters
    ----------
    result : ExtractionResult
    motion : NodeMotion, optional
    face, thickness : float
        Of the flesh: distance of its bone side from the leg's axis, and its thickness, m.
    """
    impactors = {group.name for group in result.groups if group.kind == "impactor"}
    groups = {group.name: group for group in result.groups}
    clock = np.array(result.times)
    time = clock - result.start
    axis = None if motion is None else axis_nodes(motion)
    surface = face + thickness
    if motion is not None and axis is not None:
        surface += _clearance(result, motion, axis, surface)
    found = []
    for path in result.paths:
        if path.source not in impactors or path.target not in groups or not any(path.force):
            continue
        force, group = np.array(path.force), groups[path.target]
        nodes = (
            []
            if motion is None
            else [n for part in group.parts for n in motion.places.get(part, {}).values()]
        )
        if motion is None or not nodes:
            middle = 0.5 * ((group.low or 0.0) + (group.high or 0.0))
            found.append(RecordedForce(group.name, time, force, np.full_like(time, middle)))
            continue
        places = np.array(nodes)
        shares = _foremost(places) if axis is None else _by_depth(places, axis, surface, thickness)
        for place, share in zip(places, shares, strict=True):
            if share.max() > 0:
                height = place[:, 1] if axis is None else _on_leg(place[:, 1], axis)
                height = np.interp(clock, motion.time, height)
                found.append(
                    RecordedForce(group.name, time, force * np.interp(clock, motion.time, share), height)
                )
    return found


def axis_nodes(motion: NodeMotion, begin: tuple[str, ...] = (AXIS,)) -> Values | None:
    """Return the places of the leg's axis nodes from bottom to top, shape (nodes, instants, 2).

    They stand in the lines whose names begin so. Of nodes that lie on one another, as where two pieces of the
    leg meet, one is taken.
    """
    nodes = [p for line, places in motion.places.items() if line.startswith(begin) for p in places.values()]
    kept: list[Values] = []
    for node in sorted(nodes, key=lambda p: p[0, 1]):
        if not kept or float(np.linalg.norm(node - kept[-1], axis=1).min()) > ONE:
            kept.append(node)
    return np.array(kept) if len(kept) > 1 else None


def _foremost(places: Values) -> Values:
    shares = np.zeros(places.shape[:2])
    shares[np.argmin(places[:, :, 0], axis=0), np.arange(places.shape[1])] = 1.0
    return shares


def _clearance(result: ExtractionResult, motion: NodeMotion, axis: Values, surface: float) -> float:
    """Return how far the nearest node of a touched group is from the flesh when the first force acts, m."""
    impactors = {group.name for group in result.groups if group.kind == "impactor"}
    touched = [path for path in result.paths if path.source in impactors and any(path.impulse)]
    total = np.sum([path.impulse for path in touched], axis=0)
    begun = float(np.array(result.times)[int(np.argmax(total > FIRST * total.max()))])
    groups = {group.name: group for group in result.groups}
    parts = [part for path in touched if path.target in groups for part in groups[path.target].parts]
    nodes = [node for part in parts for node in motion.places.get(part, {}).values()]
    gaps = [float(np.interp(begun, motion.time, _distance(node, axis))) - surface for node in nodes]
    return max(min(gaps, default=0.0), 0.0)


def _by_depth(places: Values, axis: Values, surface: float, thickness: float) -> Values:
    """Return each node's share of the force over time, shape (nodes, instants)."""
    depth = np.array([surface - _distance(node, axis) for node in places])
    depth[~np.array([_beside(node, axis) for node in places])] -= FAR
    press = np.maximum(depth, 0.0)
    press = press * (1.0 + (press / thickness) ** 2)
    total = press.sum(axis=0)
    nearest = np.zeros_like(press)
    nearest[np.argmax(depth, axis=0), np.arange(press.shape[1])] = 1.0
    return np.asarray(np.where(total > 0, press / np.where(total > 0, total, 1.0), nearest))


def _beside(node: Values, axis: Values) -> NDArray[np.bool_]:
    """Tell whether a node is beside the leg's axis, not beyond one of its ends, shape (instants,)."""
    low, high = axis[0], axis[-1]
    return np.asarray(
        (np.einsum("tj,tj->t", node - low, axis[1] - low) >= 0)
        & (np.einsum("tj,tj->t", node - high, axis[-2] - high) >= 0)
    )


def _on_leg(height: Values, axis: Values) -> Values:
    """Return a height that is on the leg, shape (instants,)."""
    low, high = axis[0, :, 1] + END, axis[-1, :, 1] - END
    return np.clip(height, low, high)


def _distance(node: Values, axis: Values) -> Values:
    """Return a node's distance from the axis over time, shape (instants,)."""
    first, along = axis[:-1], axis[1:] - axis[:-1]
    place = np.einsum("ktj,ktj->kt", node[None] - first, along) / np.einsum("ktj,ktj->kt", along, along)
    foot = first + np.clip(place, 0.0, 1.0)[..., None] * along
    return np.asarray(np.linalg.norm(node[None] - foot, axis=2).min(axis=0))
