"""A layer of tabulated foam under a skin: what its foam presses with, and what its skin and shear hand on.

Foam. A loading curve p(d), force per unit length over depth (N/m over m), piecewise linear from (0, 0) and
continued with its last slope, with the work W(d) = ∫p dd. It knows the largest work Wₘ it was loaded with:

    q = p·(H + (1 - H)·(W/Wₘ)ˢ)        below it, and q = p on the way there

with the hysteresis factor H and the shape s. Speed has no influence. Loaded again from W on it may forget:
Wₘ - W then falls off as exp(-Δd/r) over the recovery r, so that p is reached again. What it gives back from d
on is S = W·(H + (1 - H)·(W/Wₘ)ˢ/(s + 1)).

Skin. Places of the layer do not move alone. Over a slope g = du/dz of the pressed depth u the layer hands on

    Q(g) = N·m·g + A·(1 - 1/√(1 + g²))·g

with the foam's shear N = G·b·t/3 (shear modulus, width and thickness; the depth falls off linearly towards
the bone), what the foam's memory leaves of its stress, m = H + (1 - H)·(W/Wₘ)ˢ on the way back and 1 on the
way there, and the tensile stiffness A of the skin, held beside the place that is pressed in. Foam whose whole
stress falls by its energy is softer in shear too while it springs back.

Source: shear layer of a foundation after Vlasov and Pasternak; tension of a membrane; hysteresis of
tabulated foams as explicit finite-element codes have it (factor and shape of the unloading by energy).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import CurvePoint
    from certkit.mechanics.records import Rows


@compiled
def loading(curves: Rows[CurvePoint], start: int, count: int, depth: float) -> tuple[float, float, float]:
    """Return force p (N/m), its slope (N/m²) and work W (J/m) of the loading curve at a depth; 0 below 0."""
    if depth <= 0.0:
        return 0.0, 0.0, 0.0
    work = 0.0
    k = start
    while k < start + count - 2 and depth > curves[k + 1].x:
        work += 0.5 * (curves[k].force + curves[k + 1].force) * (curves[k + 1].x - curves[k].x)
        k += 1
    slope = (curves[k + 1].force - curves[k].force) / (curves[k + 1].x - curves[k].x)
    over = depth - curves[k].x
    force = curves[k].force + slope * over
    return force, slope, work + 0.5 * (curves[k].force + force) * over


@compiled
def _above_hysteresis(share: float, hysteresis: float, shape: float) -> float:
    """Return (1 - H)·(W/Wₘ)ˢ of the share W/Wₘ."""
    return (1.0 - hysteresis) * math.pow(share, shape)


@compiled
def remembered(
    force: float, slope: float, work: float, most: float, hysteresis: float, shape: float
) -> tuple[float, float, float]:
    """Return force q (N/m), its slope and what it gives back S (J/m), with the memory `most` Wₘ (J/m)."""
    if work >= most:
        return force, slope, work * (hysteresis + (1.0 - hysteresis) / (shape + 1.0))
    if work <= 0.0:
        return 0.0, slope * hysteresis, 0.0
    share = _above_hysteresis(work / most, hysteresis, shape)
    kept = hysteresis + share
    return (
        force * kept,
        slope * kept + force * share * shape * force / work,
        work * (hysteresis + share / (shape + 1.0)),
    )


@compiled
def left_by_memory(work: float, most: float, hysteresis: float, shape: float) -> float:
    """Return m, the share of the foam's stress that its memory `most` Wₘ (J/m) leaves at the work W (J/m)."""
    if most <= 0.0 or work >= most:
        return 1.0
    return hysteresis + _above_hysteresis(max(work, 0.0) / most, hysteresis, shape)


@compiled
def handed_on(difference: float, distance: float, shear: float, skin: float) -> tuple[float, float, float]:
    """Return Q (N), its derivative by the difference of two depths (N/m) and the energy stored (J).

    Parameters
    ----------
    difference, distance : float
        Of the two places: pressed depth, and place along the leg, m.
    shear, skin : float
        N·m and A, N.
    """
    slope = difference / distance
    length = math.sqrt(1.0 + slope * slope)
    force = shear * slope + skin * (1.0 - 1.0 / length) * slope
    stiffness = (shear + skin * (1.0 - 1.0 / (length * length * length))) / distance
    longer = length - 1.0
    return force, stiffness, 0.5 * distance * (shear * slope * slope + skin * longer * longer)
