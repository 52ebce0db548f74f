"""Report time: HTML and PDF of one procedure, over a plain page with as many figures by WeasyPrint."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from clock import Row, seconds_in_turn
from weasyprint import HTML

import certkit
from certkit.reporting.result_view import view
from certkit.reporting.writing import render

if TYPE_CHECKING:
    from collections.abc import Iterator


def rows() -> Iterator[Row]:
    """Yield the time of the plain page, that of our reports, and their ratio."""
    result = certkit.run("pendulum")
    shown = view(result)
    figures = [drawing.svg for drawing in shown.histories + shown.planes]
    figures += [drawing for drawing in (shown.frames, shown.errors, shown.energies) if drawing]
    plain_page = "<html><body>" + "".join(f"<p>Figure</p>{figure}" for figure in figures) + "</body></html>"
    with tempfile.TemporaryDirectory() as folder:
        plain, ours = seconds_in_turn(
            lambda: HTML(string=plain_page).write_pdf(),
            lambda: render(result, Path(folder), ["html", "pdf"]),
        )
    yield Row(f"WeasyPrint sets a plain page with {len(figures)} figures", plain, "s")
    yield Row("HTML and PDF of the pendulum test, over that page", ours / plain, "", 4)
