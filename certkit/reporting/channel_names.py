"""The words and units of the leg's channels beside a front, whose faces may be called as gauges are."""

from __future__ import annotations

from certkit.reporting.language import Translate, english

MOMENTS = {"F": "femur moment", "T": "tibia moment"}


def channel_words(name: str, t: Translate = english) -> str:
    """Return a channel's words, so that the gauge F1 is not taken for a face of that name."""
    kind = MOMENTS.get(name[0])
    return f"{t(kind)} {name[1:]}" if kind and name[1:].isdigit() else f"{name} {t('elongation')}"


def is_channel(name: str) -> bool:
    """Tell whether a group of a front is called as a channel of a leg is: `F1`, `T3`, `MCL`."""
    return (name[:1] in MOMENTS and name[1:].isdigit()) or name in {"MCL", "LCL", "ACL", "PCL"}


def channel_scale(name: str) -> tuple[float, str]:
    """Return the factor from SI to a channel's unit as it is shown, and that unit."""
    return (1e3, "mm") if name.endswith("CL") else (1.0, "N·m")
