from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from support import synthetic_result
from typer.testing import CliRunner

from certkit.cli.commands import whole_app
from certkit.errors import DataError
from certkit.reporting.writing import render

if TYPE_CHECKING:
    from pathlib import Path


def command(*words: object) -> None:
    CliRunner().invoke(whole_app(), [str(word) for word in words], catch_exceptions=False)


@pytest.fixture
def document(tmp_path: Path) -> Path:
    path = tmp_path / "run" / "result.json"
    synthetic_result.static_result().write(path)
    return path


def test_report_renders_what_the_run_rendered(document: Path, tmp_path: Path) -> None:
    render(synthetic_result.static_result().as_written(), tmp_path / "first", ["html", "pdf"])
    command("report", document, "--out", tmp_path / "again")
    for name in ("report.html", "report.pdf"):
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "first" / name).read_bytes()


def test_report_writes_beside_the_document(document: Path) -> None:
    command("report", document, "--format", "html,junit")
    assert {path.name for path in document.parent.iterdir()} == {"result.json", "report.html", "junit.xml"}


def test_several_results_are_also_bound_into_a_suite(document: Path, tmp_path: Path) -> None:
    other = tmp_path / "other" / "result.json"
    synthetic_result.result().write(other)
    command("report", document, other, "--format", "html", "--out", tmp_path / "suite")
    found = {str(path.relative_to(tmp_path / "suite")) for path in (tmp_path / "suite").rglob("*.html")}
    assert found == {"index.html", "static-femur/report.html", "pendulum/report.html"}


def test_figure_writes_each_format(document: Path, tmp_path: Path) -> None:
    command("figure", document, "--what", "curve", "--format", "svg,png", "--out", tmp_path / "fig.7")
    assert (tmp_path / "fig.7.svg").read_bytes().startswith(b"<svg")
    assert (tmp_path / "fig.7.png").read_bytes().startswith(b"\x89PNG")


def test_a_damaged_document_is_one_clear_error_and_nothing_is_written(tmp_path: Path) -> None:
    path = tmp_path / "result.json"
    path.write_text('{"schema": "certkit-result/1", ')
    with pytest.raises(DataError, match="damaged"):
        command("report", path)
    assert list(tmp_path.iterdir()) == [path]
