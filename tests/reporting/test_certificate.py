from __future__ import annotations

import datetime as dt
import hashlib
import io
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Self

import pikepdf
import pypdfium2.raw as pdfium
import pytest
from support import synthetic_result

from certkit.documents.result import Result
from certkit.errors import LeftOutWarning, MissingPartError, UsageError
from certkit.reporting import pdf_engine as typesetting
from certkit.reporting.attachments import MANIFEST
from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import unique_views
from certkit.reporting.writing import render


@pytest.fixture(scope="module")
def made() -> bytes:
    return certificate(unique_views([synthetic_result.laboratory_result()]))


@pytest.fixture(scope="module")
def pdf(made: bytes) -> Iterator[pikepdf.Pdf]:
    with pikepdf.open(io.BytesIO(made)) as document:
        yield document


def attachments(pdf: pikepdf.Pdf) -> dict[str, bytes]:
    return {name: spec.get_file().read_bytes() for name, spec in pdf.attachments.items()}


def text_of(made: bytes, tmp_path: Path) -> str:
    program = shutil.which("pdftotext")
    if program is None:
        pytest.skip("pdftotext (poppler-utils) is not installed")
    path = tmp_path / "report.pdf"
    path.write_bytes(made)
    return subprocess.run([program, "-layout", path, "-"], check=True, capture_output=True, text=True).stdout


def test_it_says_to_be_pdf_a_3a_with_its_structure(pdf: pikepdf.Pdf):
    with pdf.open_metadata() as metadata:
        assert metadata["pdfaid:part"] == "3"
        assert metadata["pdfaid:conformance"] == "A"
    assert pdf.Root.MarkInfo.Marked
    assert "/StructTreeRoot" in pdf.Root
    assert str(pdf.Root.Lang) == "en"


def test_its_colours_have_an_output_intent(pdf: pikepdf.Pdf):
    assert pdf.Root.OutputIntents[0].S == "/GTS_PDFA1"


def test_every_font_is_embedded(pdf: pikepdf.Pdf):
    fonts = [
        descendant.FontDescriptor
        for page in pdf.pages
        for font in page.Resources.get("/Font", {}).values()
        for descendant in font.DescendantFonts
    ]
    assert fonts
    assert all("/FontFile2" in font or "/FontFile3" in font for font in fonts)


def test_it_carries_result_definitions_and_channels(pdf: pikepdf.Pdf):
    assert set(attachments(pdf)) == {
        "result.json",
        "procedure-pendulum.yaml",
        "legform-flex-pli-gtr.yaml",
        "corridors-r127-pendulum.yaml",
        "reference-seed-table-1.yaml",
        "channels.csv",
        MANIFEST,
    }


def test_the_list_of_attachments_has_their_right_hashes(pdf: pikepdf.Pdf):
    files = attachments(pdf)
    listed = json.loads(files.pop(MANIFEST))["attachments"]
    assert {entry["name"]: entry["sha256"] for entry in listed} == {
        name: hashlib.sha256(content).hexdigest() for name, content in files.items()
    }


def test_every_attachment_says_how_it_relates_to_the_certificate(pdf: pikepdf.Pdf):
    relations = {str(spec.obj.AFRelationship) for spec in pdf.attachments.values()}
    assert relations == {"/Data", "/Source", "/Supplement"}
    assert len(pdf.Root.AF) == len(pdf.attachments)


def test_the_attached_result_renders_to_the_same_reports(tmp_path: Path):
    render(synthetic_result.result().as_written(), tmp_path / "first", ["html", "pdf"])
    with pikepdf.open(tmp_path / "first" / "report.pdf") as pdf:
        attached = Result.from_json(attachments(pdf)["result.json"])
    render(attached.as_written(), tmp_path / "again", ["html", "pdf"])
    for name in ("report.html", "report.pdf"):
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "first" / name).read_bytes()


def test_pages_are_labelled_as_they_are_numbered(pdf: pikepdf.Pdf):
    assert [page.label for page in pdf.pages] == [str(n + 1) for n in range(len(pdf.pages))]


def test_bookmarks_lead_to_the_title_and_its_sections(pdf: pikepdf.Pdf):
    with pdf.open_outline() as outline:
        assert outline.root[0].title == "Dynamic certification, pendulum test"
        assert "Results" in [item.title for item in outline.root[0].children]


def test_the_text_has_verdict_id_and_every_criterion(made: bytes, tmp_path: Path):
    text = text_of(made, tmp_path)
    assert "FAIL" in text.split("\f")[0]
    assert "PASS" not in text
    assert f"End of report {synthetic_result.laboratory_result().id}" in text
    for criterion in synthetic_result.laboratory_result().criteria:
        assert re.search(rf"\b{criterion.id}\b", text)


def test_every_page_bears_the_id_and_its_number_of_the_total(made: bytes, tmp_path: Path):
    pages = text_of(made, tmp_path).split("\f")[:-1]
    for number, page in enumerate(pages, 1):
        assert f"Test report {synthetic_result.laboratory_result().id}" in page
        assert f"Page {number} of {len(pages)}" in page


def test_the_laboratory_and_its_customer_are_named(made: bytes, tmp_path: Path):
    text = text_of(made, tmp_path)
    assert "Laboratory of Examples" in text
    assert "Bumper & <Sons>" in text


def test_repeating_gives_the_same_bytes(made: bytes):
    assert certificate(unique_views([synthetic_result.laboratory_result()])) == made


def test_another_day_gives_the_same_bytes(monkeypatch: pytest.MonkeyPatch):
    first = certificate(unique_views([synthetic_result.static_result()]))

    class Tomorrow(dt.datetime):
        @classmethod
        def now(cls, tz: dt.tzinfo | None = None) -> Self:
            return super().now(tz) + dt.timedelta(days=400)

    monkeypatch.setattr(dt, "datetime", Tomorrow)
    assert certificate(unique_views([synthetic_result.static_result()])) == first


@pytest.mark.pdf
def test_another_process_gives_the_same_bytes(tmp_path: Path):
    code = (
        "import sys; sys.path.insert(0, sys.argv[1]); from support import synthetic_result;"
        "from pathlib import Path;"
        "from certkit.reporting.pdf_report import certificate;"
        "from certkit.reporting.result_view import unique_views;"
        "Path(sys.argv[2]).write_bytes(certificate(unique_views([synthetic_result.static_result()])))"
    )
    folder = str(Path(synthetic_result.__file__).parents[1])
    subprocess.run([sys.executable, "-c", code, folder, tmp_path / "x.pdf"], check=True)
    assert (tmp_path / "x.pdf").read_bytes() == certificate(unique_views([synthetic_result.static_result()]))


def test_source_date_epoch_becomes_the_date(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    with pikepdf.open(io.BytesIO(certificate(unique_views([synthetic_result.static_result()])))) as pdf:
        assert str(pdf.docinfo.CreationDate).startswith("D:20231114")


def test_the_day_of_issue_becomes_the_date(pdf: pikepdf.Pdf):
    assert str(pdf.docinfo.CreationDate).startswith("D:20260305")


def test_a_source_date_epoch_that_is_no_number_is_refused(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    with pytest.raises(UsageError, match="SOURCE_DATE_EPOCH is `yesterday`"):
        certificate(unique_views([synthetic_result.static_result()]))


def test_solver_time_leaves_no_trace():
    slow = synthetic_result.document()
    slow["quality"]["solver_seconds"] = 99.0
    assert certificate(unique_views([Result.model_validate(slow).with_id()])) == certificate(
        unique_views([synthetic_result.result()])
    )


def test_a_suite_begins_with_its_contents(tmp_path: Path):
    results = [synthetic_result.result(), synthetic_result.static_result()]
    made = certificate(unique_views(results), title="Certification suite", paper="Letter")
    pages = text_of(made, tmp_path).split("\f")
    assert "Certification suite" in pages[0]
    assert all(result.id in pages[0] for result in results)
    with pikepdf.open(io.BytesIO(made)) as pdf:
        assert [float(v) for v in pdf.pages[0].MediaBox] == [0, 0, 612, 792]
        assert {"pendulum-result.json", "static-femur-result.json"} <= set(pdf.attachments)


def test_the_default_paper_is_a4(pdf: pikepdf.Pdf):
    assert [round(float(v)) for v in pdf.pages[0].MediaBox] == [0, 0, 595, 842]


def test_nothing_outside_the_fonts_folder_is_fetched():
    fetcher = typesetting._fetcher(typesetting.weasyprint())
    outside = (typesetting.folder().parent / "pyproject.toml").as_uri()
    climbing = (typesetting.folder() / "fonts").as_uri() + "/../certificate.html.j2"
    for address in ("https://example.org/x.png", outside, climbing, "data:text/html,x"):
        with pytest.raises(ValueError, match="fetches nothing"):
            fetcher.fetch(address)


@pytest.fixture
def without_pango(monkeypatch: pytest.MonkeyPatch) -> None:
    real = __import__

    def no_pango(name: str, *arguments: Any, **keywords: Any) -> Any:  # noqa: ANN401  # anything at all
        if name == "weasyprint":
            raise OSError("cannot load library 'libpango-1.0-0'")
        return real(name, *arguments, **keywords)

    monkeypatch.setattr("builtins.__import__", no_pango)


@pytest.mark.usefixtures("without_pango")
def test_without_pango_the_message_says_how_to_install_it():
    with pytest.raises(MissingPartError, match="apt install libpango"):
        certificate(unique_views([synthetic_result.static_result()]))


@pytest.mark.usefixtures("without_pango")
def test_without_pango_all_other_reports_are_written_and_one_remark_says_so(tmp_path: Path):
    with pytest.warns(LeftOutWarning, match=r"report\.pdf is not written: the PDF needs the Pango library"):
        written = render(
            synthetic_result.static_result().as_written(), tmp_path, ["pdf", "html", "md", "junit"]
        )
    assert {path.name for path in written} == {"junit.xml", "summary.md", "report.html"}


MEASURED = Path(__file__).parents[2] / "examples" / "measured"


@pytest.fixture(scope="module")
def measured() -> Result:
    import certkit  # noqa: PLC0415  # numba waits until it is needed

    data = MEASURED / "FLX-0007-pendulum.zip"
    return certkit.grade("pendulum", data, laboratory=MEASURED / "lab.yaml")


def test_a_test_report_has_four_pages_at_most_and_then_its_annex(measured: Result, tmp_path: Path):
    pages = text_of(certificate(unique_views([measured])), tmp_path).split("\f")[:-1]
    annex = next(number for number, page in enumerate(pages) if "Annex: processing" in page)
    assert annex <= 4
    assert "Annex" not in "".join(pages[:annex])
    cover = pages[0]
    for said in (
        "Test report",
        "Report 2026-014, revision 0",
        "issued on 2026-03-03",
        "Example Crash Laboratory",
        "Example Motors",
        "FLX-0007",
        "2026-02-23",
        "2026-03-02",
        "relate only to the item tested",
        "guard band",
        "A. Tester",
        "B. Signatory",
    ):
        assert said in cover
    assert "certkit" not in "".join(pages[:annex])
    assert all("Example Crash Laboratory" in page for page in pages)
    assert any("Calibration due" in page and "SG-11" in page for page in pages[:annex])


def test_numbers_of_the_simulations_rig_do_not_stand_in_a_measured_report(measured: Result):
    assert measured.parameters
    assert not [number.path for number in measured.parameters if ": rig." in number.path]


@pytest.mark.parametrize(
    ("kind", "called"),
    [
        ("test evaluation", "Test report"),
        ("virtual test", "Virtual test report"),
        ("virtual certification", "Model validation report"),
    ],
)
def test_a_report_is_called_what_it_is_in_title_and_header(kind: str, called: str):
    shown = unique_views([synthetic_result.static_result().model_copy(update={"kind": kind})])
    assert shown[0].heading == called
    with pikepdf.open(io.BytesIO(certificate(shown))) as pdf:
        assert str(pdf.docinfo.Title).startswith(f"{called} ")


def figures(element: pikepdf.Object) -> Iterator[pikepdf.Object]:
    """Walk through the structure tree and yield its figures."""
    if isinstance(element, pikepdf.Array):
        for child in element:
            yield from figures(child)
    elif isinstance(element, pikepdf.Dictionary):
        if element.get("/S") == "/Figure":
            yield element
        if "/K" in element and element.get("/Type") != "/MCR":
            yield from figures(element.K)


def test_every_figure_has_a_text_alternative_(made: bytes):
    """What PDF/UA asks of the structure, read by pikepdf."""
    with pikepdf.open(io.BytesIO(made)) as pdf:
        found = list(figures(pdf.Root.StructTreeRoot.K))
        assert len(found) > 10
        assert [figure for figure in found if not str(figure.get("/Alt", ""))] == []


def test_two_independent_readers_find_its_structure(made: bytes, tmp_path: Path):
    """Poppler and PDFium; veraPDF is in none of the package registries."""
    program = shutil.which("pdfinfo")
    if program is None:
        pytest.skip("pdfinfo (poppler-utils) is not installed")
    path = tmp_path / "report.pdf"
    path.write_bytes(made)
    told = subprocess.run([program, path], check=True, capture_output=True, text=True)
    assert re.search(r"Tagged:\s+yes", told.stdout)
    assert re.search(r"JavaScript:\s+no", told.stdout)
    assert told.stderr == ""
    structure = subprocess.run([program, "-struct", path], check=True, capture_output=True, text=True)
    assert structure.stdout.lstrip().startswith("Document")
    document = pdfium.FPDF_LoadMemDocument(made, len(made), None)
    page = pdfium.FPDF_LoadPage(document, 0)
    tree = pdfium.FPDF_StructTree_GetForPage(page)
    assert pdfium.FPDFCatalog_IsTagged(document)
    assert pdfium.FPDF_StructTree_CountChildren(tree) > 0
    pdfium.FPDF_StructTree_Close(tree)
    pdfium.FPDF_ClosePage(page)
    pdfium.FPDF_CloseDocument(document)
