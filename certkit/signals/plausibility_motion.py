"""Whether a channel moves as its neighbours on the same leg do: dead, frozen, turned, scaled channels.

Every check compares what one sensor shows with what the others show of the same blow. Values are filtered
and run from contact on.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

    from numpy.typing import NDArray

Products = Mapping[str, Mapping[str, float]]
"""Sums of the products of two channels' samples, by both their names."""

MOVED = 0.10
"""Share of the amplitude class that the middle one of the neighbours has to reach for a blow to count (40
N·m). Below it, a channel that stands still proves nothing."""
DEAD = 0.01
"""Share of the amplitude class below which a channel does not move (4 N·m, 0.3 mm): the smallest peak of a
graded channel in a shipped run is 4.2 mm, 48 N·m."""
REST = 2.0
"""Times the swing at rest that a channel has to swing after contact to show more than its own noise."""
WINDOW = 0.010
"""Seconds over which a channel is looked at for standing still."""
FROZEN = 0.002
"""Share of its own swing that a frozen channel moves at most within the window; the stillest of the shipped
runs moves by 2.5 %, and a ligament that is held at its longest by a heavy upper body by 0.5 %."""
NEIGHBOURS_MOVE = 0.20
"""Share of their swing that the middle one of the neighbours moves meanwhile."""
TURNED = -0.5
"""Correlation with the bone's other gauges below which one is turned; the shipped runs have 0.66 and more."""
SHORTENED = 0.002
"""Metres that a ligament has to be shorter to move the wrong way; the shipped runs show up to 3.1 mm beside
an elongation of 27 mm."""
WRONG_WAY = 1.5
"""Times the elongation that the shortening has to be."""
FACTOR = 10**0.6
"""Factor against its neighbours from which on a unit is out by a power of ten; the shipped runs, the seed
paper's Table 1 and the corridors stay within a factor of two."""
EARLY = 0.15
"""Share of its largest size that a channel swings before contact to have moved; an estimate."""
EARLY_REST = 0.05
"""Share below which the middle one of the others is at rest meanwhile; an estimate."""
PATTERN = 0.35
"""Share of the largest moment by which a gauge may lie off the straight line between its neighbours, root
mean square over root mean square; the shipped fronts, one of which hits right at a gauge, have up to 0.20."""


def is_dead(swing: float, before: NDArray[np.float64], amplitude_class: float) -> bool:
    """Tell whether a channel shows nothing of the blow.

    Parameters
    ----------
    swing : float
        How far it moves from contact on.
    before : ndarray, shape (m,)
        At rest (may be empty).
    amplitude_class : float
    """
    if swing < DEAD * amplitude_class:
        return True
    return bool(before.size) and swing <= REST * float(np.ptp(before))


def moves_early(before: Mapping[str, NDArray[np.float64]], peaks: Mapping[str, float]) -> dict[str, float]:
    """Return channels that move before contact while the middle one of the others is at rest.

    Parameters
    ----------
    before : mapping of str to ndarray, shape (n,)
        Filtered, until shortly before contact.
    peaks : mapping of str to float
        Largest sizes after contact.

    Returns
    -------
    dict of str to float
        The swing before contact as a share of the largest size.
    """
    shares = {
        name: float(np.ptp(values)) / peaks[name]
        for name, values in before.items()
        if values.size > 1 and peaks[name] > 0
    }
    found = {}
    for name, own in shares.items():
        others = [share for other, share in shares.items() if other != name]
        if len(others) > 1 and own > EARLY and _middle(others) < EARLY_REST:
            found[name] = own
    return found


def blow(others: Collection[float]) -> bool:
    """Tell whether the neighbours show a blow: their middle peak, as a share of the amplitude class."""
    return bool(others) and _middle(others) > MOVED


def _middle(values: Iterable[float]) -> float:
    """Return the median; of a handful of numbers twenty times as quick as numpy's."""
    ordered = sorted(values)
    half = len(ordered) // 2
    return ordered[half] if len(ordered) % 2 else (ordered[half - 1] + ordered[half]) / 2


def activity(rows: NDArray[np.float64], interval: float) -> NDArray[np.float64]:
    """Return how far channels move within each window of 10 ms, as shares of their swings.

    Parameters
    ----------
    rows : ndarray, shape (channels, n)
    interval : float
        Seconds between samples.

    Returns
    -------
    ndarray, shape (channels, k)
        Every quarter of a window; empty for a record shorter than one, zero for a channel that never moves.
    """
    length = max(2, round(WINDOW / interval))
    if rows.shape[1] < length:
        return np.zeros((len(rows), 0))
    windows = np.lib.stride_tricks.sliding_window_view(rows, length, axis=1)[:, :: max(1, length // 4)]
    return _shares_of_swing(windows, rows)


def _shares_of_swing(windows: NDArray[np.float64], rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far channels move in windows, shape (channels, k, samples), over their whole swings."""
    swings = np.ptp(rows, axis=1)[:, np.newaxis]
    found: NDArray[np.float64] = np.ptp(windows, axis=2) / np.where(swings > 0.0, swings, 1.0)
    return found


def perhaps_frozen(rows: NDArray[np.float64], interval: float) -> bool:
    """Tell whether some channel may stand still in some window, by a few samples of each: else none does.

    Parameters are those of `activity`.
    """
    length = max(2, round(WINDOW / interval))
    if rows.shape[1] < length or not len(rows):
        return True
    begins = np.arange(0, rows.shape[1] - length + 1, max(1, length // 4))
    samples = np.arange(0, length, max(1, length // 8))
    windows = rows[:, begins[:, np.newaxis] + samples]
    return bool((_shares_of_swing(windows, rows) < FROZEN).any())


def frozen_from(
    own: NDArray[np.float64], others: Sequence[NDArray[np.float64]], levels: NDArray[np.bool_] | None
) -> int | None:
    """Return the first window in which a channel stands still while its neighbours move, or None.

    Parameters
    ----------
    own : ndarray, shape (k,)
        From `activity`: each window's movement as a share of the whole swing.
    others : sequence of ndarray, shape (k,)
        Of the neighbours.
    levels : ndarray of bool, shape (k,), or None
        Windows that count, or all; a slack ligament stands still at zero and is not frozen.
    """
    quiet = own < FROZEN
    if len(others) < 2 or not quiet.any():  # the quick way out: nearly every channel leaves here
        return None
    still = quiet & (np.median(np.stack(others), axis=0) > NEIGHBOURS_MOVE)
    if levels is not None:
        still &= levels
    found = np.flatnonzero(still)
    return int(found[0]) if found.size else None


def turned_gauges(bone: Mapping[str, NDArray[np.float64]]) -> dict[str, float]:
    """Return gauges of one bone that move against the others, with the middle one of their correlations.

    Parameters
    ----------
    bone : mapping of str to ndarray, shape (n,)
        Moments in N·m by channel; two gauges are needed, and those without any movement take no part.
    """
    if len(bone) < 2:
        return {}
    rows = np.stack(list(bone.values()))
    moves = np.ptp(rows, axis=1) > 0 if rows.shape[1] > 1 else np.zeros(len(rows), dtype=np.bool_)
    moving = [name for name, moved in zip(bone, moves.tolist(), strict=True) if moved]
    if len(moving) < 2:
        return {}
    rows = rows[moves]
    rows -= rows.mean(axis=1)[:, np.newaxis]
    rows /= np.sqrt((rows * rows).sum(axis=1))[:, np.newaxis]
    table = rows @ rows.T
    found = {}
    for row, name in enumerate(moving):
        middle = _middle(value for other, value in enumerate(table[row].tolist()) if other != row)
        if middle < TURNED:
            found[name] = middle
    return found


def surely_agree(names: Collection[str], products: Products, means: Mapping[str, float], count: int) -> bool:
    """Tell by sums over `count` samples whether no gauge of a bone can be turned; False where it might be."""
    moving = {n: products[n][n] - count * means[n] ** 2 for n in names}
    if any(moved <= 1e-6 * products[n][n] for n, moved in moving.items()):
        return False  # what hardly moves is lost in the rounding of the sums
    return all(products[a][b] > count * means[a] * means[b] for a, b in combinations(names, 2))


def moves_wrong_way(least: float, most: float, times: float) -> bool:
    """Tell whether a ligament that a blow lengthens is shortened instead, by its least and most, m."""
    return -least > SHORTENED and -least > times * max(most, 0.0)


def off_by_powers(peaks: Mapping[str, float], usual: Mapping[str, float]) -> dict[str, int]:
    """Return channels that are out by a power of ten against their neighbours, with that power.

    Parameters
    ----------
    peaks : mapping of str to float
        Largest sizes, of one dimension.
    usual : mapping of str to float
        What they usually are to each other; channels without an entry take no part.
    """
    logs = {name: math.log10(peaks[name] / usual[name]) for name in usual if peaks.get(name, 0.0) > 0}
    if len(logs) < 3:
        return {}
    found = {}
    for name, own in logs.items():
        others = [value for other, value in logs.items() if other != name]
        off = own - _middle(others)
        if abs(off) > math.log10(FACTOR):
            found[name] = round(off) or (1 if off > 0 else -1)
    return found


def off_the_line(
    before: NDArray[np.float64], gauge: NDArray[np.float64], behind: NDArray[np.float64]
) -> float | None:
    """Return how far a gauge lies off the line between its neighbours where that is more than a leg can show.

    All three are moments in N·m, shape (n,).

    Between gauges 80 mm apart the moment departs from a straight line by q·h²/2 only, with the line load q of
    contact and inertia. A bumper that hits right at the gauge makes q large, but not for long, so that root
    mean squares over the test are compared.

    Returns
    -------
    float or None
        Share of the gauges' largest moment, rms over rms.
    """
    largest = np.maximum(np.maximum(np.abs(before), np.abs(gauge)), np.abs(behind))
    size = float(np.sqrt((largest**2).mean()))
    if size == 0.0:
        return None
    share = float(np.sqrt(((gauge - (before + behind) / 2) ** 2).mean())) / size
    return share if share > PATTERN else None


def surely_on_the_line(products: Products, before: str, gauge: str, behind: str) -> bool:
    """Tell by sums over the samples whether `off_the_line` finds nothing; False where it might."""
    ends = products[before][before] + 2.0 * products[before][behind] + products[behind][behind]
    off = products[gauge][gauge] - products[gauge][before] - products[gauge][behind] + 0.25 * ends
    # The largest moment of the three is nowhere smaller than any one of them.
    size = max(products[name][name] for name in (before, gauge, behind))
    return off < (0.99 * PATTERN) ** 2 * size
