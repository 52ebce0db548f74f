"""The figures of an extraction: momentum of groups, impulse, force and stiffness of load paths, material."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.charts.chosen import chosen
from certkit.reporting.charts.grid import side_by_side, together
from certkit.reporting.charts.lines import Line, lines_chart, pressed
from certkit.reporting.language import Translate, english
from certkit.reporting.palette import GROUP_PENS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult, MaterialResult, PathResult
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0
MOST_LINES = 7
"""Of a panel."""


def momentum(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw the momentum of all groups."""
    chosen(names, [path.name for path in result.paths], "load path")
    return momentum_chart(result)


def impulse(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw the impulse through load paths, all that pushed or those that are named."""
    return _of_paths(result, names, 0, "impulse")


def force(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw the force of load paths over time."""
    return _of_paths(result, names, 1, "force")


def stiffness(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw the force of load paths over their shortening."""
    return _of_paths(result, names, 2, "stiffness")


def material(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw stress over strain; None where no material was asked for."""
    chosen(names, [path.name for path in result.paths], "load path")
    return material_chart(result.material) if result.material else None


def _of_paths(result: ExtractionResult, names: Sequence[str], place: int, what: str) -> Drawing | None:
    known = {path.name: path for path in result.paths}
    wanted = [known[name] for name in chosen(names, known, "load path")]
    pushed = wanted if names else [path for path in wanted if any(path.force)]
    sets = [path_charts(result, path, head=path.name) for path in pushed]
    return together([drawn[place] for drawn in sets if len(drawn) > place], f"{what} of {result.title}")


def _milliseconds(result: ExtractionResult) -> list[float]:
    return [t * 1e3 for t in result.times]


def momentum_chart(result: ExtractionResult, t: Translate = english) -> Drawing | None:
    """Draw the momenta over time in panels by kind; each group has a pen of its own in all of them."""
    times = _milliseconds(result)
    pens = {group.name: GROUP_PENS[k % len(GROUP_PENS)] for k, group in enumerate(result.groups)}
    panels = []
    for kind in dict.fromkeys(group.kind for group in result.groups):
        groups = [group for group in result.groups if group.kind == kind]
        for start in range(0, len(groups), MOST_LINES):
            part = groups[start : start + MOST_LINES]
            lines: list[Line] = [(g.name, times, g.momentum) for g in part]
            own = [pens[g.name] for g in part]
            title = f"{t('Momentum')}, {t(kind)}"
            panels.append(lines_chart(lines, title, "ms", "N·s", width=WIDTH, height=HEIGHT, pens=own))
    return side_by_side(panels, t("Momentum of the groups")) if panels else None


def path_charts(
    result: ExtractionResult, path: PathResult, t: Translate = english, *, head: str = ""
) -> list[Drawing]:
    """Draw a load path: impulse and force over time and, where its ends came nearer, force over shortening.

    Parameters
    ----------
    result : ExtractionResult
        Has the times.
    path : PathResult
        One of its load paths.
    head : str
        Title of each; what is drawn when empty.
    """
    times = _milliseconds(result)
    forces: list[Line] = [(t("from momentum"), times, path.force)]
    if path.recorded_force is not None:
        forces.append((t("recorded contact"), times, path.recorded_force))
    shortening, pushed = pressed([v * 1e3 for v in path.shortening], path.force)
    laws: list[Line] = [("history", shortening, pushed)]
    if path.law:
        law = ([v * 1e3 for v in path.law.shortening], path.law.force)
        laws.append(("law", *_up_to(1.1 * max(shortening, default=0.0), *law)))
    drawn = [
        lines_chart(
            [(t("impulse"), times, path.impulse)],
            head or t("Impulse"),
            "ms",
            "N·s",
            width=WIDTH,
            height=HEIGHT,
        ),
        lines_chart(forces, head or t("Force"), "ms", "N", width=WIDTH, height=HEIGHT),
    ]
    if path.sheet is not None:
        lines: list[Line] = [("path", [1e3 * at for at in path.sheet.progress], path.sheet.force)]
        drawn.append(
            lines_chart(lines, head or "Sheet, pushed in", "progress, mm", "N", width=WIDTH, height=HEIGHT)
        )
    elif any(path.shortening):  # a contact between groups that merely touch has none
        drawn.append(
            lines_chart(laws, head or "Stiffness", "shortening, mm", "N", width=WIDTH, height=HEIGHT)
        )
    return drawn


def material_chart(material: MaterialResult, t: Translate = english) -> Drawing:
    """Draw the stress found over strain, beside the material's own curve where there is one."""
    lines: list[Line] = [(t("extracted"), material.strain, [v / 1e6 for v in material.stress])]
    if material.unloading_strain:
        unloading = pressed(material.unloading_strain, material.unloading_stress)
        lines.append((t("extracted, unloading"), unloading[0], [v / 1e6 for v in unloading[1]]))
    if material.reference_strain:
        farthest = 1.1 * max(material.strain, default=0.0)
        own = _up_to(farthest, material.reference_strain, material.reference_stress)
        lines.append((t("material's own curve"), own[0], [v / 1e6 for v in own[1]]))
    return lines_chart(lines, t("Stress over strain"), t("engineering strain"), "MPa")


def _up_to(end: float, xs: Sequence[float], ys: Sequence[float]) -> tuple[list[float], list[float]]:
    """Cut a law where the test ended: what it says beyond would squeeze what was seen."""
    kept = [(x, y) for x, y in zip(xs, ys, strict=True) if x <= end]
    return [x for x, _ in kept], [y for _, y in kept]
