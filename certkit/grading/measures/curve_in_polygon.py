"""`curve in polygon`: one channel over another, all of it inside an area of their plane."""

from __future__ import annotations

from certkit.grading.measures.measure_method import CurveMethod


class CurveInPolygon(CurveMethod):
    """The curve (x(t), y(t)); see `certkit.grading.corridor_distance.polygon_distance`."""
