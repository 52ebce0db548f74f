"""One run of a study: what it reads of its definitions, and how it travels."""

from __future__ import annotations

import pickle
from typing import TYPE_CHECKING

import pytest

from certkit.definitions.loading.search_path import shipped_root
from certkit.definitions.study import StudyParameter
from certkit.studies.factors import factor_of
from certkit.studies.optimise import Limit, limits_of
from certkit.studies.trial import Trial

if TYPE_CHECKING:
    from pathlib import Path

LENGTH = "legform.parts.femur.bending stiffness"


def test_runs_share_what_no_point_changes_and_have_their_own_of_the_rest() -> None:
    trial = Trial(("inverse",), units={LENGTH: "N·m²"})
    one, other = (trial.prepared("inverse", {LENGTH: value}) for value in (180.0, 190.0))
    assert one.procedure is other.procedure
    assert [float(s.legform.parts["femur"].bending_stiffness) for s in (one, other)] == [180.0, 190.0]
    assert trial.prepared("inverse", {}).legform == Trial(("inverse",)).prepared("inverse", {}).legform


def test_a_changed_procedure_does_not_stay_for_the_next_point() -> None:
    trial = Trial(("inverse",), units={"rig.ram.mass": "kg"})
    as_it_stands = trial.prepared("inverse", {}).procedure
    changed = trial.prepared("inverse", {"rig.ram.mass": 8.2}).procedure
    assert changed.rig != as_it_stands.rig
    assert trial.prepared("inverse", {}).procedure is as_it_stands


def test_all_runs_meet_a_file_as_the_first_one_did(tmp_path: Path) -> None:
    own = tmp_path / "own.yaml"
    own.write_bytes((shipped_root() / "procedures" / "inverse.yaml").read_bytes())
    trial = Trial((str(own),))
    first = trial.prepared(str(own), {}).procedure
    own.write_text("procedure: changed meanwhile", encoding="utf-8")
    assert trial.prepared(str(own), {}).procedure is first


def test_a_trial_that_has_read_its_files_reads_them_where_it_has_travelled_to() -> None:
    trial = Trial(("inverse",))
    trial.context  # noqa: B018  # reads everything
    there = pickle.loads(pickle.dumps(trial))  # noqa: S301  # our own bytes
    assert there == trial
    assert there.prepared("inverse", {}).procedure == trial.prepared("inverse", {}).procedure


def test_a_time_is_in_milliseconds_whatever_channel_it_is_of(tmp_path: Path) -> None:
    text = (shipped_root() / "procedures" / "inverse.yaml").read_text("utf-8")
    own = "{id: when, title: When, channel: T1, measure: time of max, corridor: late/when}"
    text = text.replace("procedure: inverse", "procedure: own").replace("criteria:", f"criteria:\n  - {own}")
    (tmp_path / "own.yaml").write_text(text, encoding="utf-8")
    (tmp_path / "late.yaml").write_text(
        "corridors: late\ntitle: Late\norigin: {source: of this test, confidence: estimated}\n"
        "windows: {when: {lower: 5 ms, upper: 30 ms}}\n",
        encoding="utf-8",
    )
    trial = Trial(("own",), library=(str(tmp_path),))
    assert trial.output_units()["own/when"] == "ms"
    assert limits_of(trial)["own/when"] == Limit(5.0, 30.0)


def test_a_point_of_a_curve_has_its_value_in_the_definitions_and_takes_a_share_of_it() -> None:
    trial = Trial(("vehicle",), fixed={"vehicle": "generic-saloon"})
    name = "vehicle.springs.spoiler foam.loading.22 mm"
    parameter = StudyParameter.model_validate({"path": name, "uniform": "30 %"})
    factor = factor_of(parameter, trial.nominals([name]))
    assert factor.nominal == 1540.0
    assert (factor.distribution.low, factor.distribution.high) == pytest.approx((1078.0, 2002.0))
    assert trial.prepared("vehicle", {}).vehicle.springs["spoiler foam"].loading[1][1] == 1540.0
