"""A leg whose numbers are known is found again from its tests, and what is not found is told as that."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import yaml

from certkit.definitions.calibration import CalibrationTask
from certkit.definitions.loading.search_path import shipped_root
from certkit.errors import RunError, UsageError
from certkit.reporting.study_pages import calibration_page
from certkit.reporting.study_text import calibration_text
from certkit.studies.calibration.fit import Calibration, calibrate, make_ready, runs_for
from certkit.studies.calibration.fitted_files import report
from certkit.studies.calibration.identifiability import knowledge
from certkit.studies.calibration.parameter_space import Axis, Space
from certkit.studies.calibration.search import Misfit
from certkit.studies.calibration.targets import Goal, residuals
from certkit.studies.execution import Execution
from certkit.studies.points import Outcome
from certkit.studies.runs import Runs
from certkit.studies.trial import Trial

if TYPE_CHECKING:
    from pathlib import Path

FEMUR, TIBIA = (f"legform.parts.{bone}.bending stiffness" for bone in ("femur", "tibia"))
ASKED = ("T1", "T2", "T3", "T4", "MCL", "F1", "F2", "F3")


def values_of(femur: float, tibia: float) -> dict[str, float]:
    """Return what the inverse test gives of the shipped leg with other bones (N·m²)."""
    units = {FEMUR: "N·m²", TIBIA: "N·m²"}
    outputs = Trial(("inverse",), fixed={"legform": "flex-pli-gtr"}, units=units)(
        {FEMUR: femur, TIBIA: tibia}
    )
    return {name: float(outputs[f"inverse/{name}"]) for name in ASKED}


def ready(folder: Path, values: dict[str, float], tolerance: str, **parts: Any) -> Any:  # noqa: ANN401
    """Return the fit of both bones to values, as an inverse test that has them for its reference."""
    text = (shipped_root() / "procedures/inverse.yaml").read_text("utf-8")
    (folder / "procedures").mkdir()
    (folder / "references").mkdir()
    mine = text.replace("procedure: inverse\n", "procedure: known\nreference: known\n", 1)
    (folder / "procedures/known.yaml").write_text(mine, "utf-8")
    reference = {
        "reference": "known",
        "title": "Simulated",
        "origin": {"source": "simulated for this test", "confidence": "estimated"},
        "values": {n: f"{v!r} {'mm' if n == 'MCL' else 'N·m'}" for n, v in values.items()},
    }
    (folder / "references/known.yaml").write_text(yaml.safe_dump(reference, allow_unicode=True), "utf-8")
    bounds = {"lower": "120 N·m²", "upper": "240 N·m²", "reason": "for the test"}
    sheet: dict[str, Any] = {
        "fit": "known",
        "title": "A leg whose bones are known",
        "legform": "flex-pli-gtr",
        "parameters": [{"path": path, **bounds, **parts.get(path, {})} for path in (FEMUR, TIBIA)],
        "targets": [{"procedure": "known", "to": "reference", "tolerance": tolerance}],
        "search": {"generations": 0, "steps": 30, "pull": 0.0, **parts.get("search", {})},
    }
    return make_ready(CalibrationTask.model_validate(sheet), [folder])


def found(folder: Path, values: dict[str, float], tolerance: str, **parts: Any) -> Calibration:  # noqa: ANN401
    task = ready(folder, values, tolerance, **parts)
    with runs_for(task, Execution(processes=1)) as runs:
        return calibrate(task, runs)


@pytest.mark.parametrize("tolerance", ["5 %", "0.02 %"])
def test_a_known_leg_is_found_however_far_its_values_are_in_tolerances(
    tmp_path: Path, tolerance: str
) -> None:
    point = found(tmp_path, values_of(180.0, 190.0), tolerance).point
    assert point == pytest.approx({FEMUR: 180.0, TIBIA: 190.0}, rel=1e-3)


def test_known_bones_lie_within_their_deviations_as_often_as_these_say(tmp_path: Path) -> None:
    off = []
    for seed in range(8):
        random = np.random.default_rng(seed)
        femur, tibia = (float(stiffness) for stiffness in random.uniform(165, 195, 2))
        noisy = {n: v * (1 + random.uniform(-0.03, 0.03)) for n, v in values_of(femur, tibia).items()}
        (tmp_path / str(seed)).mkdir()
        fit = found(tmp_path / str(seed), noisy, "3 %")
        off += [
            (fit.point[path] - truth) / fit.knowledge.deviations[path]
            for path, truth in ((FEMUR, femur), (TIBIA, tibia))
        ]
    # Of 16, eleven lie within one standard deviation on the average, and hardly one beyond two.
    assert 7 <= sum(abs(z) < 1 for z in off) <= 15
    assert sum(abs(z) > 2 for z in off) <= 2
    assert max(map(abs, off)) < 3.5


def test_a_number_whose_truth_lies_beyond_its_bounds_is_told_to_stand_on_one(tmp_path: Path) -> None:
    fit = found(tmp_path, values_of(180.0, 190.0), "0.5 %", **{TIBIA: {"upper": "182 N·m²"}})
    document = report(fit)
    assert [parameter.on_bound for parameter in document.parameters] == [False, True]
    assert document.rms_after > 1
    assert "on its bound" in calibration_page(document)
    assert "deviations of the parameters are too small" in calibration_page(document).lower()
    assert f"on a bound: {TIBIA}" in calibration_text(document)


def test_another_valley_that_lies_nearer_is_told(tmp_path: Path) -> None:
    values = values_of(150.0, 215.0)
    for name, factor in (("T1", 1.03), ("F1", 1.04), ("F2", 1.04), ("MCL", 0.96)):
        values[name] *= factor
    document = report(found(tmp_path, values, "5 %", search={"basins": 3}))
    assert document.nearer_elsewhere
    assert "Another search came nearer" in calibration_page(document)
    assert "start: anywhere" in calibration_text(document)


def test_five_per_cent_of_nothing_is_no_tolerance(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"known/T4: 5 % of 0 is nothing; leave it out"):
        ready(tmp_path, {**values_of(180.0, 190.0), "T4": 0.0}, "5 %")


def test_a_prior_that_contradicts_the_tests_is_heard(tmp_path: Path) -> None:
    prior = {"prior": {"mean": "150 N·m²", "sd": "0.5 N·m²"}}
    fit = found(tmp_path, values_of(180.0, 190.0), "5 %", **{FEMUR: prior})
    assert fit.point[FEMUR] == pytest.approx(150.0, abs=1.0)
    assert fit.knowledge.deviations[FEMUR] == pytest.approx(0.5, rel=0.02)
    # That is the prior's doing: the tests themselves leave more.
    assert fit.knowledge.narrowed[FEMUR] > 0.1


def test_a_prior_narrows_a_number_without_the_tests_determining_it() -> None:
    space = Space((Axis("a", "mm", 0.0, 10.0, 5.0, prior=(5.0, 0.1)), Axis("b", "mm", 0.0, 10.0, 5.0)))
    known = knowledge(space, np.array([0.5, 0.5]), np.array([[3.0, 3.0]]))
    assert known.deviations["a"] == pytest.approx(0.1, rel=0.01)
    # a is known from elsewhere, so what the tests say of the sum says b: a third of √3 shares.
    assert known.deviations["b"] == pytest.approx(10 / 3 / 3**0.5, rel=0.2)
    assert set(known.open[0].parts) == {"a", "b"}


def test_no_value_counts_as_far_as_one_that_is_missing() -> None:
    goal, space = Goal("p/T1", 0.0, 1.0, "N·m", 1.0, graded=False), Space(())

    def size(outputs: dict[str, float]) -> float:
        return float(residuals([goal], space, {}, Outcome(outputs), 0.0)[0])

    distances = [size({"p/T1": value}) for value in (1.0, 19.0, 21.0, 80.0, 900.0)]
    assert distances == sorted(distances)
    assert distances[:2] == [1.0, 19.0]
    assert distances[-1] < size({})
    assert size({"p/T1": -80.0}) == -distances[3]


def failing_above(point: Any) -> Any:  # noqa: ANN401
    if point["a"] > 0.502:
        raise ValueError("too much")
    return {"p/T1": 3.0 * point["a"]}


def test_a_run_that_fails_beside_the_fit_is_no_knowledge_of_a_number() -> None:
    space = Space((Axis("a", "mm", 0.0, 1.0, 0.5),))
    goals = [Goal("p/T1", 1.0, 1.0, "N·m", 1.0, graded=False)]
    with Runs(failing_above, Execution(processes=1)) as runs:
        misfit = Misfit(runs, space, goals, pull=0.0)
        assert misfit.jacobian(np.array([0.5]))[0, 0] == pytest.approx(3.0)
        assert misfit.jacobian(np.array([0.8]))[0, 0] == 0.0
        assert misfit.forward_jacobian(np.array([0.499]))[0, 0] == 0.0


def test_a_target_that_the_run_gives_no_value_of_ends_the_fit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    task = ready(tmp_path, values_of(180.0, 190.0), "5 %", search={"steps": 0})
    call = Trial.__call__
    monkeypatch.setattr(Trial, "__call__", lambda self, point: {**call(self, point), "known/F3": None})
    with (
        runs_for(task, Execution(processes=1)) as runs,
        pytest.raises(RunError, match="no value of known/F3"),
    ):
        calibrate(task, runs)
