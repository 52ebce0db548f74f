"""An optimisation finds what is known to be best, and keeps limits it was given."""

from __future__ import annotations

from typing import Any

import pytest

from certkit.definitions.study import Study
from certkit.errors import RunError, UsageError
from certkit.reporting.study_pages import optimum_page
from certkit.reporting.study_text import optimum_text
from certkit.studies.execution import Execution
from certkit.studies.factors import Factor, NormalFactor, Uniform
from certkit.studies.optimise import Limit, Optimum, limits_of, optimise
from certkit.studies.runs import Runs
from certkit.studies.study_documents import optimum_report
from certkit.studies.trial import Trial

AB = [Factor("a", "mm", Uniform(0.0, 10.0), 1.0), Factor("b", "", Uniform(0.0, 10.0), 1.0)]
HELD = {"p/T1": Limit(None, 10.0)}


def bowl(point: Any) -> Any:  # noqa: ANN401
    """T1 rises with a, cost falls with it: the limit decides."""
    a, b = float(point["a"]), float(point["b"])
    return {"p/T1": 2 * a + (b - 3) ** 2, "cost": 20 - a, "weight": 1 + b}


def searched(
    evaluations: int = 800,
    margin: str = "10 %",
    aims: tuple[str, ...] = ("cost",),
    **how: Any,  # noqa: ANN401
) -> Optimum:
    sheet = Study.model_validate(
        {
            "study": "toy",
            "title": "A toy",
            "procedures": ["p"],
            "parameters": [{"path": f.name, "uniform": [0, 10]} for f in AB],
            "optimise": {"margin": margin, "aims": [{"output": a} for a in aims], "evaluations": evaluations},
        }
    )
    with Runs(how.get("evaluate", bowl), Execution(processes=1)) as runs:
        found = optimise(sheet, how.get("factors", AB), HELD, runs)
        assert len(found.table) <= evaluations
        return found


def test_the_best_lies_on_the_limit_with_its_margin() -> None:
    found = searched()
    row = found.table.iloc[found.best]
    assert found.keeps
    assert row["p/T1"] <= 9.0
    assert row["a"] == pytest.approx(4.5, abs=0.1)
    assert row["b"] == pytest.approx(3.0, abs=0.5)


def test_without_an_aim_the_tightest_limit_is_made_as_wide_as_it_can_be() -> None:
    found = searched(aims=())
    row = found.table.iloc[found.best]
    assert (row["a"], row["b"]) == (pytest.approx(0.0, abs=0.1), pytest.approx(3.0, abs=0.3))
    assert found.slack == pytest.approx(0.9, abs=0.02)


def test_a_trade_off_rises_in_one_aim_as_it_falls_in_the_other() -> None:
    found = searched(evaluations=1400, aims=("cost", "weight"))
    curve = found.table.iloc[list(found.curve)]
    assert len(curve) >= 5
    assert curve["cost"].is_monotonic_increasing
    assert curve["weight"].is_monotonic_decreasing
    assert (curve["p/T1"] <= 9.0).all()
    assert "Trade-off" in optimum_page(optimum_report(found))


def test_limits_that_cannot_be_kept_are_said_so() -> None:
    found = searched(evaluations=100, margin="120 %")
    assert not found.keeps
    assert optimum_text(optimum_report(found)).startswith("no settings keep all limits")


def hill(point: Any) -> Any:  # noqa: ANN401
    """T1 is 12 at the least, at a = 7 and b = 2; the cost is least, 1, at a = 4 and b = 6."""
    a, b = float(point["a"]), float(point["b"])
    return {"p/T1": 12 + (a - 7) ** 2 + (b - 2) ** 2, "cost": 1 + (a - 4) ** 2 + (b - 6) ** 2}


def test_where_no_limit_is_in_the_way_the_best_is_the_aims_own() -> None:
    found = searched(evaluate=lambda point: {**hill(point), "p/T1": 1.0})
    row = found.table.iloc[found.best]
    assert (row["a"], row["b"], row["cost"]) == (
        pytest.approx(4.0, abs=0.03),
        pytest.approx(6.0, abs=0.03),
        pytest.approx(1.0, abs=1e-3),
    )


def test_where_no_settings_keep_the_limits_those_that_miss_them_least_are_told() -> None:
    found = searched(evaluate=hill, margin="0 %")
    row = found.table.iloc[found.best]
    assert not found.keeps
    assert (row["a"], row["b"]) == (pytest.approx(7.0, abs=0.1), pytest.approx(2.0, abs=0.1))
    assert found.slack == pytest.approx(-0.2, abs=1e-3)


def test_the_settings_run_again_give_the_value_that_was_promised() -> None:
    found = searched(evaluations=60)
    settings = dict(setting.split("=") for setting in found.settings)
    again = bowl({name: value.removesuffix(" mm") for name, value in settings.items()})
    assert again["cost"] == found.table.iloc[found.best]["cost"]


def test_an_aim_that_no_run_gives_is_refused() -> None:
    with pytest.raises(UsageError, match="no run gives the aim costs; did you mean `cost`"):
        searched(evaluations=20, aims=("costs",))


def test_the_same_seed_walks_the_same_way() -> None:
    assert searched(evaluations=60).table.equals(searched(evaluations=60).table)


def failing(_: Any) -> Any:  # noqa: ANN401
    raise ValueError("never")


def test_nothing_that_ran_is_an_error_not_an_optimum() -> None:
    with pytest.raises(RunError, match="not a single run"):
        searched(evaluations=20, evaluate=failing)


def test_only_ranges_can_be_searched() -> None:
    with pytest.raises(UsageError, match="uniform"):
        searched(evaluations=20, factors=[AB[0], Factor("b", "", NormalFactor(1.0, 0.1))])


def test_a_value_has_to_stay_inside_on_both_sides() -> None:
    limit = Limit(100.0, 200.0)
    assert limit.slack(150.0, 0.1) == pytest.approx(0.15)
    assert limit.slack(105.0, 0.1) == pytest.approx(-0.05)
    assert limit.slack(195.0, 0.0) == pytest.approx(0.025)


def test_the_limits_are_those_of_the_corridors() -> None:
    held = limits_of(Trial(("vehicle", "inverse")))
    assert held["vehicle/T1"] == Limit(None, 340.0)
    assert held["inverse/T1"] == Limit(230.0, 272.0)
