"""Strips of faces that fold as they are pushed in: where each stands, and how much of it can be seen.

A strip's place (x against its groups, z) and height are tabulated over its groups' displacement, see
`recorded_path`. Of two strips at one height only the one in front can be met.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.recorded_path import RecordedPath, on_path

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import Instant
    from certkit.mechanics.records import Rows, State


class Strip(RecordedPath, Protocol):
    """A strip of a folding face, SI; see `certkit.mechanics.force_laws.folding_face_contact`."""

    order: int
    largest: State
    apart: State
    parting: State
    x: State
    z: State
    face: State
    height: State
    shift: State
    climb: State


@compiled
def move_strip(strip: Strip, now: Instant, moved: float, apart: float) -> None:
    """Write down where a strip stands now, how high it is, and what of that is its own change.

    Parameters
    ----------
    strip : Strip
    now : Instant
    moved : float
        Displacement of what it moves with, m.
    apart : float
        How far that stands before its neighbour, m.
    """
    strip.largest = max(strip.largest, moved)
    strip.parting = apart - strip.apart
    strip.apart = apart
    x = on_path(now.curves, strip, 0, moved, strip.largest)
    z = on_path(now.curves, strip, 1, moved, strip.largest)
    strip.shift, strip.climb = x - strip.x, z - strip.z
    strip.x, strip.z = x, z
    strip.face = moved + x
    strip.height = max(on_path(now.curves, strip, 2, moved, strip.largest), 0.0)


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
