"""Extraction of a vehicle from finite-element histories, as a page and as PDF, from its document alone.

The figures are those of the paper: momentum balance (17), force between groups (18), force over shortening
(19), and the stress–strain curve beside the material's own (20).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from certkit._version import __version__
from certkit.errors import MissingPartError
from certkit.files import write_whole
from certkit.reporting.attachments import Enclosure
from certkit.reporting.charts.extraction_charts import material_chart, momentum_chart, path_charts
from certkit.reporting.charts.run_and_model import leg_colours, run_and_model
from certkit.reporting.extraction_checks import check_views
from certkit.reporting.extraction_data import extraction_payload
from certkit.reporting.html_report import SCRIPTS
from certkit.reporting.left_out import leave_out
from certkit.reporting.page_data import embedded
from certkit.reporting.pdf_engine import typeset
from certkit.reporting.pdf_report import creation_date
from certkit.reporting.static_page import static_page
from certkit.reporting.templating import fill, text

if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

    from certkit.documents.extraction import PathResult
    from certkit.identification import ExtractionResult
    from certkit.reporting.svg import Drawing


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
    parts = _parts(result)
    data = extraction_payload(result, parts["worst"])
    return static_page(
        "extraction.html.j2",
        result.title,
        scripts=SCRIPTS if data else (),
        data=embedded(data) if data else None,
        **parts,
    )


def extraction_pdf(result: ExtractionResult) -> bytes:
    """Return the PDF, with the result document attached."""
    created = creation_date([])
    html = fill(
        "extraction-pdf.html.j2",
        title=result.title,
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        **_parts(result),
    )
    enclosed = Enclosure("extraction.json", "extraction result", result.to_json().encode(), "Data")
    return typeset(html, [enclosed], created)


def _parts(result: ExtractionResult) -> dict[str, Any]:
    return {
        "doc": result,
        "momentum": momentum_chart(result),
        "paths": [
            PathView(path, path_charts(result, path) if any(path.force) else []) for path in result.paths
        ],
        "material": material_chart(result.material) if result.material else None,
        "checks": check_views(result),
        "worst": _worst(result),
        "stills": run_and_model(result.motion) if result.motion else None,
        "colours": leg_colours(result.motion) if result.motion else None,
    }


def _worst(result: ExtractionResult) -> str | None:
    """Return the group whose movement in the coupled run, else in that of the front alone, errs most."""
    for check in reversed(result.checks):
        if check.groups:
            return check.groups[0].name
    return None
