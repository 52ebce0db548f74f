"""Whatever certkit writes can be described, rendered again and verified, by one command each."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import pytest
from support import small_documents, synthetic_campaign, synthetic_result
from typer.testing import CliRunner

from certkit.cli.commands import whole_app
from certkit.documents.calibration_report import (
    CalibrationReport,
    FittedParameter,
    FittedValue,
    OpenDirection,
    StrongCorrelation,
)
from certkit.documents.comparison import ChannelRating, ComparisonDocument, Side
from certkit.documents.document_kinds import DOCUMENTS, document_class, read_documents
from certkit.documents.extraction import ExtractionResult, GroupResult
from certkit.documents.logbook_overview import LegOverview, Validity
from certkit.documents.optimum_report import OptimumReport
from certkit.documents.output_document import OutputDocument, listed_json
from certkit.documents.study_report import StudyReport
from certkit.errors import DataError, UsageError
from certkit.logbooks import Issue, certificate_of
from certkit.reporting.language import worded
from certkit.studies.factors import Factor, Levels, NormalFactor, Triangular, Uniform
from certkit.studies.study_documents import study_report
from certkit.studies.study_findings import Findings

if TYPE_CHECKING:
    from pathlib import Path

FACTORS = (
    Factor("a", "mm", Uniform(1.0, 3.0), 2.0),
    Factor("b", "", Levels(("soft", "hard")), "soft"),
    Factor("c", "kg", NormalFactor(8.0, 0.1)),
    Factor("d", "m/s", Triangular(1.0, 2.0, 4.0)),
)


def _study() -> StudyReport:
    table = pd.DataFrame(
        {"run": [1, 2, 3], "a": [1.0, 2.0, 3.0], "b": ["soft", "hard", "soft"], "c": [8.0, 8.1, 8.2]}
        | {"d": [1.0, 2.0, 3.0], "p/T1": [250.0, np.nan, 260.0], "error": ["", "broke", ""]}
    )
    effects = pd.DataFrame(
        [
            {"output": "p/T1", "factor": "a", "effect": 10.0, "lower": 1 / 3, "upper": 20.0, "share": 0.9},
            {"output": "p/T1", "factor": "b", "effect": 1.0, "lower": np.nan, "upper": np.nan, "share": 0.1},
        ]
    )
    return study_report(
        Findings("toy", "A <toy>", "latin hypercube", FACTORS, table, effects, output_units={"p/T1": "N·m"})
    )


LEG = LegOverview(
    serial="FLX/7",
    day="2026-03-31",
    rules="rules",
    state="valid",
    tests=[],
    counts={},
    validity=[
        Validity(
            rule="count",
            title="tests",
            state="valid",
            why="few tests",
            source="a text",
            confidence="recalled",
        )
    ],
    trends=[],
).with_id()

DOCUMENTED: dict[str, OutputDocument] = {
    "result": synthetic_result.static_result().with_id(),
    "comparison": ComparisonDocument(
        title="b compared with a",
        reference=Side(label="a", kind="measured"),
        other=Side(label="b", kind="simulated"),
        interval=(0.0, 0.1),
        ratings=[ChannelRating(channel="T1", title="tibia moment 1", overall=1 / 3)],
    ).with_id(),
    "extraction": ExtractionResult(
        case="bumper",
        title="A bumper",
        start=0.0,
        interval=1e-3,
        count=3,
        smoothing=0.0,
        groups=(
            GroupResult(
                name="beam",
                kind="group",
                parts=("1",),
                mass=1 / 3,
                momentum=(0.0, 1.0, 2.0),
                displacement=(0.0, 0.1, 0.2),
            ),
        ),
        paths=(),
        vehicle=None,
        material=None,
        warnings=(),
        notes=(),
    ).with_id(),
    "study-report": _study(),
    "optimum-report": OptimumReport(
        study="toy",
        title="A toy",
        runs=3,
        keeps_all_limits=True,
        slack=1 / 3,
        best_run=2,
        settings=["a=2 mm"],
        factors=_study().factors[:1],
        best={"a": 2.0},
        aims=[],
        trade_off=[{"run": 2, "p/T1": 250.0}],
    ).with_id(),
    "calibration-report": CalibrationReport(
        fit="toy",
        title="A toy",
        legform="leg",
        runs=9,
        rms_before=1 / 3,
        rms_after=0.1,
        passes=True,
        values=[
            FittedValue(
                name="p/T1",
                unit="N·m",
                aim=250.0,
                counts_as_one=10.0,
                graded=True,
                before=None,
                after=251.0,
                distance_before=20.0,
                distance_after=0.1,
            )
        ],
        parameters=[
            FittedParameter(
                name="a",
                unit="mm",
                before=1.0,
                after=2.0,
                deviation=0.1,
                lower=0.0,
                upper=3.0,
                narrowed_to=0.9,
                determined=False,
            )
        ],
        correlations=[StrongCorrelation(between=("a", "b"), coefficient=-0.7)],
        open_directions=[OpenDirection(spread=0.9, parts={"a": 1.0})],
    ).with_id(),
    "campaign-report": synthetic_campaign.campaign(),
    "uncertainty-report": small_documents.UNCERTAINTY,
    "twin": small_documents.TWIN,
    "round-robin": small_documents.ROUND_ROBIN,
    "logbook-overview": LEG,
    "legform-certificate": worded(
        certificate_of(LEG.model_copy(update={"certified_by": ["pendulum"]}).with_id(), [], Issue())
    ).with_id(),
}


def command(*words: object, code: int = 0) -> str:
    done = CliRunner().invoke(whole_app(), [str(word) for word in words], catch_exceptions=False)
    assert done.exit_code == code, done.output
    return done.stdout


DERIVED = {"result", "campaign-report", "legform-certificate"}
"""Kinds that carry what they follow from; of the others verify can say no more than that the id fits."""


def test_every_kind_is_shown_here():
    assert set(DOCUMENTED) == set(DOCUMENTS)
    for word, document in DOCUMENTED.items():
        assert type(document) is document_class(word)


@pytest.mark.parametrize("word", DOCUMENTS)
def test_a_document_fits_the_schema_that_is_printed(word: str):
    jsonschema = pytest.importorskip("jsonschema")
    schema = json.loads(command("schema", word))
    jsonschema.validate(json.loads(DOCUMENTED[word].to_json()), schema)


@pytest.mark.parametrize("word", DOCUMENTS)
def test_a_document_is_rendered_from_its_file_alone_always_the_same(word: str, tmp_path: Path):
    document = DOCUMENTED[word]
    path = tmp_path / "in" / document.file_name
    document.write(path)
    for folder in ("once", "twice"):
        command("report", path, "--format", "html", "--out", tmp_path / folder)
    (once,) = (tmp_path / "once").iterdir()
    (twice,) = (tmp_path / "twice").iterdir()
    assert once.read_bytes() == twice.read_bytes()
    assert once.suffix == ".html"
    assert "<script>alert" not in once.read_text(encoding="utf-8")


@pytest.mark.parametrize("word", [word for word in DOCUMENTS if word != "result"])
def test_one_changed_letter_makes_a_document_that_does_not_hold(word: str, tmp_path: Path):
    document = DOCUMENTED[word]
    path = tmp_path / document.file_name
    document.write(path)
    code = 0 if word in DERIVED else 4
    assert document.id in command("verify", path, code=code)
    assert document.id in command("verify", path.parent, code=code)
    text = path.read_text(encoding="utf-8")
    title = "serial" if word == "logbook-overview" else "title"
    changed = text.replace(f'"{title}":"', f'"{title}":"X', 1)
    assert changed != text
    path.write_text(changed, encoding="utf-8")
    done = CliRunner().invoke(whole_app(), ["verify", str(path)])
    assert done.exit_code == 1
    assert "its content was changed" in done.stdout


def test_a_list_of_documents_is_verified_and_rendered_one_by_one(tmp_path: Path):
    path = tmp_path / "legs.json"
    leg = DOCUMENTED["logbook-overview"]
    other = leg.model_copy(update={"serial": "FLX/8"}).with_id()
    path.write_text(listed_json([leg, other]), encoding="utf-8")
    assert leg.id in command("verify", path, code=4)
    command("report", path, "--out", tmp_path / "pages")
    assert {page.name for page in (tmp_path / "pages").rglob("*.html")} == {
        "logbook-FLX-7.html",
        "logbook-FLX-8.html",
    }


def test_a_format_that_a_kind_does_not_have_is_refused(tmp_path: Path):
    path = tmp_path / "comparison.json"
    DOCUMENTED["comparison"].write(path)
    with pytest.raises(UsageError, match="no comparison in the format `junit`; use html"):
        command("report", path, "--format", "junit")


def test_what_is_no_document_can_be_neither_rendered_nor_verified(tmp_path: Path):
    path = tmp_path / "x.json"
    path.write_text('{"schema": "other/1"}')
    for word in ("report", "verify"):
        with pytest.raises(DataError, match="its schema is `other/1`"):
            command(word, path)


def test_a_study_report_says_how_each_parameter_varies():
    uniform, levels, normal, triangular = _study().factors
    assert (uniform.distribution, uniform.low, uniform.high, uniform.nominal) == ("uniform", 1.0, 3.0, 2.0)
    assert (levels.distribution, levels.entries) == ("levels", ["soft", "hard"])
    assert (normal.mean, normal.sd, normal.low) == (8.0, 0.1, pytest.approx(7.7))
    assert triangular.mode == 2.0


def test_a_cloud_of_runs_leaves_out_runs_without_the_value():
    (cloud,) = _study().clouds
    assert (cloud.x_name, cloud.y_name) == ("a", "p/T1")
    assert list(zip(cloud.x, cloud.y, strict=True)) == [(1.0, 250.0), (3.0, 260.0)]


def test_what_is_not_known_is_null_and_not_nan():
    effect = _study().effects[1]
    assert (effect.lower, effect.upper) == (None, None)
    assert '"lower":null' in _study().to_json()


@pytest.mark.parametrize("content", ["<!DOCTYPE html>\n<html></html>", "time,T1\n0,1\n", "%PDF-1.7", ""])
def test_what_is_made_of_a_document_is_told_from_a_damaged_one(content: str, tmp_path: Path):
    (tmp_path / "page").write_text(content)
    with pytest.raises(DataError, match=r"page: is no document of certkit's; .* name that") as caught:
        read_documents(tmp_path / "page")
    assert "damaged" not in str(caught.value)
