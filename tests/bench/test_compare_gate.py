"""A comparison as a gate: a rule in a file, one verdict, and in numbers why a rating is low."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import certkit
from certkit.cli.commands import whole_app
from certkit.definitions.agreement_rule import AgreementRule
from certkit.definitions.loading.validation import read_document
from certkit.errors import DefinitionError

CHANNELS = {"T1": 200.0, "T2": 150.0, "MCL": 15.0}


def record(
    path: Path, *, late: float = 0.0, size: float = 1.0, quicker: float = 1.0, kind: str = "simulated"
) -> Path:
    """Write a record of half-sine pulses of 40 ms."""
    time = 1e-4 * np.arange(-100, 900)
    phase = np.clip(quicker * (time - 1e-3 * late) / 0.04, 0.0, 1.0)
    columns = [size * peak * np.sin(np.pi * phase) for peak in CHANNELS.values()]
    heads = ["time [s]", *(f"{name} [{'mm' if name == 'MCL' else 'N·m'}]" for name in CHANNELS)]
    rows = [",".join(f"{value:.7g}" for value in row) for row in zip(time, *columns, strict=True)]
    path.write_text("\n".join([f"# kind: {kind}", ",".join(heads), *rows]) + "\n", "utf-8")
    return path


def rule(folder: Path, text: str) -> Path:
    path = folder / "rule.yaml"
    origin = "origin: {source: made up for a test, confidence: estimated}"
    path.write_text(f"agreement: own\ntitle: Our customer's rule\n{origin}\n{text}", "utf-8")
    return path


@pytest.fixture
def measured(tmp_path: Path) -> Path:
    return record(tmp_path / "test.csv", kind="measured")


def test_a_simulation_that_follows_the_test_keeps_the_rule(measured: Path, tmp_path: Path):
    found = certkit.compare(measured, record(tmp_path / "good.csv", size=1.03), rule="fair-agreement")
    assert (found.verdict, found.rule) == ("pass", "Fair agreement by ISO/TS 18571")
    assert {check.kind for check in found.checks} == {"rating", "mean-rating", "peak"}
    assert all(not rating.causes for rating in found.ratings)


def test_a_poor_one_fails_by_the_line_of_the_rule_that_says_so(measured: Path, tmp_path: Path):
    found = certkit.compare(
        measured,
        record(tmp_path / "poor.csv", late=22.0, size=1.9),
        rule=rule(tmp_path, "rating: {mean: 0.58}\n"),
    )
    assert (found.verdict, found.grade) == ("fail", "poor")
    (check,) = found.checks
    assert (check.kind, check.lower, check.title) == ("mean-rating", 0.58, "Mean ISO/TS 18571 rating")
    assert check.value == pytest.approx(found.rating)


def test_low_ratings_say_in_numbers_why(measured: Path, tmp_path: Path):
    late = certkit.compare(measured, record(tmp_path / "late.csv", late=6.0)).ratings[0]
    assert "comes 6.0 ms late" in late.causes
    high = certkit.compare(measured, record(tmp_path / "high.csv", size=1.5)).ratings[0]
    assert "its peak is +50 %, its area +50 %" in high.causes
    steep = certkit.compare(measured, record(tmp_path / "steep.csv", quicker=2.0)).ratings[0]
    assert any(cause.endswith("times as steep") for cause in steep.causes)


def test_a_peak_on_its_limit_is_kept_and_beyond_it_is_not(measured: Path, tmp_path: Path):
    limit = rule(tmp_path, "peak: {within: 10 %}\nchannels: [T1]\n")
    assert certkit.compare(measured, record(tmp_path / "a.csv", size=1.09), rule=limit).verdict == "pass"
    assert certkit.compare(measured, record(tmp_path / "b.csv", size=1.11), rule=limit).verdict == "fail"


def test_what_was_not_recorded_in_both_is_not_evaluated(measured: Path, tmp_path: Path):
    wanted = rule(tmp_path, "rating: {each: 0.5, mean: 0.5}\nchannels: [T1, ACL]\n")
    found = certkit.compare(measured, record(tmp_path / "a.csv"), rule=wanted)
    assert found.verdict == "not evaluated"
    assert [c.reason for c in found.checks if c.reason] == [
        "ACL was not recorded in both",
        "only 1 of 2 channels are rated",
    ]


def test_criteria_are_asked_where_the_test_comes_near_their_limit():
    runs = Path(__file__).parents[2] / "examples" / "finite-elements"
    first = certkit.grade("vehicle", runs / "table", mapping=runs / "mapping-table.yaml")
    changed = [c.model_copy(update={"value": c.value + 7.0}) if c.id == "MCL" else c for c in first.criteria]
    second = first.model_copy(update={"criteria": type(first.criteria)(changed)})
    found = certkit.compare(first, second, rule="virtual-testing")
    checks = {check.channel: check for check in found.checks}
    assert "T4" not in checks  # 135 of 340 N·m: r_AC is below 50 %
    assert checks["T1"].verdict == "pass"
    assert checks["MCL"].value == pytest.approx(100 * 7 / 22, rel=1e-4)
    assert (checks["MCL"].verdict, found.verdict) == ("fail", "fail")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("notes: []\n", "asks nothing"),
        ("peak: {within: 10 mm}\n", "ratio"),
        ("rating: {mean: 2}\n", "has to be 1.0 or less"),
    ],
)
def test_a_rule_that_cannot_be_asked_is_refused(text: str, said: str, tmp_path: Path):
    with pytest.raises(DefinitionError, match=said):
        read_document(rule(tmp_path, text), AgreementRule)


def test_many_against_one_end_with_the_worst_exit_code(measured: Path, tmp_path: Path):
    good, poor = record(tmp_path / "good.csv"), record(tmp_path / "poor.csv", late=22.0, size=1.9)

    def ends(*words: object) -> tuple[int, str]:
        out = ["--out", str(tmp_path / "out"), "--force", "--format", "none"]
        done = CliRunner().invoke(whole_app(), ["compare", *map(str, words), *out])
        return done.exit_code, done.stdout

    code, said = ends(measured, good, poor, "--rule", "fair-agreement")
    assert code == 1
    assert "✗ FAIL  Fair agreement by ISO/TS 18571" in said
    assert "Mean ISO/TS 18571 rating: 0." in said
    written = json.loads((tmp_path / "out" / "poor" / "comparison.json").read_text("utf-8"))
    assert written["verdict"] == "fail"
    assert ends(measured, good, "--rule", "fair-agreement")[0] == 0
    assert ends(measured, poor)[0] == 0  # without a rule nothing gates
    # Several tests against one simulation: each test is the reference.
    code, said = ends(
        good, measured, record(tmp_path / "second.csv", kind="measured"), "--rule", "fair-agreement"
    )
    assert code == 0
    assert "good.csv compared with second.csv" in said


def test_the_pdf_says_verdict_and_causes(measured: Path, tmp_path: Path):
    pdfium = pytest.importorskip("pypdfium2", reason="reads the PDF")
    found = certkit.compare(
        measured, record(tmp_path / "poor.csv", late=22.0, size=1.9), rule="fair-agreement"
    )
    certkit.render(found, tmp_path / "out", ("pdf",))
    page = pdfium.PdfDocument(tmp_path / "out" / "comparison.pdf")[0].get_textpage().get_text_range()
    assert "fail: Fair agreement by ISO/TS 18571" in " ".join(page.split())
