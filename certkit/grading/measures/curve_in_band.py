"""`curve in band`: a channel over time, all of it between two lines."""

from __future__ import annotations

from certkit.grading.measures.measure_method import CurveMethod


class CurveInBand(CurveMethod):
    """The curve (t, y(t)); see `certkit.grading.corridor_distance.band_distance`."""
