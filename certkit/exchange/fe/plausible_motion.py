"""Histories of a case held against mechanics, whatever format they come from.

A part's centre moves by ∫p/m dt. Where its displacement is another by a factor, goes the other way or has
another course, units, signs or columns are confused. An impact takes milliseconds, not seconds, and happens
at the speed of a car.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.integral import running_integral

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.exchange.fe.histories import PartHistories, Values

SHORTEST, LONGEST = 5e-4, 5.0
"""s: what histories of an impact may span."""

FASTEST = 300.0
"""m/s: no part of a car front or a leg moves so fast as a whole."""

FACTOR = 2.0
"""By how much the largest displacements may differ: a crushed foam's mass and centre drift."""

LEAST_CORRELATION = 0.7

CONFUSED = 100.0
"""By how much the movements of a part's front and of its centre differ when their units are not the same.

The centre of a long hood may move by a tenth of its edge's movement, or a little the other way.
"""

OPPOSITE = -0.9
"""Correlation below which two movements, as large as each other by `FACTOR`, are one with its sign turned."""

FRONT_STILL = 0.1
"""Share of the largest movement of a front below which a front is not held against its part's centre."""

STILL = 5e-3
"""Share of the largest displacement of all parts below which a part's motion is not judged."""


def require_plausible(histories: PartHistories) -> None:
    """Refuse histories that contradict themselves.

    Raises
    ------
    DataError
        With the part, both figures and what to look at.
    """
    span = float(histories.time[-1] - histories.time[0])
    if not SHORTEST <= span <= LONGEST:
        raise DataError(
            f"{histories.source}: the histories last {span:.4g} s, an impact some hundredths of one; correct "
            "`units`, or the unit of the time column"
        )
    moved = {
        name: part.displacement - part.displacement[0]
        for name, part in histories.parts.items()
        if part.displacement is not None and part.momentum is not None and part.mass is not None
    }
    by_momentum = {}
    for name in moved:
        part = histories.parts[name]
        if part.momentum is None or part.mass is None:
            continue
        speed = part.momentum / part.mass
        fastest = float(np.abs(speed).max())
        if fastest > FASTEST:
            raise DataError(
                f"{histories.source}: part `{name}` moves at up to {fastest:.0f} m/s by its momentum and "
                "mass; correct `units`, the unit of its column, or its mass"
            )
        by_momentum[name] = running_integral(speed, histories.time)
    largest = max((float(np.abs(x).max()) for x in (*moved.values(), *by_momentum.values())), default=0.0)
    for name, found in moved.items():
        told, wanted = float(np.abs(found).max()), float(np.abs(by_momentum[name]).max())
        if max(told, wanted) < STILL * largest or largest <= 0:
            continue
        course = float(np.corrcoef(found, by_momentum[name])[0, 1]) if min(told, wanted) > 0 else 0.0
        if course < LEAST_CORRELATION or not 1 / FACTOR <= told / wanted <= FACTOR:
            other = ", on another course" if course < LEAST_CORRELATION else ""
            raise DataError(
                f"{histories.source}: part `{name}` moves by {1e3 * told:.4g} mm, its momentum over its mass "
                f"gives {1e3 * wanted:.4g} mm{other}; check the units and signs of its columns, `units`, and "
                "its mass"
            )
    _require_fronts(histories, moved)


def _require_fronts(histories: PartHistories, moved: Mapping[str, Values]) -> None:
    """Refuse a front that goes the other way than its part's centre, or in another unit."""
    fronts = {
        name: part.front - part.front[0] for name, part in histories.parts.items() if part.front is not None
    }
    largest = max((float(np.abs(x).max()) for x in fronts.values()), default=0.0)
    largest = max(largest, *(float(np.abs(x).max()) for x in moved.values()), 0.0)
    for name, front in fronts.items():
        told, centre = float(np.abs(front).max()), moved.get(name)
        wanted = 0.0 if centre is None else float(np.abs(centre).max())
        if centre is None or max(told, wanted) <= FRONT_STILL * largest:
            continue
        ratio = told / wanted if wanted > 0 else np.inf
        turned = 1 / FACTOR <= ratio <= FACTOR and float(np.corrcoef(front, centre)[0, 1]) < OPPOSITE
        if turned or not 1 / CONFUSED < ratio < CONFUSED:
            other = ", the other way" if turned else ""
            raise DataError(
                f"{histories.source}: the front of part `{name}` moves by {1e3 * told:.4g} mm{other}, its "
                f"centre by {1e3 * wanted:.4g} mm; check the units and signs of their columns"
            )
