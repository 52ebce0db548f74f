from __future__ import annotations

import io
import re
import shutil
import subprocess
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pikepdf
import pypdfium2
import pytest
from support import synthetic_result

from certkit.reporting import pdf_engine
from certkit.reporting.pdf_drawing import is_known, split_drawings
from certkit.reporting.pdf_report import FIXED_DATE, certificate
from certkit.reporting.result_view import unique_views
from certkit.reporting.svg import Drawing, label, path, tag

DRAWN = (
    tag("rect", x=10, y=10, width=60, height=30, fill="#d5e8de")
    + tag("path", d=path([(5, 90), (60, 20), (120, 80)]), fill="none", stroke="#0b5cad", stroke_width=3)
    + tag("path", d="M150 10h30v30H150z M160 60V80", fill="#b32", stroke="#16202c", stroke_dasharray="4 3")
    + tag("circle", cx=150, cy=70, r=15, fill="#855300", fill_opacity=0.4)
    + tag("line", x1=0, y1=95, x2=190, y2=95, stroke="#536070", stroke_width=0.6)
    + tag(
        "g", label(100, 50, "middle · 12 N·m") + label(100, 65, "both"), text_anchor="middle", fill="#0a6847"
    )
    + label(190, 15, "right", text_anchor="end", font_weight="600", font_size="14")
)


def read_xml(text: str) -> ET.Element:
    return ET.fromstring(text)  # noqa: S314  # markup of our own


def page(drawing: str) -> str:
    style = "@page { size: 200px 100px; margin: 0 } body { margin: 0 } svg, img { display: block }"
    faces = [
        line
        for line in pdf_engine.text("styles/certificate.css").splitlines()
        if line.startswith("@font-face")
    ]
    return (
        f'<html lang="en"><head><style>{"".join(faces)} {style}</style></head><body>{drawing}</body></html>'
    )


def dots(pdf: bytes) -> np.ndarray:
    document = pypdfium2.PdfDocument(pdf)
    return document[0].render(scale=3).to_numpy().astype(int)


def test_a_drawing_looks_as_the_typesetters_own_reader_of_svg_shows_it(monkeypatch: pytest.MonkeyPatch):
    drawing = str(Drawing(200, 100, DRAWN, "all of it"))
    ours = dots(pdf_engine.typeset(page(drawing), [], FIXED_DATE))
    monkeypatch.setattr(pdf_engine, "is_known", lambda _: False)
    theirs = dots(pdf_engine.typeset(page(drawing), [], FIXED_DATE))
    assert theirs.min() < 100
    # Edges of centred text may be a shade off, since it is placed otherwise; a missing line is 0.005.
    assert np.mean(np.abs(ours - theirs) > 40) < 0.002


def test_a_label_that_stands_in_many_drawings_is_set_once(monkeypatch: pytest.MonkeyPatch):
    made = []
    real = pdf_engine.Labels._new
    monkeypatch.setattr(
        pdf_engine.Labels, "_new", lambda self, *given: made.append(given[1]) or real(self, *given)
    )
    pdf_engine.typeset(page(str(Drawing(200, 100, label(5, 50, "50"), "one")) * 5), [], FIXED_DATE)
    assert made == ["50"]


def test_a_drawing_with_anything_else_in_it_is_left_to_the_typesetter():
    known = str(Drawing(200, 100, DRAWN, "known"))
    assert is_known(read_xml(known))
    for other in (
        '<ellipse rx="3"/>',
        '<path d="M0 0A3 3 0 0 0 9 9"/>',
        '<rect fill="url(#x)"/>',
        '<g transform="x"/>',
    ):
        assert not is_known(read_xml(known.replace("</svg>", f"{other}</svg>")))


def test_a_page_is_parted_at_its_outermost_drawings():
    inner = '<svg a="1"><svg b="2"></svg><g/></svg>'
    parts = list(split_drawings(f"<p>x</p>{inner}y{inner}"))
    assert [part for part, drawn in parts if drawn] == [inner, inner]
    assert "".join(part for part, _ in parts) == f"<p>x</p>{inner}y{inner}"


def test_a_typesetter_without_its_inner_parts_draws_by_itself_and_one_line_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    def gone() -> None:
        raise ImportError("cannot import name 'draw_first_line'")

    monkeypatch.setattr(pdf_engine, "engine", gone)
    pdf_engine.own_drawings.cache_clear()
    shown = unique_views([synthetic_result.static_result()])
    with pikepdf.open(io.BytesIO(certificate(shown))) as pdf:
        assert len(pdf.pages) > 2
    certificate(shown)
    pdf_engine.own_drawings.cache_clear()
    told = capsys.readouterr().err.splitlines()
    assert [line for line in told if "draw_first_line" in line] == told
    assert len(told) == 1


def test_every_page_for_paper_is_read_as_xml(monkeypatch: pytest.MonkeyPatch):
    read = []
    real = pdf_engine._read
    monkeypatch.setattr(
        pdf_engine, "_read", lambda module, html: read.append(read_xml(html)) or real(module, html)
    )
    views = unique_views([synthetic_result.laboratory_result(), synthetic_result.static_result()])
    certificate(views, title="Two & <tests>")
    assert len(read) == 3


def test_signs_that_xml_does_not_allow_are_set_all_the_same():
    document = synthetic_result.static_result().model_copy(update={"title": "bell \x07 rung"})
    with pikepdf.open(io.BytesIO(certificate(unique_views([document])))) as pdf:
        assert re.search("bell . ?rung|bell  ?rung", str(pdf.docinfo.Title))


def test_a_certificate_does_not_depend_on_those_set_before():
    first = certificate(unique_views([synthetic_result.static_result()]))
    certificate(unique_views([synthetic_result.laboratory_result()]))
    assert certificate(unique_views([synthetic_result.static_result()])) == first


def test_numbers_that_went_in_are_text_by_rows_and_no_figures(tmp_path: Path):
    program = shutil.which("pdftotext")
    if program is None:
        pytest.skip("pdftotext (poppler-utils) is not installed")
    document = synthetic_result.result()
    (tmp_path / "report.pdf").write_bytes(certificate(unique_views([document])))
    said = subprocess.run(
        [program, "-raw", tmp_path / "report.pdf", "-"], check=True, capture_output=True, text=True
    )
    words = " ".join(said.stdout.split())
    assert document.parameters
    for number in document.parameters:
        name = number.path.partition(": ")[2] or number.path
        assert f"{name} {number.value} {number.confidence} [" in words
