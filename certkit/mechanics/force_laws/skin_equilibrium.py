"""The pressed depth of a foam's skin under a row of strips, and what it presses back with.

A skin without inertia, over strips that overlap the unpressed surface by D, is pressed in by u. With what the
foam and the neighbours press back with (`foam_layer`), R = h·q(u) + Σ Q(neighbours),

    u = D and R ≥ 0 where a strip presses,    u > D and R = 0 where the skin is free

u comes from Newton steps of the tridiagonal equations of the free strips; those of R < 0 are let go and those
of u < D taken hold of until none changes. It starts from the step before, so that two or three rounds do.

Source: the obstacle problem of a membrane on a foundation, solved by a primal-dual active set.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Protocol

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.flesh_compression import friction_share
from certkit.mechanics.force_laws.foam_layer import handed_on, loading, remembered

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import Instant
    from certkit.mechanics.records import Rows, State

ROUNDS = 8
"""At most so often the set of pressed strips is looked for anew in a step."""

SLIVER = 1e-6
"""m: a strip of which less is met is none."""


class SkinStrip(Protocol):
    """What is known of a strip; see `certkit.mechanics.force_laws.skinned_foam_contact`."""

    foam_start: int
    foam_points: int
    hysteresis: float
    shape: float
    loss: float
    reversal: float
    recovery: float
    shear: float
    skin: float
    order: int
    chain: int
    held: int
    z: State
    size: State
    grip: State
    cosine: State
    depth: State
    pressed: State
    before: State
    most: State
    force: State
    pivot: State
    right: State
    coupled: State
    left: State


@compiled
def line_up(strips: Rows[SkinStrip]) -> int:
    """Put the rows of the strips that are met into `chain`, from the top; return how many they are.

    `order` has to be sorted.
    """
    count = 0
    for k in range(len(strips)):
        if strips[strips[k].order].size > SLIVER:
            strips[count].chain = strips[k].order
            count += 1
    return count


@compiled
def link_below(strips: Rows[SkinStrip], k: int) -> tuple[float, float, float]:
    """Return what the strip at a place of the chain hands on to the next one; see `handed_on`."""
    one, two = strips[strips[k].chain], strips[strips[k + 1].chain]
    part = min(one.grip, two.grip)
    shear = part * 0.5 * (one.left + two.left) * one.shear
    distance = max(one.z - two.z, 0.5 * (one.size + two.size))
    return handed_on(one.pressed - two.pressed, distance, shear, part * one.skin)


@compiled
def foam_of(strip: SkinStrip, now: Instant) -> tuple[float, float, float, float]:
    """Return the foam's force (N), stiffness (N/m), energy given back (J) and work per length (J/m)."""
    force, slope, work = loading(
        now.curves, strip.foam_start, strip.foam_points, strip.pressed * strip.cosine
    )
    force, slope, stored = remembered(force, slope, work, strip.most, strip.hysteresis, strip.shape)
    if strip.loss > 0.0:
        turn = strip.reversal * now.step / strip.cosine
        share = friction_share(strip.pressed - strip.before, strip.loss, turn)
        slope *= 1.0 + share
        slope += force * (strip.loss - share * share / strip.loss) / turn / strip.cosine
        force *= 1.0 + share
    return strip.size * force, strip.size * slope * strip.cosine, strip.size * stored / strip.cosine, work


@compiled
def remember(strip: SkinStrip, work: float) -> None:
    """Write down the largest work, of which loading that comes again forgets what is beyond its own."""
    grown = (strip.pressed - strip.before) * strip.cosine
    if work >= strip.most:
        strip.most = work
    elif strip.recovery > 0.0 and grown > 0.0:
        strip.most = work + (strip.most - work) * math.exp(-grown / strip.recovery)


@compiled
def _choose(strips: Rows[SkinStrip], now: Instant, count: int) -> bool:
    """Let go of strips that would pull, take hold of those the skin lies behind; tell of any change."""
    changed = False
    linked = 0.0
    for k in range(count):
        strip = strips[strips[k].chain]
        force = -linked
        if k < count - 1:
            linked, _, _ = link_below(strips, k)
            force += linked
        strip.force = 0.0
        if strip.held > 0:
            press, _, _, _ = foam_of(strip, now)
            strip.force = press + force
    for k in range(count):
        strip = strips[strips[k].chain]
        if strip.held > 0:
            if strip.force < 0.0 or strip.depth <= 0.0:
                strip.held = 0
                strip.force = 0.0
                changed = True
        elif strip.depth > 0.0 and strip.pressed < strip.depth:
            strip.held = 1
            strip.pressed = strip.depth
            changed = True
    return changed


@compiled
def _relax(strips: Rows[SkinStrip], now: Instant, count: int) -> None:
    """Take one Newton step of the free strips' equilibrium, by elimination from top to bottom."""
    linked = coupled = 0.0
    for k in range(count):
        strip = strips[strips[k].chain]
        press, slope, _, _ = foam_of(strip, now)
        pivot, right = slope + coupled, linked - press
        if k > 0:
            last = strips[strips[k - 1].chain]
            if last.held == 0 and last.pivot > 0.0:
                pivot -= coupled * coupled / last.pivot
                right += coupled * last.right / last.pivot
        linked = coupled = 0.0
        if k < count - 1:
            linked, coupled, _ = link_below(strips, k)
        strip.pivot = pivot + coupled
        strip.right = right - linked
        strip.coupled = coupled
    step = 0.0
    for back in range(count):
        strip = strips[strips[count - 1 - back].chain]
        if strip.held > 0 or strip.pivot <= 0.0:
            step = 0.0
            continue
        step = (strip.right + strip.coupled * step) / strip.pivot
        strip.pressed += step


@compiled
def press_skin(strips: Rows[SkinStrip], now: Instant, count: int) -> None:
    """Find the pressed depth of every strip's skin, and the contact force."""
    for k in range(count):
        strip = strips[strips[k].chain]
        if strip.held > 0:
            strip.pressed = strip.depth
    _choose(strips, now, count)
    for _ in range(ROUNDS):
        _relax(strips, now, count)
        if not _choose(strips, now, count):
            break
