"""The figures of each kind of document: their names, what they show, and what draws them.

A figure is one file in `certkit.reporting.charts` and one line here; the command, its help and the errors
ask this list. A file of drawing code is imported when its figure is wanted.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import NamedTuple


class FigureEntry(NamedTuple):
    """A figure.

    Parameters
    ----------
    draw : str
        `module:function` in `certkit.reporting.charts`. The function takes the document and the names of what
        to show (all when there is none), and returns a `Drawing`, or None where there is nothing to draw.
    shows : str
        What it shows, for the command's help.
    beside : str
        The function that draws two documents together; empty where none does.
    """

    draw: str
    shows: str
    beside: str = ""


FIGURES = MappingProxyType(
    {
        "certkit-result/1": {
            "corridor": FigureEntry("corridors_table:draw", "criteria in their corridors"),
            "history": FigureEntry(
                "history_figures:draw", "channels over time", "history_figures:draw_beside"
            ),
            "frames": FigureEntry(
                "motion_frames:draw", "the rig at a few instants", "motion_frames:draw_beside"
            ),
            "rig": FigureEntry("rig_drawing:draw", "the rig as it stands in the laboratory"),
            "table": FigureEntry("errors_table:draw", "the error table"),
            "errors": FigureEntry("error_bars:draw", "its bars"),
            "curve": FigureEntry("plane:draw", "curves of static tests"),
            "energy": FigureEntry("energies:draw", "energies over time"),
        },
        "certkit-extraction/1": {
            "momentum": FigureEntry("extraction_charts:momentum", "momentum of each group"),
            "impulse": FigureEntry("extraction_charts:impulse", "impulse through load paths"),
            "force": FigureEntry("extraction_charts:force", "force of load paths over time"),
            "stiffness": FigureEntry("extraction_charts:stiffness", "force over shortening"),
            "material": FigureEntry("extraction_charts:material", "stress over strain"),
            "frames": FigureEntry("run_and_model:draw", "run and model at a few instants"),
            "channels": FigureEntry("leg_channels:draw", "the leg's channels in run and model"),
            "groups": FigureEntry("group_response:draw", "movement of groups, and the leg's force on them"),
            "paths": FigureEntry("load_paths:draw", "load paths of run and model, to scale in height"),
            "springs": FigureEntry("spring_curves:draw", "force over shortening in run, law and model"),
            "bars": FigureEntry("paired_bars:draw", "impulse and energy in run and model"),
        },
    }
)
"""By the schema word of the document."""


def help_text() -> str:
    """Return one sentence on all figures."""
    results, extractions = FIGURES["certkit-result/1"], FIGURES["certkit-extraction/1"]
    listed = "; ".join(f"{name}: {entry.shows}" for name, entry in results.items())
    return f"{listed}. Of an extraction.json: {', '.join(extractions)}."
