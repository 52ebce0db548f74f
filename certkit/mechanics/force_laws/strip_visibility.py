"""Which strips of a folding front can be seen: how much of each no other one stands in front of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from certkit.mechanics.compiling import compiled

if TYPE_CHECKING:
    from certkit.mechanics.records import Rows, State


class Strip(Protocol):
    """A strip: where it stands (m), its height (m), and a place in the order by height."""

    order: int
    face: State
    z: State
    height: State


@compiled
def sort_by_height(strips: Rows[Strip]) -> None:
    """Put the rows of all strips into `order`, from the top; a step before they were nearly so."""
    for k in range(1, len(strips)):
        row = strips[k].order
        at = k
        while at > 0 and strips[strips[at - 1].order].z < strips[row].z:
            strips[at].order = strips[at - 1].order
            at -= 1
        strips[at].order = row


@compiled
def _hidden_by(strips: Rows[Strip], i: int, k: int) -> float:
    """Return how much of a strip's height another one hides that stands in front of it."""
    strip, other = strips[i], strips[k]
    if other.face > strip.face or (other.face == strip.face and k > i):
        return 0.0
    top = min(strip.z + 0.5 * strip.height, other.z + 0.5 * other.height)
    bottom = max(strip.z - 0.5 * strip.height, other.z - 0.5 * other.height)
    return max(top - bottom, 0.0)


@compiled
def seen_height(strips: Rows[Strip], place: int, tallest: float) -> float:
    """Return how much of a strip's height no other strip stands in front of.

    Only the neighbours by height are asked.

    Parameters
    ----------
    strips : shape (n,)
        In `order`, see `sort_by_height`.
    place : int
        Of the strip, in that order.
    tallest : float
        Height of the tallest strip, m.
    """
    i = strips[place].order
    z, seen = strips[i].z, strips[i].height
    reach = 0.5 * (seen + tallest)
    at = place - 1
    while at >= 0 and strips[strips[at].order].z < z + reach:
        seen -= _hidden_by(strips, i, strips[at].order)
        at -= 1
    at = place + 1
    while at < len(strips) and strips[strips[at].order].z > z - reach:
        seen -= _hidden_by(strips, i, strips[at].order)
        at += 1
    return max(seen, 0.0)
