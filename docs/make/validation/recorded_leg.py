"""Section on the lumped leg of the finite-element leg: how it follows that leg's own tests."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.studies.calibration.fit import make_ready
from docs.make.markdown import figure, signed, table

if TYPE_CHECKING:
    from collections.abc import Callable

FIT = Path(__file__).parents[3] / "examples" / "calibrate" / "fe-leg" / "fit.yaml"


def followed_table(tell: Callable[[str], None]) -> str:
    """Run the five tests with the shipped leg and hold every curve against its recording."""
    tell("run the finite-element leg's own tests")
    task = make_ready(FIT)
    outputs = task.trial(task.space.point(task.space.start))

    def number(name: str) -> float | None:
        value = outputs.get(name)
        return value if isinstance(value, float) else None

    rows = []
    for curve in task.trial.curves:
        rms, peak, error, late = (
            number(f"{curve.name} {word}") for word in ("rms %", "peak", "peak error %", "time error ms")
        )
        procedure, _, words = curve.name.partition("/")
        rows.append(
            (
                f"`{procedure}`",
                words,
                "–" if rms is None else f"{rms:.1f}",
                f"{figure(curve.peak * curve.dimension.scale)} {curve.dimension.unit}",
                "–" if peak is None else figure(peak),
                "–" if error is None else signed(error),
                "–" if late is None else signed(late),
            )
        )
    heads = ("test", "curve", "rms, % of peak", "recorded peak", "peak here", "error, %", "late by, ms")
    return table(heads, rows)
