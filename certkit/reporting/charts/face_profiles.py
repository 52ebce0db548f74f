"""The faces of a front in run and model at a few instants, height over place."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.face_outline import outline_at
from certkit.reporting.charts.grid import side_by_side
from certkit.reporting.charts.lines import Line, lines_chart

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import SelfCheck
    from certkit.reporting.language import Translate
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0
INSTANTS = (0.010, 0.020, 0.030, 0.040)
"""s: when faces are drawn."""


def face_profiles(result: ExtractionResult, check: SelfCheck, t: Translate) -> Drawing | None:
    """Draw the faces that can touch the leg; None where nothing is known of their form."""
    moved = {found.name: found.displacement for found in check.groups}
    faced = [g for g in result.groups if g.outlines and g.name in moved and g.kind == "fascia"]
    if not faced:
        return None
    panels = []
    for instant in INSTANTS:
        if instant > check.until:
            continue
        lines: list[Line] = []
        for name, start, interval in (
            ("run", result.start, result.interval),
            ("model", check.start, check.interval),
        ):
            xs: list[float] = []
            zs: list[float] = []
            for group in sorted(faced, key=lambda g: g.low or 0.0):
                history = group.displacement if name == "run" else moved[group.name]
                so_far = history[: 1 + round((instant - start) / interval)]
                for x, z in outline_at(group, so_far[-1], max(so_far)):
                    xs.append(1e3 * z)
                    zs.append(1e3 * x)
            lines.append((t(name), xs, zs))
        title = t("Faces at {time} ms", time=f"{1e3 * instant:.0f}")
        panels.append(lines_chart(lines, title, t("height, mm"), "mm", width=WIDTH, height=HEIGHT))
    return side_by_side(panels, t("Faces of run and model"))
