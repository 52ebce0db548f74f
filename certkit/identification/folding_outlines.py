"""Where the points of each face stand at several displacements of its group, from the motion of its nodes.

The mean front of a group (the paper's displacement) says how far it is pushed in, not where on it the leg
presses: a fascia folds, sinks, and rolls under the leg. So the outline is written down at even steps of the
group's displacement, on the way in and on the way back, each in the mean over the time that the group spends
at the step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from certkit.exchange.fe.node_motion import NodeMotion
    from certkit.identification.grouping import Graph
    from certkit.identification.sampling import Grid

    Values = NDArray[np.float64]

FINEST = 0.02
"""Outlines stand at least this share of the largest displacement of all faces apart.

How far a face is pushed in is not told more finely: what a face does while it hardly moves would be a jump,
which the leg and the face answer with chatter.
"""

TOLERANCE = 3e-4
"""m: an outline is left out where its neighbours give every point of it nearer than this."""

REACH = 1.6
"""A face goes on to the next group's first node when that is nearer than this times its own longest piece."""

STILL = 1e-3
"""m: a group that moves by less keeps its outline."""


class FoldingOutlines(Struct, frozen=True):
    """A face at several displacements of its group: places (m), and shares of the largest on the way back.

    `pushed` and `returning` hold points (x, z), from the lowest upwards, shape (outlines, points, 2).
    """

    at: Values
    pushed: Values
    shares: Values
    returning: Values


def folding_outlines(
    graph: Graph, kinds: Mapping[str, str], motion: NodeMotion, displacements: dict[str, Values], grid: Grid
) -> dict[str, FoldingOutlines]:
    """Return the outlines of every group whose parts have nodes on the middle line.

    Parameters
    ----------
    graph : Graph
    kinds : mapping of str to str
        Of each group. A face goes on to the next one of its own kind: fascia and hood are two sheets.
    motion : NodeMotion
    displacements : dict of str to ndarray, shape (n,)
        Of each group on the grid's axis, m.
    grid : Grid
    """
    chains = {}
    for name, parts in graph.groups.items():
        nodes = [place for part in parts for place in motion.places.get(part, {}).values()]
        if len(nodes) > 1 and name in displacements:
            chains[name] = np.array(sorted(nodes, key=lambda p: (p[0, 1], p[0, 0])))
    joined = {
        name: _to_next(chain, [other for own, other in chains.items() if kinds[own] == kinds[name]])
        for name, chain in chains.items()
    }
    finest = FINEST * max((float(np.max(displacements[name])) for name in joined), default=0.0)
    return {
        name: _outlines(chain, motion.time, displacements[name], grid, finest)
        for name, chain in joined.items()
    }


def _to_next(chain: Values, chains: Iterable[Values]) -> Values:
    """Lead a face on to the first node of the group above it, whose nodes its last piece shares."""
    own = np.hypot(*np.diff(chain[:, 0], axis=0).T).max()
    gaps = [(float(np.hypot(*(other[0, 0] - chain[-1, 0]))), other[0]) for other in chains]
    near = min((gap for gap in gaps if gap[0] > 0), key=lambda gap: gap[0], default=None)
    if near is None or near[0] > REACH * own or near[1][0, 1] < chain[-1, 0, 1]:
        return chain
    return np.concatenate([chain, near[1][None]])


def _outlines(chain: Values, time: Values, moved: Values, grid: Grid, finest: float) -> FoldingOutlines:
    seen = grid.time <= min(float(grid.time[-1]), float(time[-1]))
    at, moved = grid.time[seen], moved[seen]
    k = int(np.argmax(moved))
    largest = float(moved[k])
    if largest < STILL:
        return FoldingOutlines(np.zeros(1), chain[None, :, 0], np.zeros(0), np.zeros((0, len(chain), 2)))
    way = _first_beyond(np.maximum(moved[: k + 1], 0.0), finest)
    pushed_at = np.maximum(moved[way], 0.0)
    pushed_at[0] = 0.0
    forms = _forms(chain, time, at, moved)
    pushed = _mean_forms(forms[:, : k + 1], moved[: k + 1], pushed_at)
    pushed[0] = chain[:, 0]
    back = k + _first_beyond(np.minimum(largest - moved[k:], largest), finest)
    shares = np.maximum(moved[back] / largest, 0.0)
    returning = _mean_forms(forms[:, k:], moved[k:], shares * largest)
    keep = _telling(pushed_at, pushed, along=pushed_at)
    keep_back = _telling(-shares, returning, along=shares * largest)[:0:-1]
    return FoldingOutlines(pushed_at[keep], pushed[keep], shares[keep_back], returning[keep_back])


def _first_beyond(values: Values, step: float) -> NDArray[np.int64]:
    """Return the first instant, each that rises by a step beyond all before, and the largest."""
    chosen, reached = [0], float(values[0])
    last = int(np.argmax(values))
    for k in range(1, last + 1):
        if values[k] >= reached + step:
            chosen.append(k)
            reached = float(values[k])
    if chosen[-1] != last:
        if len(chosen) > 1 and values[last] < values[chosen[-1]] + 0.5 * step:
            chosen.pop()
        if values[last] > values[chosen[-1]]:
            chosen.append(last)
    return np.array(chosen)


def _telling(at: Values, points: Values, along: Values) -> NDArray[np.int64]:
    """Return the outlines that straight lines between the others do not replace.

    Parameters
    ----------
    at : ndarray, shape (n,)
        Rising.
    points : ndarray, shape (n, points, 2)
        x, z.
    along : ndarray, shape (n,)
        How far the group has moved.
    """
    shape = points - np.stack([along, np.zeros_like(along)], axis=1)[:, None]
    keep = {0, len(at) - 1}
    spans = [(0, len(at) - 1)]
    while spans:
        a, b = spans.pop()
        if b - a < 2:
            continue
        share = ((at[a + 1 : b] - at[a]) / (at[b] - at[a]))[:, None, None]
        off = np.linalg.norm(shape[a + 1 : b] - shape[a] - share * (shape[b] - shape[a]), axis=2).max(axis=1)
        k = a + 1 + int(np.argmax(off))
        if off[k - a - 1] > TOLERANCE:
            keep.add(k)
            spans += [(a, k), (k, b)]
    return np.array(sorted(keep))


def _forms(chain: Values, time: Values, at: Values, moved: Values) -> Values:
    """Return the places of a face's points against its group over time, shape (points, n, 2).

    Parameters
    ----------
    chain : ndarray, shape (points, instants, 2)
        Places of its nodes at the instants `time`.
    time : ndarray, shape (instants,)
    at, moved : ndarray, shape (n,)
        Instants that are wanted, s, and the group's displacement at each, m.
    """
    places = np.array([[np.interp(at, time, node[:, axis]) for axis in (0, 1)] for node in chain])
    places[:, 0] -= moved
    return np.moveaxis(places, 1, 2)


def _mean_forms(forms: Values, moved: Values, levels: Values) -> Values:
    """Return where a face's points stand in the mean over the time that its group spends at each level.

    A group may stand still while its face goes on to fold, so that no single instant tells its form there. It
    is at a level from when it has first come half the way from the one before to when it has come half the
    way to the next, and at the last until it first reaches it.

    Parameters
    ----------
    forms : ndarray, shape (points, n, 2)
        See `_forms`.
    moved : ndarray, shape (n,)
        Displacement of the group, m.
    levels : ndarray, shape (levels,)
        Of the displacement, rising or falling, m.

    Returns
    -------
    ndarray, shape (levels, points, 2)
    """
    turned = -1.0 if levels[-1] < levels[0] else 1.0
    edges = turned * np.append(0.5 * (levels[1:] + levels[:-1]), levels[-1])
    left = np.maximum.accumulate(turned * moved)
    until = np.maximum(np.searchsorted(left, edges), 1)
    until[-1] += 1
    begun = np.append(0, until[:-1])
    means = [
        forms[:, min(first, last - 1) : last].mean(axis=1) + np.array([level, 0.0])
        for first, last, level in zip(begun, until, levels, strict=True)
    ]
    return np.array(means)
