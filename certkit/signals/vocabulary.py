"""The channels' vocabulary as the rooms from here on know it; it is kept in `certkit.definitions.channels`.

Definitions name channels too and lie below this room, so the words live there.
"""

from __future__ import annotations

from certkit.definitions.channels import (
    ACCELERATION,
    ANGLE,
    CHANNELS,
    DIMENSIONS,
    DISPLACEMENT,
    ELONGATION,
    ENERGY,
    FORCE,
    MOMENT,
    SPEED,
    TIME,
    ChannelKind,
    Dimension,
    channel_kind,
)

__all__ = [
    "ACCELERATION",
    "ANGLE",
    "CHANNELS",
    "DIMENSIONS",
    "DISPLACEMENT",
    "ELONGATION",
    "ENERGY",
    "FORCE",
    "MOMENT",
    "SPEED",
    "TIME",
    "ChannelKind",
    "Dimension",
    "channel_kind",
]
