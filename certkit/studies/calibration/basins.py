"""Basins: where a fit comes to from places that lie far apart.

The tests do not determine a leg, so one search tells of one answer among many. Each basin starts at the best
of some places spread over the whole space and goes downhill from there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.studies.calibration.search import downhill

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.calibration import Search
    from certkit.studies.calibration.search import Misfit, Tell


class Basin(Struct, frozen=True):
    """One place that a search came to.

    Parameters
    ----------
    start : str
        The seed of the places it began from.
    shares : ndarray, shape (k,)
        As shares of the bounds.
    squares : float
        Sum of all squared residuals there, pulls included.
    rms : float
        Of the goals alone, in what counts as one.
    """

    start: str
    shares: NDArray[np.float64]
    squares: float
    rms: float


def spread_places(count: int, size: int, seed: int) -> NDArray[np.float64]:
    """Return places that fill the space evenly (a Latin hypercube), shape (count, size)."""
    from scipy.stats import qmc  # noqa: PLC0415  # slow to import

    places: NDArray[np.float64] = qmc.LatinHypercube(size, rng=np.random.default_rng(seed)).random(count)
    return places


def search_basin(misfit: Misfit, seed: int, population: int, steps: int, tell: Tell) -> Basin:
    """Go downhill from the best of `population` places spread over the whole space."""
    places = spread_places(population, len(misfit.space.axes), seed)
    first = places[int(np.sum(misfit.many(places) ** 2, axis=1).argmin())]
    return basin_at(misfit, str(seed), downhill(misfit, first, steps, tell, one_sided=True))


def find_basins(misfit: Misfit, search: Search, tell: Tell) -> list[Basin]:
    """Search from `search.basins` seeds; the basin with the smallest sum of squares comes first."""
    found = []
    for seed in range(search.seed, search.seed + search.basins):
        found.append(search_basin(misfit, seed, search.population, search.steps, tell))
        tell(f"basin {seed}: {found[-1].rms:.3f} rms of what counts as one")
    return sorted(found, key=lambda basin: basin.squares)


def basin_at(misfit: Misfit, start: str, shares: NDArray[np.float64]) -> Basin:
    """Return the basin whose bottom is at these shares of the bounds, shape (k,)."""
    residuals = misfit.one(shares)
    goals = residuals[: len(misfit.goals)] / np.array([goal.weight for goal in misfit.goals])
    return Basin(start, shares, float(residuals @ residuals), float(np.sqrt(np.mean(goals**2))))
