"""Recordings and what is done to them before anybody measures on them. Reads no files."""

from certkit.signals.recording import Channel, Recording
from certkit.signals.vocabulary import CHANNELS, ChannelKind, channel_kind

__all__ = ["CHANNELS", "Channel", "ChannelKind", "Recording", "channel_kind"]
