"""Energy over time, by where it went, for the result document."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.result import Histories, Series

if TYPE_CHECKING:
    from certkit.mechanics import Simulation

MOST = 300
"""Points that a picture of energies needs."""


def energies(simulation: Simulation) -> Histories | None:
    """Write the energies of a run down, thinned out; None for static tests, whose clock means nothing."""
    books = simulation.quality.energies
    count = len(next(iter(books.values())))
    time = simulation.recording.time
    if len(time) < 2 or count < MOST:
        return None
    every = -(-count // MOST)
    return Histories(
        # The books begin at the start of the run, which may lie before first contact.
        start=-simulation.recording.interval * (count - len(time)),
        interval=simulation.recording.interval * every,
        count=len(range(0, count, every)),
        series={
            name: Series(title=name, unit="J", values=values[::every].tolist())
            for name, values in books.items()
        },
    )
