"""Recordings and what is done to them before anybody measures on them. Reads no files."""

from certkit.signals.cfc import cfc
from certkit.signals.condition import condition
from certkit.signals.filtered import Filtered
from certkit.signals.interval import AssessmentInterval, assessment_interval
from certkit.signals.iso18571 import Rating, rate, resampled
from certkit.signals.recording import Channel, Recording

__all__ = [
    "AssessmentInterval",
    "Channel",
    "Filtered",
    "Rating",
    "Recording",
    "assessment_interval",
    "cfc",
    "condition",
    "rate",
    "resampled",
]
