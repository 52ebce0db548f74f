"""Recordings and what is done to them before anybody measures on them. Reads no files."""

from certkit.signals.cfc import cfc
from certkit.signals.condition import condition
from certkit.signals.filtered import Filtered
from certkit.signals.interval import AssessmentInterval, assessment_interval
from certkit.signals.iso18571 import Rating, rate, resampled
from certkit.signals.recording import Channel, Recording
from certkit.signals.vocabulary import CHANNELS, ChannelKind, channel_kind

__all__ = [
    "CHANNELS",
    "AssessmentInterval",
    "Channel",
    "ChannelKind",
    "Filtered",
    "Rating",
    "Recording",
    "assessment_interval",
    "cfc",
    "channel_kind",
    "condition",
    "rate",
    "resampled",
]
