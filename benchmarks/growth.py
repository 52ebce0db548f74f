"""How time grows with the size of the problem: segments, vehicle groups, simulated time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from clock import Row, exponent, processor_seconds
from msgspec.structs import replace

from certkit.bench.setup import Setup, prepare
from certkit.definitions.vehicle import Vehicle
from certkit.mechanics import simulate

if TYPE_CHECKING:
    from collections.abc import Iterator


def rows() -> Iterator[Row]:
    """Yield the exponents."""
    sizes = [9, 18, 36, 72]  # four of nine segments are the femur's
    setups = [prepare("inverse", overrides=_segments(n)) for n in (1, 2, 4, 8)]
    times = [processor_seconds(lambda s=setup: _run(s, 2e-6, 0.004)) for setup in setups]
    yield Row(
        "growth of time with segments, exponent", exponent([float(n) for n in sizes], times), "", 1.15, "most"
    )
    groups = [8, 32, 128]
    fronts = [_front(count) for count in groups]
    test = prepare("vehicle")
    times = [
        processor_seconds(lambda v=front: _run(replace(test, vehicle=v), 1e-5, 0.03)) for front in fronts
    ]
    slope = exponent([float(count) for count in groups], times)
    yield Row("growth of time with vehicle groups, exponent", slope, "", 1.15, "most")
    spans = [0.02, 0.04, 0.08, 0.16]
    setup = prepare("inverse")
    times = [processor_seconds(lambda u=until: _run(setup, 2e-5, u)) for until in spans]
    yield Row("growth of time with simulated time, exponent", exponent(spans, times), "", 1.15, "most")


def _segments(share: int) -> dict[str, str]:
    """Return the changes for nine times `share` segments.

    Short segments are stiff: their damping is taken out, and all sizes take the step that the shortest need,
    for it is the cost of a step that is asked.
    """
    counts = {"femur": 4 * share, "tibia": 5 * share}
    return {
        path: value
        for bone, count in counts.items()
        for path, value in (
            (f"legform.{bone}.segments", str(count)),
            (f"legform.{bone}.damping time", "0.0001 ms"),
        )
    }


def _front(count: int) -> Vehicle:
    """Return a front of that many groups, one above the other, each on a spring to the ground."""
    height = 800 / count
    return Vehicle.model_validate(
        {
            "vehicle": "benchmark",
            "title": "Groups one above the other",
            "origin": {"source": "benchmark", "confidence": "estimated"},
            "groups": {
                f"G{i}": {
                    "kind": "fascia",
                    "mass": f"{5 / count} kg",
                    "position": "0 mm",
                    "low": f"{100 + i * height} mm",
                    "high": f"{100 + (i + 1) * height} mm",
                }
                for i in range(count)
            },
            "connections": [
                {
                    "between": [f"G{i}", "ground"],
                    "loading": [["0 mm", "0 N"], ["80 mm", f"{20_000 / count} N"]],
                    "unloading": f"{1000 / count} N/mm",
                    "damping": "40 N·s/m",
                }
                for i in range(count)
            ],
        }
    )


def _run(setup: Setup, step: float, until: float) -> None:
    """Simulate the inverse test with another step and end."""
    procedure = setup.procedure
    end = type(procedure.run.until)(until, f"{until} s", "benchmark", "estimated")
    run = procedure.run.model_copy(update={"until": end})
    simulate(procedure.model_copy(update={"run": run}), setup.legform, time_step=step, vehicle=setup.vehicle)
