"""Where the points of each face stand at several displacements of its group, from the motion of its nodes.

The mean front of a group (the paper's displacement) says how far it is pushed in, not where on it the leg
presses: a fascia folds, sinks, and rolls under the leg. So the outline is written down at even steps of the
group's displacement, on the way in at the first instant that reaches the step, on the way back at the first
instant that falls below it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.exchange.fe.node_motion import NodeMotion
    from certkit.identification.grouping import Graph
    from certkit.identification.sampling import Grid

    Values = NDArray[np.float64]

STEPS_IN = 12
STEPS_BACK = 5
REACH = 1.6
"""A face goes on to the next group's first node when that is nearer than this times its own longest piece."""

STILL = 1e-3
"""m: a group that moves by less keeps its outline."""


@dataclass(frozen=True)
class FoldingOutlines:
    """A face at several displacements of its group: places (m), and shares of the largest on the way back.

    `pushed` and `returning` hold points (x, z), from the lowest upwards, shape (outlines, points, 2).
    """

    at: Values
    pushed: Values
    shares: Values
    returning: Values


def folding_outlines(
    graph: Graph, motion: NodeMotion, displacements: dict[str, Values], grid: Grid
) -> dict[str, FoldingOutlines]:
    """Return the outlines of every group whose parts have nodes on the middle line.

    Parameters
    ----------
    graph : Graph
    motion : NodeMotion
    displacements : dict of str to ndarray
        Of each group on the grid's axis, m.
    grid : Grid
    """
    chains = {}
    for name, parts in graph.groups.items():
        nodes = [place for part in parts for place in motion.places.get(part, {}).values()]
        if len(nodes) > 1 and name in displacements:
            chains[name] = np.array(sorted(nodes, key=lambda p: (p[0, 1], p[0, 0])))
    joined = {name: _to_next(chain, chains) for name, chain in chains.items()}
    return {name: _outlines(chain, motion.time, displacements[name], grid) for name, chain in joined.items()}


def _to_next(chain: Values, chains: dict[str, Values]) -> Values:
    """Lead a face on to the first node of the group above it, whose nodes its last piece shares."""
    own = np.hypot(*np.diff(chain[:, 0], axis=0).T).max()
    gaps = [(float(np.hypot(*(other[0, 0] - chain[-1, 0]))), other[0]) for other in chains.values()]
    near = min((gap for gap in gaps if gap[0] > 0), key=lambda gap: gap[0], default=None)
    if near is None or near[0] > REACH * own or near[1][0, 1] < chain[-1, 0, 1]:
        return chain
    return np.concatenate([chain, near[1][None]])


def _outlines(chain: Values, time: Values, moved: Values, grid: Grid) -> FoldingOutlines:
    end = min(float(grid.time[-1]), float(time[-1]))
    k = int(np.argmax(np.where(grid.time <= end, moved, -np.inf)))
    largest = float(moved[k])
    if largest < STILL:
        return FoldingOutlines(np.zeros(1), chain[None, :, 0], np.zeros(0), np.zeros((0, len(chain), 2)))
    at = np.linspace(0.0, largest, STEPS_IN + 1)
    reached = np.maximum.accumulate(moved[: k + 1])
    when = [grid.time[min(int(np.searchsorted(reached, level)), k)] for level in at[1:]]
    pushed = np.array([chain[:, 0], *(_at(chain, time, float(t)) for t in when)])
    fallen = np.minimum.accumulate(moved[k:][grid.time[k:] <= end])
    shares, returning = [], []
    for share in np.linspace(1.0, 0.0, STEPS_BACK + 1)[1:]:
        place = int(np.searchsorted(-fallen, -share * largest))
        if place < fallen.size:
            shares.append(float(share))
            returning.append(_at(chain, time, float(grid.time[k + place])))
    order = slice(None, None, -1)
    return FoldingOutlines(
        at, pushed, np.array(shares[order]), np.array(returning[order]).reshape(len(shares), len(chain), 2)
    )


def _at(chain: Values, time: Values, when: float) -> Values:
    return np.array(
        [[np.interp(when, time, node[:, 0]), np.interp(when, time, node[:, 1])] for node in chain]
    )
