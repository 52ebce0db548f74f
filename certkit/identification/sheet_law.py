"""The law of a sheet between two groups: force and shortening along the path that the run took.

In a sheet that bends and folds the section force is no function of the shortening of the two groups beside
the section: one and the same shortening meets forces of either sign. Both are functions of the progress
ξ = (X₁ + X₂)/2 instead, of ξ itself while it grows, of its share of the largest while it falls. Off that path
the sheet resists a deviation of its shortening with

    K = max|F| / (`DEVIATION` · largest displacement),   c = 2·`DAMPING_RATIO`·√(K·m₁·m₂/(m₁ + m₂)),

so that a deviation of some per cent of the travel changes the force by as many tenths. Neither number is
fitted: any between half and twice of them gives the same movement of a front within a few per cent.

A contact that slides along such a sheet, as the lower stiffener's along the fascia, follows the same
progress; it only pushes, and is stiffer off its path.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Values = NDArray[np.float64]

DEVIATION = 0.3
SLIDING_DEVIATION = 0.1
"""As `DEVIATION`, of a contact that slides along a sheet.

A front driven by its run's own contact forces moves most nearly as in the run with this: its faces with an
error of 11 % in the mean, with three times as much 15 %, with half as much 12 %.
"""

DAMPING_RATIO = 0.3
BINS_IN, BINS_BACK = 40, 20
JOINED = 0.8
"""Share of the largest progress at which a way back that begins early has joined the recorded one."""

SLACK = 1e-4
"""m: a progress this little below its largest (on the way back: above its least) is still on the path."""


class SheetLaw(Struct, frozen=True):
    """A sheet's path: shortening (m) and force (N) over progress (m); what the way back adds, over its share.

    `stiffness` (N/m) and `damping` (N·s/m) act against deviations; `misfit` is the rms difference between the
    path's force along the run and the run's force, in per cent of the largest. Without `tension` it is a
    contact that slides along the sheet and only pushes.
    """

    progress: Values
    shortening: Values
    force: Values
    shares: Values
    back_shortening: Values
    back_force: Values
    stiffness: float
    damping: float
    misfit: float = 0.0
    tension: bool = True

    def force_along(self, progress: Values) -> Values:
        """Return the path's force along a history of progress, shape (n,)."""
        top = np.maximum.accumulate(np.maximum(progress, 0.0))
        share = np.divide(progress, top, out=np.ones_like(top), where=top > 0)
        inwards, end = np.interp(top, self.progress, self.force), self.force[-1]
        weight = np.minimum(top / self.progress[-1], 1.0)
        left = np.maximum((share - JOINED) / (1 - JOINED), 0.0)
        back = weight * (end + np.interp(share, self.shares, self.back_force)) + left * (
            inwards - weight * end
        )
        force = np.where(share < 1, back, inwards)
        return np.asarray(force if self.tension else np.maximum(force, 0.0))


def sheet_law(
    first: Values, second: Values, force: Values, masses: tuple[float, float], *, tension: bool = True
) -> SheetLaw | None:
    """Find the path of a sheet.

    Parameters
    ----------
    first, second : ndarray, shape (n,)
        Displacements of the two groups, m.
    force : ndarray, shape (n,)
        From the first to the second, N.
    masses : tuple of float
        Of the groups, kg.
    tension : bool
        Whether it also pulls.

    Returns
    -------
    SheetLaw or None
        None when the groups never move inwards or no force passes on the way.
    """
    progress, shortening = 0.5 * (first + second), first - second
    k = int(np.argmax(progress))
    force = force if tension else np.maximum(force, 0.0)
    top, peak = float(progress[k]), float(np.max(np.abs(force)))
    travel = float(max(np.max(np.abs(first)), np.max(np.abs(second))))
    if top <= SLACK or peak <= 0:
        return None
    way = progress[: k + 1]
    on_way = np.flatnonzero(way >= np.maximum.accumulate(way) - SLACK)
    edges = np.linspace(0.0, top, BINS_IN + 1)
    inwards = [(0.0, 0.0, 0.0), *_means(way, shortening, force, on_way, edges)]
    inwards.append((top, float(shortening[k]), float(force[k])))
    share = progress[k:] / top
    on_back = np.flatnonzero(share <= np.minimum.accumulate(share) + SLACK / top)
    back = _means(share, shortening[k:], force[k:], on_back, np.linspace(0.0, 1.0, BINS_BACK + 1))
    back = [(s, x - float(shortening[k]), f - float(force[k])) for s, x, f in back]
    inwards, back = _rising(inwards), _rising([*back, (1.0, 0.0, 0.0)])
    stiffness = peak / ((DEVIATION if tension else SLIDING_DEVIATION) * travel)
    reduced = masses[0] * masses[1] / (masses[0] + masses[1])
    (at, x, f), (shares, back_x, back_f) = np.array(inwards).T, np.array(back).T
    damping = 2 * DAMPING_RATIO * float(np.sqrt(stiffness * reduced))
    if not tension and max(np.max(f), float(f[-1]) + np.max(back_f)) <= 0:
        return None
    law = SheetLaw(at, x, f, shares, back_x, back_f, stiffness, damping, tension=tension)
    error = float(np.sqrt(np.mean((law.force_along(progress) - force) ** 2)))
    return replace(law, misfit=100 * error / peak)


def _means(
    at: Values, shortening: Values, force: Values, chosen: NDArray[np.int64], edges: Values
) -> list[tuple[float, float, float]]:
    """Return the means over the chosen instants between neighbouring edges, where there are any."""
    bins = np.clip(np.searchsorted(edges, at[chosen], side="left"), 0, len(edges))
    found = []
    for k in range(1, len(edges)):
        inside = chosen[bins == k]
        if inside.size:
            found.append(
                (float(at[inside].mean()), float(shortening[inside].mean()), float(force[inside].mean()))
            )
    return found


def _rising(points: list[tuple[float, float, float]]) -> list[tuple[float, float, float]]:
    """Leave out points that do not lie beyond the one before."""
    kept = points[:1]
    for point in points[1:]:
        if point[0] > kept[-1][0] + 1e-9:
            kept.append(point)
        elif point is points[-1]:
            kept[-1] = point
    return kept
