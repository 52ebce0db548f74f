"""A comparison as slides (extra `pptx`): ratings, errors, and both curves of each channel."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.number_format import corridor, fixed
from certkit.reporting.slide_deck import SlideDeck

if TYPE_CHECKING:
    from certkit.documents.comparison import ComparisonDocument
    from certkit.reporting.workbook import Cell

MOST_POINTS = 250


def comparison_pptx(document: ComparisonDocument) -> bytes:
    """Return the slides."""
    deck = SlideDeck(document)
    said = [f"Reference: {document.reference.label}; compared: {document.other.label}"]
    if document.rating is not None:
        said.append(f"Mean ISO/TS 18571 rating {fixed(document.rating, 2)}, {document.grade}")
    deck.title(document.title, [*said, *document.notes])
    ratings: list[list[Cell]] = [
        [
            r.channel,
            *(fixed(v, 2) for v in (r.corridor, r.phase, r.magnitude, r.slope, r.overall)),
            r.grade or r.reason,
        ]
        for r in document.ratings
    ]
    heads = ("channel", "corridor", "phase", "magnitude", "slope", "overall", "grade")
    deck.table("ISO/TS 18571 ratings", heads, ratings)
    if document.checks:
        checks: list[list[Cell]] = [
            [c.title, c.channel, c.value, corridor(c.lower, c.upper), c.unit, c.verdict]
            for c in document.checks
        ]
        asked = ("asked for", "channel", "value", "limits", "unit", "verdict")
        deck.table(document.rule or "What is asked for", asked, checks)
    if document.rows:
        names = [row.channel for row in document.rows]
        values = {
            document.reference.label: [row.test for row in document.rows],
            document.other.label: [row.simulation for row in document.rows],
        }
        deck.columns(
            f"Largest values, {fixed(document.rms_error_percent, 1)} % apart (rms)", names, values, ""
        )
    for overlay in document.overlays:
        stride = max(1, len(overlay.reference) // MOST_POINTS)
        times = overlay.milliseconds[::stride]
        curves = {
            document.reference.label: overlay.reference[::stride],
            document.other.label: overlay.other[::stride],
        }
        titles = ("time after contact, ms", overlay.unit)
        deck.lines(f"{overlay.channel} {overlay.title}", times, curves, titles)
    return deck.content()
