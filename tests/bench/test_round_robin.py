"""Certificates of several laboratories become one document, or one clear refusal."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.several_laboratories import certificate

from certkit import round_robin
from certkit.documents.result import Result
from certkit.documents.round_robin_report import RoundRobinReport
from certkit.errors import DataError, UsageError
from certkit.reporting.round_robin_page import round_robin_page, round_robin_text

VALUES = {"North": (250.0, 252.0), "South": (255.0, 253.0), "East": (249.0, 248.5), "West": (251.0, 251.5)}


def written(folder: Path, *results: Result) -> list[Path]:
    paths = [folder / f"{number}.json" for number, _ in enumerate(results)]
    for path, result in zip(paths, results, strict=True):
        result.write(path)
    return paths


def of(values: dict[str, tuple[float, ...]]) -> list[Result]:
    return [certificate(name, day, t1) for name, row in values.items() for day, t1 in enumerate(row, 1)]


@pytest.fixture
def report(tmp_path: Path) -> RoundRobinReport:
    return round_robin(written(tmp_path, *of(VALUES)))


def test_every_certificate_counts_once(report: RoundRobinReport) -> None:
    (found,) = report.criteria
    assert found.key == "pendulum/T1"
    assert found.tests == len(report.tests) == 8
    assert {row.laboratory: tuple(row.values) for row in found.rows} == VALUES
    assert report.id == report.content_id()


def test_page_and_text_name_each_laboratory_and_both_deviations(report: RoundRobinReport) -> None:
    page, text = round_robin_page(report), round_robin_text(report)
    assert all(name in page for name in VALUES)
    (found,) = report.criteria
    assert f"{found.reproducibility:.3g}" in page
    assert f"{found.repeatability:.3g}" in text


def test_one_laboratory_under_two_spellings_is_one(tmp_path: Path) -> None:
    results = [
        certificate("North Lab", 1, 250.0),
        certificate("north  lab", 2, 251.0),
        *of({"South": (250,)}),
    ]
    assert round_robin(written(tmp_path, *results)).laboratories == ["North Lab", "South"]


def test_several_legforms_are_told(tmp_path: Path) -> None:
    results = [certificate("North", 1, 250.0, serial="A-1"), certificate("South", 1, 251.0, serial="B-2")]
    assert "2 legforms were tested (A-1, B-2)" in round_robin(written(tmp_path, *results)).remarks[0]


def test_an_outlier_is_named_and_can_be_left_out(tmp_path: Path) -> None:
    values = {f"Lab {i}": (250.0 + i / 10, 250.1 + i / 10) for i in range(7)} | {"Odd": (268.0, 268.1)}
    paths = written(tmp_path, *of(values))
    assert round_robin(paths).outliers == ["Odd in pendulum/T1 (mean)"]
    calm = round_robin(paths, without=["odd"])
    assert calm.outliers == []
    assert calm.left_out == ["Odd"]


def test_all_that_cannot_be_taken_is_told_at_once(tmp_path: Path) -> None:
    good, twice = certificate("North", 1, 250.0), certificate("South", 1, 251.0)
    simulated = certificate("East", 1, 250.0, kind="virtual certification")
    paths = written(tmp_path, good, twice, twice, simulated)
    with pytest.raises(DataError) as caught:
        round_robin(paths)
    first, second = str(caught.value).splitlines()
    assert first == f"{paths[2]}: the test that {paths[1]} has too; name each test once"
    assert second.startswith(f"{paths[3]}: is a virtual certification")


def test_one_laboratory_agrees_with_nobody(tmp_path: Path) -> None:
    paths = written(tmp_path, certificate("North", 1, 250.0), certificate("North", 2, 251.0))
    with pytest.raises(UsageError, match="two laboratories"):
        round_robin(paths)
    with pytest.raises(UsageError, match="there are North"):
        round_robin(paths, without=["South"])


def test_a_changed_certificate_is_refused(tmp_path: Path) -> None:
    paths = written(tmp_path, certificate("North", 1, 250.0), certificate("South", 1, 251.0))
    paths[1].write_text(paths[1].read_text().replace("251.0", "249.0"))
    with pytest.raises(DataError, match="was changed since certkit wrote it"):
        round_robin(paths)
