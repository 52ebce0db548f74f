"""A group of a front over time in run and model: how it moves, and how the leg presses on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.charts.chosen import chosen
from certkit.reporting.charts.grid import together
from certkit.reporting.charts.lines import Line, lines_chart
from certkit.reporting.coupled_check import CONTACT, check_of, check_times, group_of
from certkit.reporting.language import Translate, english

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult, PathResult
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0
STILL = 1e-3
"""m: the movement of a group that moves by less is not drawn."""


def draw(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw movement and contact force of all groups or those that are named, the worst first."""
    check = check_of(result, "coupled") or check_of(result, "front alone")
    if check is None:
        return None
    wanted = chosen(names, [group.name for group in check.groups], "group")
    panels = [panel for name in wanted for panel in (movement(result, name), contact(result, name)) if panel]
    return together(panels, f"Groups of the front in run and model, {result.title}")


def movement(result: ExtractionResult, name: str, t: Translate = english) -> Drawing | None:
    """Draw how a group moves in the run, the coupled model and the front alone; None for one at rest."""
    group = next((g for g in result.groups if g.name == name), None)
    if group is None:
        return None
    checks = ((t("model"), check_of(result, "coupled")), (t("front alone"), check_of(result, "front alone")))
    found = [(words, check, group_of(check, name)) for words, check in checks]
    until = max((check.until for _, check, _ in found if check), default=0.0)
    if max((g.run_peak for _, _, g in found if g), default=0.0) < STILL:
        return None
    kept = [k for k, t in enumerate(result.times) if t <= until + 1e-9]
    times = result.times
    lines: list[Line] = [
        (t("run"), [1e3 * times[k] for k in kept], [1e3 * group.displacement[k] for k in kept])
    ]
    for words, check, own in found:
        if check and own and own.displacement:
            axis = check_times(check, len(own.displacement))
            lines.append((words, axis, [1e3 * x for x in own.displacement]))
    return lines_chart(lines, t("{name} moves", name=name), "ms", "mm", width=WIDTH, height=HEIGHT)


def contact(result: ExtractionResult, name: str, t: Translate = english) -> Drawing | None:
    """Draw the leg's force on a group in run, model and contact alone; None for one that is not touched."""
    check = check_of(result, "coupled")
    own = group_of(check, name)
    path = contact_path(result, name)
    if check is None or own is None or path is None or not own.force:
        return None
    kept = [k for k, t in enumerate(result.times) if t <= check.until + 1e-9]
    run = [path.force[k] for k in kept]
    if not any(run) and not any(own.force):
        return None
    lines: list[Line] = [
        (t("run"), [1e3 * result.times[k] for k in kept], run),
        (t("model"), check_times(check, len(own.force)), own.force),
    ]
    led = check_of(result, CONTACT)
    alone = group_of(led, name)
    if led and alone and alone.force:
        lines.append((t(CONTACT), check_times(led, len(alone.force)), alone.force))
    return lines_chart(
        lines,
        t("{impactor} on {name}", impactor=path.source[0].upper() + path.source[1:], name=name),
        "ms",
        "N",
        width=WIDTH,
        height=HEIGHT,
    )


def contact_path(result: ExtractionResult, name: str) -> PathResult | None:
    """Return the path from the impactor to a group."""
    impactors = {group.name for group in result.groups if group.kind == "impactor"}
    return next((p for p in result.paths if p.source in impactors and p.target == name), None)
