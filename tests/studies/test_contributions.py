"""Which parameter moves which value: held against toys whose answer is known."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from support import toys

from certkit.definitions.study import Study
from certkit.errors import RunError
from certkit.reporting.study_pages import study_page
from certkit.reporting.study_text import study_text
from certkit.studies.execution import Execution
from certkit.studies.factors import Factor, Uniform
from certkit.studies.runs import Runs
from certkit.studies.scatter import chances
from certkit.studies.study_documents import study_report
from certkit.studies.study_findings import Findings, carry_out

AB = [Factor("a", "mm", Uniform(0.0, 2.0), 1.0), Factor("b", "kg", Uniform(-1.0, 3.0), 1.0)]
XYZ = [Factor(f"x{i}", "", Uniform(-math.pi, math.pi)) for i in (1, 2, 3)]


def carried(design: dict[str, Any], factors: list[Factor], evaluate: Any) -> Findings:  # noqa: ANN401
    sheet = Study.model_validate(
        {
            "study": "toy",
            "title": "A toy",
            "procedures": ["toy"],
            "parameters": [
                {"path": f.name, "uniform": [f.distribution.low, f.distribution.high]} for f in factors
            ],
            "design": design,
        }
    )
    with Runs(evaluate, Execution(processes=1)) as runs:
        return carry_out(sheet, factors, runs)


@pytest.mark.parametrize(
    "design",
    [
        {"kind": "one at a time"},
        {"kind": "full factorial", "levels": 3},
        {"kind": "latin hypercube", "runs": 20},
        {"kind": "sobol sequence", "runs": 16},
    ],
    ids=lambda design: design["kind"],
)
def test_main_effects_of_a_linear_toy_are_exact(design: dict[str, Any]) -> None:
    effects = carried(design, AB, toys.linear).effects
    of_y = effects[effects["output"] == "y"].set_index("factor")["effect"]
    assert of_y["a"] == pytest.approx(6.0, rel=1e-12)
    assert of_y["b"] == pytest.approx(-8.0, rel=1e-12)
    assert effects[effects["output"] == "z"]["effect"].abs().max() == pytest.approx(0.0, abs=1e-12)


def test_the_interval_of_a_main_effect_holds_the_truth_about_as_often_as_it_says() -> None:
    inside = 0
    for seed in range(100):
        noise = np.random.default_rng(seed)
        findings = carried(
            {"kind": "latin hypercube", "runs": 30, "seed": seed},
            AB,
            lambda p, noise=noise: {"y": toys.linear(p)["y"] + noise.normal()},
        )
        row = findings.effects.set_index("factor").loc["a"]
        inside += row["lower"] <= 6.0 <= row["upper"]
    assert 88 <= inside <= 100


def linear_with_a_bend(point: Any) -> Any:  # noqa: ANN401
    return {"y": toys.linear(point)["y"] + 0.3 * (point["a"] - 1.0) * (point["b"] - 1.0)}


@pytest.mark.parametrize("seed", range(8))
def test_shares_and_what_the_plane_leaves_are_never_more_than_the_whole(seed: int) -> None:
    small = {"kind": "latin hypercube", "runs": 8, "seed": seed}
    exact = carried(small, AB, toys.linear).effects
    assert exact[exact["output"] == "y"]["share"].sum() == pytest.approx(1.0)
    bent = carried(small, AB, linear_with_a_bend).effects
    assert 0.5 < bent["share"].sum() < 1.0


@pytest.mark.parametrize(
    "design", [{"kind": "full factorial", "levels": 5}, {"kind": "latin hypercube", "runs": 2000}]
)
def test_shares_of_a_linear_toy_are_those_of_the_variances(design: dict[str, Any]) -> None:
    # Over its range a moves y by 6 and b by 8: variances as 36 to 64, which Sobol's first orders are too.
    effects = carried(design, AB, toys.linear).effects
    share = effects[effects["output"] == "y"].set_index("factor")["share"]
    assert share.to_dict() == pytest.approx({"a": 0.36, "b": 0.64}, rel=1e-4)


def test_a_value_that_nothing_moves_has_no_shares() -> None:
    effects = carried({"kind": "latin hypercube", "runs": 8}, AB, lambda _: {"y": 3.0}).effects
    assert effects["share"].to_list() == pytest.approx([0.0, 0.0], abs=1e-9)


def test_sobol_indices_of_ishigami_lie_within_their_intervals() -> None:
    pytest.importorskip("SALib")
    indices = carried({"kind": "sobol indices", "samples": 1024, "seed": 0}, XYZ, toys.ishigami).indices
    assert indices is not None
    first = {"x1": 0.3139, "x2": 0.4424, "x3": 0.0}
    total = {"x1": 0.5576, "x2": 0.4424, "x3": 0.2437}
    for row in indices.itertuples():
        assert row.first == pytest.approx(first[row.factor], abs=row.first_interval)
        assert row.total == pytest.approx(total[row.factor], abs=row.total_interval)


def test_a_morris_screening_of_a_linear_toy_finds_its_effects_and_no_interaction() -> None:
    pytest.importorskip("SALib")
    indices = carried({"kind": "morris", "trajectories": 6}, AB, toys.linear).indices
    assert indices is not None
    of_y = indices[indices["output"] == "y"].set_index("factor")
    assert of_y["mean"].to_dict() == pytest.approx({"a": 6.0, "b": -8.0})
    assert of_y["nonlinearity"].max() == pytest.approx(0.0, abs=1e-9)


def test_indices_need_every_run() -> None:
    pytest.importorskip("SALib")
    with pytest.raises(RunError, match="need every run"):
        carried({"kind": "morris", "trajectories": 4}, [AB[1], AB[0]], failing_below_zero)


def failing_below_zero(point: Any) -> Any:  # noqa: ANN401
    if point["b"] < 0:
        raise ValueError("below zero")
    return {"y": 1.0 * point["b"]}


def test_a_quick_model_knows_its_error_on_runs_it_has_not_seen() -> None:
    findings = carried({"kind": "latin hypercube", "runs": 60}, AB, toys.linear)
    model = next(m for m in findings.models if m.output == "y" and m.kind == "linear")
    assert model.error == pytest.approx(0.0, abs=1e-9)
    assert dict(zip(model.terms, model.coefficients, strict=True)) == pytest.approx(
        {"1": 2.0, "a": 3.0, "b": -4.0}
    )
    curved = carried({"kind": "latin hypercube", "runs": 60}, AB, lambda p: {"y": float(p["a"]) ** 2})
    errors = {m.kind: m.error for m in curved.models}
    assert errors["quadratic"] == pytest.approx(0.0, abs=1e-9)
    assert errors["linear"] > 0.2


def test_leaving_one_out_by_leverage_is_leaving_one_out() -> None:
    findings = carried({"kind": "latin hypercube", "runs": 12}, AB, lambda p: {"y": math.exp(float(p["a"]))})
    model = next(m for m in findings.models if m.kind == "linear")
    a, b, y = (findings.table[name].to_numpy() for name in ("a", "b", "y"))
    x = np.stack([np.ones(12), a, b], axis=1)
    errors = []
    for i in range(12):
        others = np.arange(12) != i
        errors.append(y[i] - x[i] @ np.linalg.lstsq(x[others], y[others], rcond=None)[0])
    assert model.error == pytest.approx(float(np.sqrt(np.mean(np.square(errors)))))


def test_a_failed_run_counts_as_outside() -> None:
    def margin(point: Any) -> Any:  # noqa: ANN401
        if point["a"] < 0.2:
            raise ValueError("too low")
        return {"p/T1": 1.0, "p/T1 margin": float(point["a"]) - 1.0, "p/T2": 0.0, "p/T2 margin": 1.0}

    findings = carried({"kind": "latin hypercube", "runs": 20}, AB, margin)
    by_name = {chance.criterion: chance for chance in findings.chances}
    assert findings.failed == 2
    assert by_name["p/T1"].inside == 10
    assert by_name["p/T2"].inside == 18
    assert by_name["all"].inside == 10
    assert [by_name[name].unknown for name in ("p/T1", "p/T2", "all")] == [2, 2, 2]
    assert [by_name[name].first for name in ("p/T1", "p/T2", "all")] == [8, 0, 8]
    assert findings.chances[0].criterion == "p/T1"
    # Clopper and Pearson for 10 of 20, from their tables.
    assert (by_name["p/T1"].lower, by_name["p/T1"].upper) == pytest.approx((0.272, 0.728), abs=5e-4)


def test_page_and_text_say_first_what_leaves_its_corridor_and_what_moves_it() -> None:
    def margins(point: Any) -> Any:  # noqa: ANN401
        value = float(point["a"]) + 0.1 * float(point["b"])
        return {"p/T1": value, "p/T1 margin": 1.0 - value, "p/T2": 2.0, "p/T2 margin": 1.0}

    document = study_report(carried({"kind": "latin hypercube", "runs": 20}, AB, margins))
    page, text = study_page(document), study_text(document)
    beyond = 20 - document.chances[0].inside
    said = f"p/T1 leaves its corridor first, in {beyond} runs."
    assert page.index(said) < page.index("What moves what") < page.index("How probable") < page.index("<svg")
    assert "moved most by" in text
    assert text.splitlines()[1].split()[:1] == ["p/T1"]
    assert " a " in text.splitlines()[1]


def test_without_graded_criteria_there_are_no_chances() -> None:
    assert chances(carried({"kind": "latin hypercube", "runs": 4}, AB, toys.linear).table) == []


def test_the_page_names_every_output_and_parameter_and_runs_nothing() -> None:
    page = study_page(study_report(carried({"kind": "latin hypercube", "runs": 20}, AB, toys.linear)))
    assert "<script" not in page
    for words in ("A toy", ">y<", ">a<", "Quick model"):
        assert words in page


def test_a_value_in_the_definitions_is_written_as_it_stands_there() -> None:
    factors = [Factor("a", "N", Uniform(1080.0, 2000.0), 1540.0), Factor("b", "", Uniform(-1.0, 1.0), -0.5)]
    page = study_page(study_report(carried({"kind": "latin hypercube", "runs": 20}, factors, toys.linear)))
    assert "<td>1540 N</td>" in page
    assert "<td>−0.5</td>" in page
