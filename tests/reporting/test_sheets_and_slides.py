"""Workbooks and slides: the same bytes each time, native charts, no formula of a stranger, own templates."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import sys
import zipfile
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

import pytest
from support import synthetic_result
from support.synthetic_campaign import campaign, point, source, terms

from certkit.documents.comparison import AgreementCheck, ChannelRating, ComparisonDocument, Overlay, Side
from certkit.errors import LeftOutWarning, UsageError
from certkit.grading.judge_car import judge_car
from certkit.reporting.campaign_pptx import campaign_pptx
from certkit.reporting.campaign_xlsx import campaign_xlsx
from certkit.reporting.comparison_pptx import comparison_pptx
from certkit.reporting.comparison_xlsx import comparison_xlsx
from certkit.reporting.document_reports import render_document
from certkit.reporting.euro_ncap_leg_sheet import leg_rows
from certkit.reporting.pptx_report import write as result_pptx
from certkit.reporting.result_view import unique_views
from certkit.reporting.slide_deck import on_template
from certkit.reporting.xlsx_report import write as result_xlsx

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

pytest.importorskip("xlsxwriter", reason="the extra `xlsx` is not installed")
pytest.importorskip("pptx", reason="the extra `pptx` is not installed")

EVIL = "=cmd|' /C calc'!A0"


def comparison() -> ComparisonDocument:
    curve = [float(i) for i in range(20)]
    back = curve[::-1]
    difference = [b - a for a, b in zip(curve, back, strict=True)]
    return ComparisonDocument(
        title="b compared with a",
        reference=Side(label=EVIL, kind="measured"),
        other=Side(label="b", kind="simulated"),
        interval=(0.0, 0.1),
        ratings=[ChannelRating(channel="T1", title="tibia moment 1", overall=1 / 3)],
        rule="ours",
        checks=[AgreementCheck(kind="rating", title="ISO/TS 18571", value=1 / 3, lower=0.58, verdict="fail")],
        overlays=[
            Overlay(
                channel="T1",
                title="tibia moment 1",
                unit="N·m",
                filter="none",
                start=0.0,
                interval=1e-3,
                reference=curve,
                other=back,
                difference=difference,
            )
        ],
    )


def result() -> Any:  # noqa: ANN401  # one result in the list that formats take
    return unique_views([synthetic_result.result(title=EVIL)])


MAKERS: dict[str, Callable[[], bytes]] = {
    "result.xlsx": lambda: result_xlsx(result(), title=None, paper="A4"),
    "suite.xlsx": lambda: result_xlsx(result(), title="Suite", paper="A4"),
    "comparison.xlsx": lambda: comparison_xlsx(comparison()),
    "campaign.xlsx": lambda: campaign_xlsx(campaign()),
    "result.pptx": lambda: result_pptx(result(), title=None, paper="A4"),
    "comparison.pptx": lambda: comparison_pptx(comparison()),
    "campaign.pptx": lambda: campaign_pptx(campaign()),
}
BOOKS = [name for name in MAKERS if name.endswith("xlsx")]


@pytest.fixture(scope="module")
def made() -> dict[str, bytes]:
    return {name: make() for name, make in MAKERS.items()}


def parts(content: bytes, pattern: str) -> dict[str, bytes]:
    """Return the parts of an Office file, and of the workbooks inside it."""
    found = {}
    with zipfile.ZipFile(io.BytesIO(content)) as file:
        for name in file.namelist():
            data = file.read(name)
            if name.endswith(".xlsx"):
                found |= {f"{name}/{inner}": each for inner, each in parts(data, pattern).items()}
            elif re.search(pattern, name):
                found[name] = data
    return found


@pytest.mark.parametrize("name", MAKERS)
def test_the_same_document_makes_the_same_bytes(made: dict[str, bytes], name: str):
    assert MAKERS[name]() == made[name]


@pytest.mark.parametrize("name", MAKERS)
def test_no_part_says_when_or_where_it_was_made(made: dict[str, bytes], name: str):
    for part, data in parts(made[name], r"core\.xml$").items():
        assert set(re.findall(rb"\d{4}-\d\d-\d\dT", data)) == {b"1980-01-01T"}, part
    with zipfile.ZipFile(io.BytesIO(made[name])) as file:
        assert {item.date_time for item in file.infolist()} == {(1980, 1, 1, 0, 0, 0)}


@pytest.mark.parametrize("name", MAKERS)
def test_charts_are_native(made: dict[str, bytes], name: str):
    assert parts(made[name], r"charts/chart\d+\.xml$")


@pytest.mark.parametrize("name", MAKERS)
def test_no_cell_is_or_begins_a_formula(made: dict[str, bytes], name: str):
    sheets = parts(made[name], r"(worksheets/sheet\d+|sharedStrings)\.xml$")
    assert sheets
    for part, data in sheets.items():
        root = ET.fromstring(data)  # noqa: S314  # our own output
        texts = [each.text or "" for each in root.iter() if each.tag.endswith("}t")]
        assert not [text for text in texts if text.lstrip()[:1] in {"=", "+", "@"}], part
        assert not [each for each in root.iter() if each.tag.endswith("}f")], part


@pytest.mark.parametrize("name", BOOKS)
def test_numbers_are_numbers(made: dict[str, bytes], name: str):
    (first, *_rest) = parts(made[name], r"worksheets/sheet2\.xml$").values()
    cells = [each for each in ET.fromstring(first).iter() if each.tag.endswith("}c")]  # noqa: S314  # likewise
    assert any(cell.get("t") is None and len(cell) for cell in cells)


def test_the_leg_sheet_has_the_layout_of_euro_ncaps_own_workbook():
    femur = {"F1": 300.0, "F2": 310.0, "F3": 320.0}
    points = [
        point(name, -100.0 * column, *sources).model_copy(update={"column": column})
        for name, column, sources in (
            ("L+1", 1, [source("measured", **femur)]),
            ("L0", 0, []),
            ("L-1", -1, []),
        )
    ]
    scheme = judge_car(terms("euro-ncap-2026"), points, symmetric=True)
    rows = leg_rows(campaign().model_copy(update={"points": points}), scheme)
    assert len(rows) == 3 * 8
    assert rows[0] == [
        "Lower Leg",
        "Driver",
        "aPLI",
        "Femur",
        "(1, 1)",
        "Bending moment, F1",
        390,
        440,
        None,
        "T",
        300,
    ]
    assert [row[9] for row in rows if row[5] == "MCL elongation"] == ["T", "SA", "ST"]
    assert [row[3] for row in rows if row[3]] == ["Femur", "Knee", "Tibia"]
    assert [row[10] for row in rows if row[4] == "(2, 0)"] == [None] * 5


def test_the_car_on_a_slide_consists_of_shapes_that_can_be_moved(made: dict[str, bytes]):
    import pptx  # noqa: PLC0415  # an extra

    deck = pptx.Presentation(io.BytesIO(made["campaign.pptx"]))
    slide = next(slide for slide in deck.slides if "from ahead" in slide.shapes.title.text)
    kinds = [str(shape.shape_type).split(" ")[0] for shape in slide.shapes]
    assert kinds.count("FREEFORM") > 8
    assert kinds.count("AUTO_SHAPE") == len(campaign().points)
    assert "PICTURE" not in kinds


def test_slides_take_the_look_of_a_template(tmp_path: Path):
    import pptx  # noqa: PLC0415  # an extra

    own = pptx.Presentation()
    own.slide_width, own.slide_height = 7000000, 5000000
    own.save(str(tmp_path / "house.pptx"))
    with on_template(tmp_path / "house.pptx"):
        deck = pptx.Presentation(io.BytesIO(campaign_pptx(campaign())))
    assert (deck.slide_width, deck.slide_height) == (7000000, 5000000)
    shapes = [shape for slide in deck.slides for shape in slide.shapes]
    assert max(shape.left + shape.width for shape in shapes if shape.has_chart) <= 7000000
    (tmp_path / "no.pptx").write_text("no presentation")
    with on_template(tmp_path / "no.pptx"), pytest.raises(UsageError, match="no presentation"):
        campaign_pptx(campaign())


def test_what_is_not_installed_is_left_out_with_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    monkeypatch.setitem(sys.modules, "pptx", None)
    with pytest.warns(LeftOutWarning, match=r"pip install certkit\[") as told:
        written = render_document(campaign(), tmp_path, ["csv", "xlsx", "pptx"])
    assert [path.name for path in written] == ["campaign.csv"]
    assert len(told) == 2
    assert all("\n" not in str(each.message) for each in told)


@pytest.mark.slow
def test_an_office_program_opens_them(made: dict[str, bytes], tmp_path: Path):
    office = shutil.which("soffice")
    if office is None:
        pytest.skip("LibreOffice is not installed")
    for kind, ending in (("sheet", "xlsx"), ("slides", "pptx")):
        (tmp_path / f"{kind}.{ending}").write_bytes(made[f"campaign.{ending}"])
    words = [office, f"-env:UserInstallation=file://{tmp_path / 'home'}", "--headless", "--convert-to", "pdf"]
    words += ["--outdir", str(tmp_path / "made"), str(tmp_path / "sheet.xlsx"), str(tmp_path / "slides.pptx")]
    subprocess.run(words, check=True, capture_output=True, timeout=180)
    assert {path.stem for path in (tmp_path / "made").glob("*.pdf")} == {"sheet", "slides"}
