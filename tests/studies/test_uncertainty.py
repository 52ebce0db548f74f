"""Tolerances become uncertainties: closed forms, one way against the other, and what is told of both."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from certkit import uncertainty
from certkit.definitions.uncertainty_budget import UncertaintyBudget
from certkit.documents.uncertainty_report import CriterionUncertainty, UncertaintyReport
from certkit.errors import UsageError
from certkit.grading.asked_criterion import AskedCriterion
from certkit.reporting.uncertainty_page import uncertainty_page, uncertainty_text
from certkit.studies.combined_uncertainty import SensorError, criterion_uncertainty, standard_uncertainty
from certkit.studies.designs.latin_hypercube import latin_hypercube
from certkit.studies.execution import Execution
from certkit.studies.factors import Factor, NormalFactor, Triangular, Uniform
from certkit.studies.points import Outcome
from certkit.studies.propagate_uncertainty import laboratory_lines

SENSORS = [{"channels": ["T1"], "gain": "2 %", "offset": "3 N·m", "source": "made up"}]
RIG = [{"path": "rig.ram.speed", "uniform": ["10.9 m/s", "11.3 m/s"], "source": "made up"}]
HERE = Execution(processes=1)


def budget(**changes: object) -> UncertaintyBudget:
    given = {"budget": "b", "title": "B", "procedure": "inverse", "rig": RIG, "sensors": SENSORS, "runs": 60}
    return UncertaintyBudget.model_validate({**given, **changes})


@pytest.fixture(scope="module")
def report() -> UncertaintyReport:
    return uncertainty(budget(), execution=HERE)


def of(report: UncertaintyReport, name: str) -> CriterionUncertainty:
    return next(each for each in report.criteria if each.criterion == name)


def test_standard_uncertainties_are_those_of_the_gum() -> None:
    assert standard_uncertainty(Factor("a", "mm", Uniform(-3.0, 3.0))) == pytest.approx(math.sqrt(3.0))
    assert standard_uncertainty(Factor("a", "mm", Triangular(-6.0, 0.0, 6.0))) == pytest.approx(math.sqrt(6))
    assert standard_uncertainty(Factor("a", "mm", NormalFactor(1.0, 0.2))) == 0.2


def test_sources_add_up_to_the_expanded_uncertainty(report: UncertaintyReport) -> None:
    t1 = of(report, "T1")
    assert t1.expanded == pytest.approx(2 * math.hypot(*(line.contribution for line in t1.lines)), rel=1e-5)
    assert sum(line.share for line in t1.lines) == pytest.approx(1.0, rel=1e-5)
    assert {line.name for line in t1.lines} == {"rig.ram.speed", "gain", "offset"}
    gain = next(line for line in t1.lines if line.name == "gain")
    assert gain.contribution == pytest.approx(0.01 * t1.value, rel=1e-5)


def test_a_faster_ram_bends_the_tibia_more(report: UncertaintyReport) -> None:
    speed = next(line for line in of(report, "T1").lines if line.name == "rig.ram.speed")
    assert speed.standard == pytest.approx(0.4 / math.sqrt(12), rel=1e-5)
    assert speed.sensitivity is not None
    assert speed.sensitivity > 0


def test_monte_carlo_comes_to_what_the_gum_says_where_sensors_decide() -> None:
    t1 = of(uncertainty(budget(rig=[], runs=20_000), execution=HERE), "T1")
    # 95 % of a normal distribution lie within 1.96 of its standard deviations, U is 2.
    assert t1.simulated == pytest.approx(t1.expanded * 1.96 / 2, rel=0.03)


def test_too_large_an_uncertainty_names_what_to_tighten() -> None:
    loose = [{"channels": ["T1"], "offset": "40 N·m", "source": "made up"}]
    t1 = of(uncertainty(budget(sensors=loose), execution=HERE), "T1")
    assert t1.allowed is not None
    assert t1.tighten == "offset"
    assert t1.tighten_to is not None
    left = [line.contribution * (t1.tighten_to if line.name == "offset" else 1) for line in t1.lines]
    assert 2 * math.hypot(*left) == pytest.approx(t1.allowed, rel=1e-5)
    assert t1.false_accept is not None
    assert t1.false_accept > 0.025


def one_source(response: Callable[[float], float], **asked: object) -> CriterionUncertainty:
    """Return the uncertainty of a made-up criterion over one normal source of u = 1 about 0."""
    factor = Factor("a", "mm", NormalFactor(0.0, 1.0))
    outcome = [Outcome({"y": response(x)}) for x in (0.0, 1.0, -1.0)]
    spread = [Outcome({"y": response(float(p["a"]))}) for p in latin_hypercube([factor], 4000, 1)]
    criterion = AskedCriterion("y", "Y", "T1", "N·m", None, 10.0, graded=True, **asked)  # type: ignore[arg-type]
    draws = np.random.default_rng(1), 4000
    outcomes = outcome[0], outcome[1:], spread
    return criterion_uncertainty(criterion, "y", outcomes, [factor], SensorError(0.01, 0.0), 0.025, draws)


def test_where_the_model_is_bent_the_runs_count() -> None:
    """Of y = x² over a normal x the GUM sees nothing; 95 % of it reach up to 2.24² = 5.02."""
    bowl = one_source(lambda x: x * x)
    assert bowl.expanded == pytest.approx(0.0, abs=1e-9)
    assert bowl.bent
    assert bowl.counted == pytest.approx(5.02, rel=0.05)
    straight = one_source(lambda x: 2 * x)
    assert not straight.bent
    assert straight.counted == straight.expanded == pytest.approx(4.0, rel=1e-9)


def test_no_gain_moves_an_instant() -> None:
    instant = one_source(lambda x: 100.0 + x, shows="time")
    assert [line.name for line in instant.lines] == ["a"]


def test_a_channel_has_one_line_in_a_laboratory_file_with_its_largest_u(report: UncertaintyReport) -> None:
    """Two criteria of one channel, and the instant of its peak, were three lines of one key."""
    t1 = of(report, "T1")
    rows = [
        t1.model_copy(update={"expanded": 3.0, "farthest": 3.0}),
        t1.model_copy(update={"criterion": "low", "expanded": 5.0, "farthest": 5.0}),
        t1.model_copy(update={"criterion": "when", "unit": "ms", "expanded": 9.0, "farthest": 9.0}),
    ]
    lines = laboratory_lines(report.model_copy(update={"criteria": rows}))
    assert lines.splitlines()[1:] == ["  T1: 5 N·m"]


def test_page_text_and_laboratory_lines_have_each_criterion(tmp_path: Path) -> None:
    made = uncertainty(budget(), out=tmp_path / "b", execution=HERE)
    assert {path.name for path in (tmp_path / "b").iterdir()} >= {
        "uncertainty.json",
        "uncertainty.html",
        "uncertainties.yaml",
    }
    page, text = uncertainty_page(made), uncertainty_text(made)
    assert all(each.criterion in page and each.criterion in text for each in made.criteria)
    assert "  T1: " in (tmp_path / "b" / "uncertainties.yaml").read_text()


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"sensors": [{"channels": ["T9"], "gain": "1 %", "source": "x"}]}, "no criterion is of the channel"),
        ({"sensors": [{"channels": ["T1"], "gain": "1 mm", "source": "x"}]}, "is no share"),
        ({"sensors": [{"channels": ["T1"], "offset": "1 mm", "source": "x"}]}, "should be a number in N·m"),
        ({"sensors": SENSORS * 2}, "stands in two sensors"),
        ({"risk": "70 %"}, "no probability"),
    ],
)
def test_what_does_not_fit_is_told_before_anything_runs(changes: dict[str, object], told: str) -> None:
    with pytest.raises(UsageError, match=told):
        uncertainty(budget(**changes), execution=HERE)
