"""A fit comes nearer to its targets, says what it does not know, and goes on where it was."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from certkit.definitions.calibration import CalibrationTask
from certkit.definitions.loading.library import load
from certkit.definitions.study import Study
from certkit.documents.rounding import rounded
from certkit.errors import OldFormWarning, RunError, UsageError
from certkit.reporting.study_text import calibration_text
from certkit.studies.calibration.basins import spread_places
from certkit.studies.calibration.fit import make_ready
from certkit.studies.calibration.identifiability import ALONE, knowledge
from certkit.studies.calibration.leg_family import extent, passes
from certkit.studies.calibration.parameter_space import Axis, Space
from certkit.studies.calibration.run_calibration import fit_and_write
from certkit.studies.execution import Execution
from certkit.studies.points import Outcome
from certkit.studies.study_findings import set_up
from certkit.studies.trial import Trial

if TYPE_CHECKING:
    from pathlib import Path

SHEET: dict[str, Any] = {
    "fit": "two-numbers",
    "title": "Two numbers of the inverse test",
    "legform": "flex-pli-gtr",
    "parameters": [
        {
            "path": "legform.parts.femur.bending stiffness",
            "with": ["legform.parts.tibia.bending stiffness"],
            "lower": "100 N·m²",
            "upper": "250 N·m²",
            "reason": "for the test",
        },
        {
            "path": "rig.ram.width on knee",
            "procedure": "inverse",
            "lower": "50 mm",
            "upper": "150 mm",
            "scale": "logarithmic",
            "reason": "for the test",
        },
    ],
    "targets": [{"procedure": "inverse", "criteria": ["T1", "MCL"]}],
    "search": {"generations": 0, "steps": 6, "pull": 0.0},
    "family": {"steps": 4},
}


def changed(**parts: Any) -> CalibrationTask:  # noqa: ANN401
    return CalibrationTask.model_validate({**SHEET, **parts})


def test_a_fit_comes_nearer_and_its_files_give_what_it_says(tmp_path: Path) -> None:
    fit_and_write(make_ready(changed()), tmp_path, execution=Execution(processes=1))
    report = json.loads((tmp_path / "fit.json").read_text())
    assert report["rms_after"] < report["rms_before"]
    leg = load("legform", tmp_path / "flex-pli-gtr.yaml").document
    assert leg.parts["femur"].bending_stiffness == leg.parts["tibia"].bending_stiffness
    assert leg.parts["femur"].bending_stiffness.confidence == "calibrated"
    assert "two-numbers" in leg.parts["femur"].bending_stiffness.source
    # The written files, run again, give the values of the report to all of its digits.
    again = make_ready(
        changed(legform=str(tmp_path / "flex-pli-gtr.yaml"), search={"generations": 0, "steps": 0}),
        [tmp_path],
    )
    outputs = again.trial(again.space.point(again.space.start))
    for value in report["values"]:
        assert rounded(outputs[value["name"]]) == value["after"]


def old_paths() -> CalibrationTask:
    """Return the fit of one number as it was written when a legform's parts stood at the top of its file."""
    parameter = {
        **SHEET["parameters"][0],
        "path": "legform.femur.bending stiffness",
        "with": ["legform.tibia.bending stiffness"],
    }
    return changed(parameters=[parameter], search={"generations": 0, "steps": 1, "pull": 0.0})


def test_a_fit_with_old_paths_writes_files_with_the_paths_of_today(tmp_path: Path) -> None:
    with pytest.warns(OldFormWarning) as told:
        fit_and_write(make_ready(old_paths()), tmp_path, execution=Execution(processes=1))
    assert any("write `legform.parts.femur.bending stiffness`" in str(remark.message) for remark in told)
    leg = load("legform", tmp_path / "flex-pli-gtr.yaml")
    assert leg.remarks == ()
    assert leg.document.parts["femur"].bending_stiffness.confidence == "calibrated"
    assert leg.document.parts["femur"].bending_stiffness == leg.document.parts["tibia"].bending_stiffness


def test_an_old_path_in_a_family_is_written_as_that_of_today() -> None:
    task = make_ready(changed())
    with pytest.warns(OldFormWarning):
        assert task.trial.today("legform.femur.mass") == "legform.parts.femur.mass"
    assert task.trial.today("inverse/rig.ram.width on knee") == "inverse/rig.ram.width on knee"


def test_an_interrupted_fit_ends_where_an_uninterrupted_one_ends(tmp_path: Path) -> None:
    sheet = changed(search={"generations": 2, "population": 5, "steps": 2, "pull": 0.2})
    whole, halved = tmp_path / "whole", tmp_path / "halved"
    fit_and_write(make_ready(sheet), whole, execution=Execution(processes=1))

    class Interrupted(Exception):  # noqa: N818
        pass

    told = 0

    def interrupt(words: str) -> None:
        nonlocal told
        told += 1
        if "generation 2" in words:
            raise Interrupted

    with pytest.raises(Interrupted):
        fit_and_write(make_ready(sheet), halved, execution=Execution(processes=1), tell=interrupt)
    before = (halved / "runs.jsonl").read_bytes()
    fit_and_write(make_ready(sheet), halved, execution=Execution(processes=1))
    assert (halved / "runs.jsonl").read_bytes().startswith(before)
    for name in ("fit.json", "flex-pli-gtr.yaml", "inverse.yaml", "runs.jsonl"):
        assert (halved / name).read_bytes() == (whole / name).read_bytes()


def test_every_member_of_a_family_passes_when_it_is_run_again_with_its_rig(tmp_path: Path) -> None:
    stiffness, width = SHEET["parameters"]
    sheet = changed(
        parameters=[{**stiffness, "with": [], "lower": "150 N·m²", "upper": "190 N·m²"}, width],
        search={"generations": 0, "steps": 0},
    )
    task = make_ready(sheet)
    report = fit_and_write(task, tmp_path, execution=Execution(processes=1), family=3).report
    family = load("family", tmp_path / "families" / "flex-pli-gtr.yaml").document
    assert len({tuple(member.values.items()) for member in family.members}) == 3
    assert all(member.rigs["inverse"].keys() == {"rig.ram.width on knee"} for member in family.members)
    assert report.family is not None
    assert report.family.members == 3
    for member in family.members:
        trial = Trial(task.trial.procedures, fixed={**task.trial.fixed, **member.overrides("inverse")})
        assert trial({})["inverse/verdict"] == "pass"


def test_an_even_spread_is_wide_even_and_of_many_dimensions() -> None:
    even = extent(spread_places(400, 6, seed=3))
    assert even.coverage > 0.98
    assert even.evenness == pytest.approx(1.0, abs=0.05)
    assert even.dimensions > 5
    assert even.distance == pytest.approx(1.0, abs=0.1)


def test_a_family_along_one_line_has_one_dimension() -> None:
    line = np.linspace(0.4, 0.6, 30)[:, None] * np.ones(6)
    narrow = extent(line)
    assert narrow.coverage == pytest.approx(0.2)
    assert narrow.dimensions == pytest.approx(1.0)
    assert narrow.distance < 0.1


def test_values_are_predicted_by_the_others_where_that_is_wanted(tmp_path: Path) -> None:
    sheet = changed(
        parameters=SHEET["parameters"][1:], search={"generations": 0, "steps": 2, "leave one out": True}
    )
    report = fit_and_write(make_ready(sheet), tmp_path, execution=Execution(processes=1)).report
    assert all(isinstance(value.left_out, float) for value in report.values)


def test_other_searches_are_reported_beside_the_fit(tmp_path: Path) -> None:
    search = {"generations": 0, "steps": 1, "basins": 2, "population": 5}
    report = fit_and_write(
        make_ready(changed(search=search)), tmp_path, execution=Execution(processes=1)
    ).report
    assert {basin.start for basin in report.basins} == {"1", "2"}
    assert report.basins[0].squares <= report.basins[1].squares


def test_a_run_that_failed_or_cannot_be_trusted_does_not_pass() -> None:
    assert passes(Outcome({"p/verdict": "pass"}), ("p",))
    assert not passes(Outcome({"p/verdict": "error"}), ("p",))
    assert not passes(Outcome({"p/verdict": "fail"}), ("p",))
    assert not passes(Outcome({}, "it failed"), ("p",))


def test_where_nothing_is_graded_nothing_passes(tmp_path: Path) -> None:
    assert passes(Outcome({"p/verdict": "not evaluated", "q/verdict": "pass"}), ("p", "q"))
    assert passes(Outcome({"p/verdict": "not evaluated"}), ("p",)) is None
    sheet = changed(
        parameters=[{**SHEET["parameters"][0], "with": []}],
        targets=[{"procedure": "inverse-seed", "to": "reference", "criteria": ["T1", "T2"]}],
        search={"generations": 0, "steps": 0},
    )
    document = fit_and_write(make_ready(sheet), tmp_path, execution=Execution(processes=1)).report
    assert document.passes is None
    assert "nothing is graded" in calibration_text(document)
    assert "Nothing is graded." in (tmp_path / "fit.html").read_text("utf-8")
    with pytest.raises(RunError, match="no test that a family could pass"):
        fit_and_write(make_ready(sheet), tmp_path, execution=Execution(processes=1), family=2)


def test_what_the_tests_do_not_touch_is_left_open() -> None:
    space = Space((Axis("seen", "mm", 0.0, 10.0, 5.0), Axis("unseen", "kg", 0.0, 2.0, 1.0)))
    known = knowledge(space, np.array([0.5, 0.5]), np.array([[8.0, 0.0]]))
    assert known.undetermined == ["unseen"]
    assert known.narrowed["seen"] < 0.3 < ALONE
    # Only the bounds are known: a uniform distribution over 2 kg.
    assert known.deviations["unseen"] == pytest.approx(2 / 12**0.5)
    assert [dict(d.parts) for d in known.open] == [{"unseen": pytest.approx(1.0)}]


def test_two_parameters_that_only_act_together_are_told_as_a_direction() -> None:
    space = Space((Axis("a", "mm", 0.0, 1.0, 0.5), Axis("b", "mm", 0.0, 1.0, 0.5)))
    known = knowledge(space, np.array([0.5, 0.5]), np.array([[30.0, 30.0]]))
    assert known.correlations[0][2] < -0.9
    assert known.undetermined == ["a", "b"]
    assert dict(known.open[0].parts) == {
        "a": pytest.approx(0.707, abs=1e-3),
        "b": pytest.approx(-0.707, abs=1e-3),
    }


def test_a_logarithmic_axis_goes_by_ratios_and_back() -> None:
    axis = Axis("a", "N", 1.0, 100.0, 10.0, logarithmic=True)
    assert axis.value(0.5) == 10.0
    assert axis.share(axis.value(0.25)) == pytest.approx(0.25, abs=1e-6)


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        (
            {"parameters": [{**SHEET["parameters"][0], "path": "legform.parts.femur.stiffness"}]},
            r"did you mean `parts\.femur\.joint\.stiffness`",
        ),
        ({"parameters": [{**SHEET["parameters"][0], "lower": "240 N·m²"}]}, "outside its bounds"),
        ({"parameters": [{**SHEET["parameters"][0], "lower": "100 N"}]}, "in N"),
        ({"targets": [{"procedure": "inverse", "criteria": ["T9"]}]}, "no criterion `T9`"),
        ({"targets": [{"procedure": "inverse", "criteria": ["LCL"]}]}, "nothing says where it should be"),
    ],
)
def test_a_fit_that_makes_no_sense_is_refused_before_anything_is_run(
    parts: dict[str, Any], message: str
) -> None:
    with pytest.raises(UsageError, match=message):
        make_ready(changed(**parts))


def test_a_share_of_a_value_with_an_old_path_is_a_share_of_that_value() -> None:
    parameters = [{"path": "legform.femur.mass", "uniform": "10 %"}]
    document = {"study": "s", "title": "t", "procedures": ["inverse"], "parameters": parameters}
    with pytest.warns(OldFormWarning, match=r"write `legform\.parts\.femur\.mass`"):
        trial, (factor,) = set_up(Study.model_validate({**document, "design": {"kind": "one at a time"}}))
    mass = float(trial.nominals()["legform.parts.femur.mass"].split()[0])
    assert (factor.distribution.low, factor.distribution.high) == pytest.approx((0.9 * mass, 1.1 * mass))
