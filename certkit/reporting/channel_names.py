"""The words and units of the leg's channels in an extraction's report."""

from __future__ import annotations

MOMENTS = {"F": "femur moment", "T": "tibia moment"}


def channel_words(name: str) -> str:
    """Return a channel's words, so that the gauge F1 is not taken for a face of that name."""
    kind = MOMENTS.get(name[0])
    return f"{kind} {name[1:]}" if kind and name[1:].isdigit() else f"{name} elongation"


def channel_scale(name: str) -> tuple[float, str]:
    """Return the factor from SI to a channel's unit as it is shown, and that unit."""
    return (1e3, "mm") if name.endswith("CL") else (1.0, "N·m")
