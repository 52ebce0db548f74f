"""Extraction of a vehicle from finite-element histories, as a page and on paper, from its result alone.

The figures are those of the paper: momentum balance (17), force between groups (18), force over shortening
(19), and the stress–strain curve beside the material's own (20).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from certkit._version import __version__
from certkit.errors import MissingPartError, UsageError
from certkit.files import write_whole
from certkit.reporting.attachments import Enclosure
from certkit.reporting.charts.grid import sheet as side_by_side
from certkit.reporting.charts.lines import Line, lines_chart
from certkit.reporting.extraction_checks import check_views
from certkit.reporting.left_out import leave_out
from certkit.reporting.palette import PENS
from certkit.reporting.pdf_engine import typeset
from certkit.reporting.pdf_report import creation_date
from certkit.reporting.static_page import sheet
from certkit.reporting.templating import fill, text

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    from certkit.documents.extraction import MaterialResult, PathResult
    from certkit.identification import ExtractionResult
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0


@dataclass(frozen=True)
class PathView:
    """A load path with its figures."""

    path: PathResult
    drawings: list[Drawing]


def render_extraction(result: ExtractionResult, out: Path, formats: Collection[str]) -> list[Path]:
    """Write `extraction.html` and `extraction.pdf` as wanted.

    Returns
    -------
    list of Path
        What was written; the PDF is left out with a `LeftOutWarning` where a library for it is missing.
    """
    written = []
    if "html" in formats:
        written.append(out / "extraction.html")
        write_whole(written[-1], extraction_page(result))
    if "pdf" in formats:
        try:
            content = extraction_pdf(result)
        except MissingPartError as error:
            leave_out("extraction.pdf", error)
        else:
            written.append(out / "extraction.pdf")
            write_whole(written[-1], content)
    return written


def extraction_page(result: ExtractionResult) -> str:
    """Return the page."""
    return sheet("extraction.html.j2", result.title, **_parts(result))


def extraction_pdf(result: ExtractionResult) -> bytes:
    """Return the PDF, with the result document attached."""
    created = creation_date([])
    html = fill(
        "extraction-paper.html.j2",
        title=result.title,
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        **_parts(result),
    )
    enclosed = Enclosure("extraction.json", "extraction result", result.to_json().encode(), "Data")
    return typeset(html, [enclosed], created)


EXTRACTION_FIGURES = ("momentum", "impulse", "force", "stiffness", "material")


def extraction_drawing(result: ExtractionResult, what: str, paths: Sequence[str]) -> Drawing | None:
    """Draw one figure of an extraction, over all load paths that pushed or only those named.

    Raises
    ------
    UsageError
        When a path is not one of the extraction's.
    """
    known = {path.name: path for path in result.paths}
    for name in paths:
        if name not in known:
            raise UsageError(f"there is no load path `{name}`; there are {', '.join(known) or 'none'}")
    times = [t * 1e3 for t in result.times]
    if what == "momentum":
        return _momentum(result, times)
    if what == "material":
        return _material(result.material) if result.material else None
    place = EXTRACTION_FIGURES.index(what) - 1
    chosen = [known[name] for name in paths] or [path for path in result.paths if any(path.force)]
    sets = [_drawings(path, times, head=path.name) for path in chosen]
    drawn = [drawings[place] for drawings in sets if len(drawings) > place]
    if len(drawn) < 2:
        return drawn[0] if drawn else None
    return side_by_side(drawn, f"{what} of {result.title}")


def _momentum(result: ExtractionResult, times: list[float]) -> Drawing | None:
    """Draw the momenta in panels by kind, so that no two groups of a panel share a pen."""
    panels = []
    for kind in dict.fromkeys(group.kind for group in result.groups):
        groups = [group for group in result.groups if group.kind == kind]
        for start in range(0, len(groups), len(PENS)):
            lines: list[Line] = [(g.name, times, g.momentum) for g in groups[start : start + len(PENS)]]
            title = f"Momentum, {kind}"
            panels.append(lines_chart(lines, title, "ms", "N·s", width=WIDTH, height=HEIGHT))
    return side_by_side(panels, "Momentum of the groups") if panels else None


def _parts(result: ExtractionResult) -> dict[str, Any]:
    times = [t * 1e3 for t in result.times]
    return {
        "doc": result,
        "momentum": _momentum(result, times),
        "paths": [PathView(path, _drawings(path, times) if any(path.force) else []) for path in result.paths],
        "material": _material(result.material) if result.material else None,
        "checks": check_views(result),
    }


def _drawings(path: PathResult, times: list[float], *, head: str = "") -> list[Drawing]:
    forces: list[Line] = [("from momentum", times, path.force)]
    if path.recorded_force is not None:
        forces.append(("recorded contact", times, path.recorded_force))
    shortening, pushed = _pushing([v * 1e3 for v in path.shortening], path.force)
    laws: list[Line] = [("history", shortening, pushed)]
    if path.law:
        law = ([v * 1e3 for v in path.law.shortening], path.law.force)
        laws.append(("law", *_up_to(1.1 * max(shortening, default=0.0), *law)))
    size = {"width": WIDTH, "height": HEIGHT}
    drawn = [
        lines_chart([("impulse", times, path.impulse)], head or "Impulse", "ms", "N·s", **size),
        lines_chart(forces, head or "Force", "ms", "N", **size),
    ]
    if path.sheet is not None:
        lines: list[Line] = [("path", [1e3 * at for at in path.sheet.progress], path.sheet.force)]
        drawn.append(lines_chart(lines, head or "Sheet, pushed in", "progress, mm", "N", **size))
    elif any(path.shortening):  # a contact between groups that merely touch has none
        drawn.append(lines_chart(laws, head or "Stiffness", "shortening, mm", "N", **size))
    return drawn


def _material(material: MaterialResult) -> Drawing:
    lines: list[Line] = [("extracted", material.strain, [v / 1e6 for v in material.stress])]
    if material.unloading_strain:
        unloading = _pushing(material.unloading_strain, material.unloading_stress)
        lines.append(("extracted, unloading", unloading[0], [v / 1e6 for v in unloading[1]]))
    if material.reference_strain:
        farthest = 1.1 * max(material.strain, default=0.0)
        own = _up_to(farthest, material.reference_strain, material.reference_stress)
        lines.append(("material's own curve", own[0], [v / 1e6 for v in own[1]]))
    return lines_chart(lines, "Stress over strain", "engineering strain", "MPa")


def _pushing(xs: Sequence[float], ys: Sequence[float]) -> tuple[list[float], list[float]]:
    """Leave out how two groups fly apart: far, and without a force worth drawing."""
    least = 0.01 * max((abs(y) for y in ys), default=0.0)
    kept = [(x, y) for x, y in zip(xs, ys, strict=True) if x >= 0 or abs(y) > least]
    return [x for x, _ in kept], [y for _, y in kept]


def _up_to(end: float, xs: Sequence[float], ys: Sequence[float]) -> tuple[list[float], list[float]]:
    """Cut a law where the test ended: what it says beyond would squeeze what was seen."""
    kept = [(x, y) for x, y in zip(xs, ys, strict=True) if x <= end]
    return [x for x, _ in kept], [y for _, y in kept]
