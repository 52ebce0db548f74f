"""Points of a loading curve: fewer of them, and one beyond what was seen."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

if TYPE_CHECKING:
    from certkit.identification.spring_law import SpringLaw

BEYOND = 0.5
"""A loading curve is continued by this share of its range; a run goes on with the same slope."""


def continued(law: SpringLaw) -> SpringLaw:
    """Continue both ends of the loading curve with the steepest secant stiffness that the side has shown.

    So a spring that has softened (a flange that buckled, a contact that slipped off) comes to an end beyond
    what was seen, instead of letting its group fly. It is no stiffer there than where it unloads, as what
    yields is never stiffer than what springs back: the steepest secant may be that of a first blow.
    """
    x, f = np.array(law.shortening), np.array(law.force)
    for sign in (1.0, -1.0):
        side = sign * x > 0
        if not np.any(side):
            continue
        secant = float(np.max(np.maximum(sign * f[side], 0.0) / (sign * x[side])))
        end = int(np.argmax(sign * x))
        further = (1 + BEYOND) * x[end]
        force = f[end] + min(secant, law.branch.stiffness) * (further - x[end])
        place = x.size if sign > 0 else 0
        x, f = np.insert(x, place, further), np.insert(f, place, force)
    return replace(law, shortening=tuple(map(float, x)), force=tuple(map(float, f)))


def simplified(law: SpringLaw, share: float) -> SpringLaw:
    """Leave out points of the loading curve that a straight line between their neighbours replaces."""
    x, f = np.array(law.shortening), np.array(law.force)
    tolerance = share * float(np.max(np.abs(f)))
    keep = {0, len(x) - 1, int(np.argmin(np.abs(x)))}
    edge = sorted(keep)
    spans = list(pairwise(edge))
    while spans:
        a, b = spans.pop()
        if b - a < 2:
            continue
        line = f[a] + (f[b] - f[a]) * (x[a + 1 : b] - x[a]) / (x[b] - x[a])
        off = np.abs(f[a + 1 : b] - line)
        k = int(np.argmax(off))
        if off[k] > tolerance:
            keep.add(a + 1 + k)
            spans += [(a, a + 1 + k), (a + 1 + k, b)]
    kept = sorted(keep)
    return replace(law, shortening=tuple(float(v) for v in x[kept]), force=tuple(float(v) for v in f[kept]))
