"""What was changed since certkit wrote it is refused, or marked on everything that is made of it."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pypdfium2
import pytest
from support import synthetic_result
from typer.testing import CliRunner

from certkit import grade
from certkit.cli.commands import whole_app
from certkit.documents.unverified import MARK
from certkit.errors import DataError

MEASURED = Path(__file__).parents[2] / "examples" / "measured"


@pytest.fixture
def changed(tmp_path: Path) -> Path:
    path = tmp_path / "result.json"
    result = grade("pendulum", MEASURED / "FLX-0007-pendulum.zip")
    path.write_text(result.model_copy(update={"verdict": "fail"}).to_json(), encoding="utf-8")
    return path


def command(*words: object) -> None:
    done = CliRunner().invoke(whole_app(), [str(word) for word in words], catch_exceptions=False)
    assert done.exit_code == 0, done.output


USES = [("report",), ("figure",), ("export", "out.csv"), ("export", "out.zip"), ("compare", "result.json")]


@pytest.mark.parametrize("words", USES, ids="-".join)
def test_a_changed_document_is_refused_by_every_command_that_reads_it(changed: Path, words: tuple[str, ...]):
    name, *further = words
    with pytest.raises(DataError, match=r"result\.json: its content was changed since certkit wrote it"):
        command(name, changed, *(changed.parent / word for word in further))
    assert [path.name for path in changed.parent.iterdir()] == ["result.json"]


def test_every_file_and_every_page_made_of_a_changed_document_says_so(changed: Path, tmp_path: Path):
    out = tmp_path / "out"
    command("report", changed, "--unverified", "--format", "html,pdf,junit,csv,md", "--out", out)
    command("figure", changed, "--unverified", "--format", "svg", "--out", out / "figure")
    command("export", changed, out / "table.csv", "--unverified")
    command("export", changed, out / "mme", "--unverified")
    command("compare", changed, out / "table.csv", "--unverified", "--out", out / "compared")
    texts = [path for path in out.rglob("*") if path.suffix in {".html", ".xml", ".csv", ".md", ".svg"}]
    texts += [*out.rglob("*.mme"), out / "compared" / "comparison.json"]
    assert len(texts) == 9
    for path in texts:
        assert MARK in path.read_text(encoding="utf-8"), path
    document = pypdfium2.PdfDocument(out / "report.pdf")
    assert all(MARK in page.get_textpage().get_text_bounded() for page in document)


def test_every_sheet_and_every_slide_says_so_too(changed: Path, tmp_path: Path):
    pytest.importorskip("pptx", reason="the extras `xlsx` and `pptx` are not installed")
    command("report", changed, "--unverified", "--format", "xlsx,pptx", "--out", tmp_path / "office")
    for name, part in (("report.xlsx", "xl/worksheets/sheet"), ("report.pptx", "ppt/slides/slide")):
        with zipfile.ZipFile(tmp_path / "office" / name) as file:
            texts = {each: file.read(each).decode() for each in file.namelist() if each.startswith(part)}
            mark = MARK
            if name.endswith("xlsx"):  # a sheet holds the number of a text
                shared = re.findall(r"<t[^>]*>([^<]*)</t>", file.read("xl/sharedStrings.xml").decode())
                mark = f'<c r="A1" s="1" t="s"><v>{shared.index(MARK)}</v></c>'
        assert texts
        assert all(mark in text for text in texts.values())


def test_an_unchanged_document_is_not_marked(tmp_path: Path):
    path = tmp_path / "result.json"
    synthetic_result.result().write(path)
    command("report", path, "--unverified", "--format", "html")
    assert MARK not in (tmp_path / "report.html").read_text(encoding="utf-8")
