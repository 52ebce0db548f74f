"""A fit may aim at recorded curves, and says how well the simulated ones follow them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from msgspec.structs import replace

from certkit.definitions.calibration import CalibrationTask
from certkit.definitions.loading.channel_tables import default_channels
from certkit.definitions.loading.library import load
from certkit.errors import DataError, UsageError
from certkit.mechanics import simulate
from certkit.reporting.study_text import calibration_text
from certkit.signals import Channel, Filtered, Recording
from certkit.studies.calibration.fit import make_ready
from certkit.studies.calibration.run_calibration import fit_and_write
from certkit.studies.execution import Execution
from certkit.studies.recorded_curve import RecordedCurve, curve_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path


def filtered_channels(time: np.ndarray, **series: np.ndarray) -> Filtered:
    channels = {
        name: Channel(
            name, default_channels().kinds[name].title, default_channels().kinds[name].dimension, values
        )
        for name, values in ((key.replace("_", " "), v) for key, v in series.items())
    }
    return Filtered(Recording("simulated", time, channels))


def half_sine(scale: float = 1.0, delay: float = 0.0, **changes: Any) -> tuple[RecordedCurve, Filtered]:  # noqa: ANN401
    """Return a recorded half sine of 100 N·m and 40 ms, and a simulated one that differs from it."""
    time = np.linspace(0, 0.06, 601)
    recorded = 100 * np.sin(np.pi * np.clip(time, 0, 0.04) / 0.04)
    simulated = scale * 100 * np.sin(np.pi * np.clip(time - delay, 0, 0.04) / 0.04)
    curve = RecordedCurve("p", "", "T1", "none", tuple(time), tuple(recorded), 0.0, 0.05)
    return replace(curve, **changes), filtered_channels(time, T1=simulated)


def test_a_curve_that_follows_the_recorded_one_exactly_deviates_by_nothing() -> None:
    curve, ours = half_sine(scored=True)
    outputs = curve.outputs(ours)
    assert outputs["p/T1 over time rms %"] == pytest.approx(0, abs=1e-9)
    assert outputs["p/T1 over time peak error %"] == pytest.approx(0, abs=1e-9)
    assert outputs["p/T1 over time time error ms"] == 0
    assert outputs["p/T1 over time score"] == pytest.approx(1)


def test_rms_peak_and_time_errors_are_those_of_the_formulas() -> None:
    curve, ours = half_sine(scale=1.1)
    outputs = curve.outputs(ours)
    # 10 % of a half sine over four fifths of the window: 10 % · √(4/5 · 1/2).
    assert outputs["p/T1 over time rms %"] == pytest.approx(10 * np.sqrt(0.4), rel=1e-2)
    assert outputs["p/T1 over time peak error %"] == pytest.approx(10)
    curve, ours = half_sine(delay=0.003)
    assert curve.outputs(ours)["p/T1 over time time error ms"] == pytest.approx(3, abs=0.05)
    curve, ours = half_sine(scale=-1.0, y=tuple(-v for v in half_sine()[0].y))
    assert curve.outputs(ours)["p/T1 over time peak error %"] == pytest.approx(0, abs=1e-9)


def test_all_places_together_give_the_rms(leg_recording: Callable[[str], Path]) -> None:
    folder = leg_recording("220 N·m²")
    task = make_ready(fit_to(folder, points=200))
    outputs = task.trial(task.space.point(task.space.start))
    (curve,) = [c for c in task.trial.curves if c.ordinate == "T2"]
    squares = [goal.distance(outputs[goal.name]) ** 2 for goal in task.goals if goal.curve == curve.name]
    assert len(squares) == 200
    rms = 0.05 * 100 * np.sqrt(np.mean(squares))
    assert rms == pytest.approx(outputs[f"{curve.name} rms %"], rel=2e-2)
    assert rms > 1


def test_one_channel_over_another_is_read_where_it_first_reaches_a_value() -> None:
    time = np.arange(6.0)
    wobbling = np.array([0.0, 1.0, 0.8, 2.0, 2.0, 3.0])
    filtered = filtered_channels(time, MCL=wobbling, ram_force=time)
    x, y = curve_of(filtered, "MCL", "ram force", "none")
    assert x.tolist() == [0.0, 1.0, 2.0, 3.0]
    assert y.tolist() == [0.0, 1.0, 3.0, 5.0]


def test_a_simulation_that_ends_before_the_window_is_an_error_with_both_spans() -> None:
    curve, ours = half_sine(end=0.08)
    with pytest.raises(DataError, match=r"simulated from 0 to 60 ms, wanted from 0 to 80 ms"):
        curve.outputs(ours)


@pytest.fixture(scope="module")
def leg_recording(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return what simulates the inverse test with another bending stiffness and writes it as CSV."""

    def write(stiffness: str) -> Path:
        folder = tmp_path_factory.mktemp("recorded")
        changes = {f"parts.{bone}.bending stiffness": stiffness for bone in ("femur", "tibia")}
        leg = load("legform", "flex-pli-gtr", overrides=changes).document
        recording = simulate(load("procedure", "inverse").document, leg).recording
        columns = [1e3 * recording.time, *(-recording[name].values for name in ("T1", "T2", "F1"))]
        np.savetxt(folder / "test.csv", np.stack(columns, 1), "%.9g", ",", header="ms,a,b,c", comments="")
        mapped = "".join(
            f"    {channel}: {{column: {column}, unit: N·m, sign: -1}}\n"
            for channel, column in (("T1", "a"), ("T2", "b"), ("F1", "c"))
        )
        text = f"mapping: turned\ncsv:\n  time: {{column: ms, unit: ms}}\n  columns:\n{mapped}"
        (folder / "turned.yaml").write_text(text)
        return folder

    return write


def fit_to(folder: Path, **target: Any) -> Path:  # noqa: ANN401
    """Write a fit of both bones' stiffness beside the recording."""
    sheet = {
        "fit": "stiffness",
        "title": "Bending stiffness from histories",
        "legform": "flex-pli-gtr",
        "parameters": [
            {
                "path": "legform.parts.femur.bending stiffness",
                "with": ["legform.parts.tibia.bending stiffness"],
                "lower": "100 N·m²",
                "upper": "300 N·m²",
                "reason": "for the test",
            }
        ],
        "targets": [
            {
                "procedure": "inverse",
                "to": "recording",
                "recording": "test.csv",
                "mapping": "turned.yaml",
                "channels": ["T1", "T2", "F1"],
                "filter": "CFC 180",
                "window": ["0 ms", "49 ms"],
                **target,
            }
        ],
        "search": {"generations": 0, "steps": 8, "pull": 0.0},
    }
    path = folder / "fit.yaml"
    path.write_text(json.dumps(sheet))  # JSON is YAML
    return path


@pytest.mark.parametrize("measure", ["rms", "peak", "ISO/TS 18571"])
def test_a_fit_to_histories_finds_the_stiffness_they_were_made_with(
    leg_recording: Callable[[str], Path], tmp_path: Path, measure: str
) -> None:
    folder = leg_recording("190 N·m²")
    task = make_ready(fit_to(folder, measure=measure))
    document = fit_and_write(task, tmp_path, execution=Execution(processes=1)).report
    summary = calibration_text(document)
    leg = load("legform", tmp_path / "flex-pli-gtr.yaml").document
    assert leg.parts["femur"].bending_stiffness == pytest.approx(190, rel=5e-3)
    report = json.loads((tmp_path / "fit.json").read_text())
    assert [curve["name"] for curve in report["curves"]] == [
        f"inverse/{name} over time" for name in ("T1", "T2", "F1")
    ]
    for curve in report["curves"]:
        assert curve["after"]["rms_percent"] < 0.5 < curve["before"]["rms_percent"]
        assert curve["name"] in summary
    assert "inverse/T1 over time" in (tmp_path / "fit.html").read_text()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"window": ["0 ms", "90 ms"]}, "does not cover the window"),
        ({"window": ["30 ms", "20 ms"]}, "the window is empty"),
        ({"channels": ["T9"]}, "no channel is called `T9`"),
        ({"recording": "none.csv"}, "no such file"),
        ({"tolerance": "5 mm"}, "has to be a share"),
        ({"tolerance": "0 %"}, "0 % of the recorded peak is nothing"),
    ],
)
def test_a_target_that_cannot_be_aimed_at_is_refused_before_anything_runs(
    leg_recording: Callable[[str], Path], change: dict[str, Any], message: str
) -> None:
    with pytest.raises((UsageError, DataError), match=message):
        make_ready(fit_to(leg_recording("180 N·m²"), **change))


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ({"to": "recording", "channels": ["T1"]}, "the file is missing"),
        ({"to": "recording", "recording": "a.csv"}, "either `channels`"),
        ({"recording": "a.csv"}, "write `to: recording`"),
        (
            {
                "to": "recording",
                "recording": "a.csv",
                "curve": {"x": "MCL", "y": "T1"},
                "measure": "ISO/TS 18571",
            },
            "curves over time",
        ),
    ],
)
def test_a_target_says_one_thing(target: dict[str, Any], message: str) -> None:
    parameter = {"path": "legform.femur.mass", "lower": "1 kg", "upper": "2 kg", "reason": "for the test"}
    with pytest.raises(ValueError, match=message):
        CalibrationTask.model_validate(
            {
                "fit": "f",
                "title": "t",
                "legform": "flex-pli-gtr",
                "parameters": [parameter],
                "targets": [{"procedure": "inverse", **target}],
            }
        )
