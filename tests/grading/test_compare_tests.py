"""Two tests beside each other: errors as in the paper, ratings, curves on one axis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from msgspec.structs import replace
from support.curves import write_csv

from certkit.bench.compare import compare
from certkit.definitions.loading.channel_tables import default_channels
from certkit.documents.comparison import ComparisonDocument
from certkit.errors import DataError
from certkit.reporting.comparison_report import comparison_page
from certkit.reporting.comparison_text import comparison_text
from certkit.signals import Channel, Recording

if TYPE_CHECKING:
    from pathlib import Path

KINDS = default_channels().kinds


def recording(
    scale: float = 1.0, names: tuple[str, ...] = ("T1", "MCL"), interval: float = 1e-4
) -> Recording:
    time = np.arange(-0.02, 0.15, interval)
    pulse = np.where((time > 0) & (time < 0.08), np.sin(np.pi * time / 0.08), 0.0)
    peaks = {"T1": 250.0, "T2": 200.0, "MCL": 0.022}
    channels = {
        name: Channel(
            name,
            KINDS[name].title,
            KINDS[name].dimension,
            scale * peaks[name] * pulse,
        )
        for name in names
    }
    return Recording("measured", time, channels)


@pytest.fixture
def a(tmp_path: Path) -> Path:
    write_csv(recording(), tmp_path / "a.csv")
    return tmp_path / "a.csv"


def test_a_test_equals_itself(a: Path, tmp_path: Path):
    (tmp_path / "b").mkdir()
    twin = tmp_path / "b/a.csv"
    twin.write_bytes(a.read_bytes())
    document = compare(a, twin)
    assert document.rms_error_percent == 0
    assert document.rating == pytest.approx(1.0)
    assert document.grade == "excellent"
    assert {document.reference.label, document.other.label} == {"a.csv (A)", "a.csv (B)"}


def test_an_error_is_the_difference_over_the_reference(a: Path, tmp_path: Path):
    write_csv(recording(1.1), tmp_path / "b.csv")
    document = compare(a, tmp_path / "b.csv")
    assert [row.error_percent for row in document.rows] == pytest.approx([10.0, 10.0], rel=1e-3)
    assert document.rms_error_percent == pytest.approx(10.0, rel=1e-3)
    curves = document.overlays[0]
    np.testing.assert_allclose(curves.difference, np.subtract(curves.other, curves.reference), atol=1e-3)


def test_the_measured_test_is_the_reference_of_a_simulated_one(a: Path, tmp_path: Path):
    write_csv(replace(recording(1.1), kind="simulated"), tmp_path / "simulated.csv")
    for pair in ((a, tmp_path / "simulated.csv"), (tmp_path / "simulated.csv", a)):
        document = compare(*pair)
        assert document.reference.kind == "measured"
        assert document.rows[0].error_percent == pytest.approx(10.0, rel=1e-3)


def test_different_samplings_are_brought_to_one_axis(a: Path, tmp_path: Path):
    write_csv(recording(interval=5e-5), tmp_path / "b.csv")
    document = compare(a, tmp_path / "b.csv")
    assert document.rating is not None
    assert document.rating > 0.999


def test_channels_of_only_one_test_are_named(a: Path, tmp_path: Path):
    write_csv(recording(names=("T1", "T2")), tmp_path / "b.csv")
    document = compare(a, tmp_path / "b.csv")
    assert [row.channel for row in document.rows] == ["T1"]
    assert "Only in a.csv: MCL." in document.notes
    assert "Only in b.csv: T2." in document.notes


def test_tests_without_a_common_channel_cannot_be_compared(a: Path, tmp_path: Path):
    write_csv(recording(names=("T2",)), tmp_path / "b.csv")
    with pytest.raises(DataError, match="share no channel"):
        compare(a, tmp_path / "b.csv")


def test_a_silent_reference_has_neither_error_nor_rating(tmp_path: Path, a: Path):
    silent = recording()
    channels = {**silent.channels, "T1": replace(silent.channels["T1"], values=0 * silent.time)}
    write_csv(replace(silent, channels=channels), tmp_path / "b.csv")
    document = compare(tmp_path / "b.csv", a)
    rating = next(r for r in document.ratings if r.channel == "T1")
    assert rating.overall is None
    assert "constant" in rating.reason
    assert "T1" not in {row.channel for row in document.rows}


def test_the_comparison_ends_where_it_is_told_to(a: Path, tmp_path: Path):
    write_csv(recording(1.1), tmp_path / "b.csv")
    document = compare(a, tmp_path / "b.csv", until=0.02)
    assert document.interval == pytest.approx((0.0, 0.02))
    assert document.rows[0].test < 200


def test_page_and_text_show_the_numbers_of_the_document_alone(a: Path, tmp_path: Path):
    write_csv(recording(1.1), tmp_path / "b.csv")
    document = ComparisonDocument.from_json(compare(a, tmp_path / "b.csv").to_json(), "comparison.json")
    page, text = comparison_page(document), comparison_text(document)
    assert "10.0 %" in page
    assert "10.0 %" in text
    assert page.count("<svg") >= 2
    assert "<script" not in page
    assert comparison_page(document) == page


def test_names_of_files_cannot_write_markup(tmp_path: Path):
    name = "<img src=x onerror=alert(1)>.csv"
    write_csv(recording(), tmp_path / name)
    write_csv(recording(), tmp_path / "b.csv")
    assert "<img" not in comparison_page(compare(tmp_path / name, tmp_path / "b.csv"))
