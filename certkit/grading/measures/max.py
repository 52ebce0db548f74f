"""`max`: the highest value of a channel, and when it first occurs."""

from __future__ import annotations

from certkit.grading.measures.measure_method import PeakMethod


class Max(PeakMethod):
    """max y(t)."""
