"""How time grows with the size of the problem: segments, vehicle groups, simulated time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from clock import Row, exponent, processor_seconds

from certkit.bench.setup import Setup, prepare
from certkit.mechanics import simulate

if TYPE_CHECKING:
    from collections.abc import Iterator


def rows() -> Iterator[Row]:
    """Yield the exponents."""
    sizes = [9, 18, 36, 72]  # four of nine segments are the femur's
    setups = [
        prepare("inverse", overrides=[f"legform.femur.segments={4 * n}", f"legform.tibia.segments={5 * n}"])
        for n in (1, 2, 4, 8)
    ]
    # Short segments are stiff; all take the step that the shortest need, for the cost of a step is asked.
    times = [processor_seconds(lambda s=setup: _run(s, 2e-6, 0.004)) for setup in setups]
    yield Row(
        "growth of time with segments, exponent", exponent([float(n) for n in sizes], times), "", 1.15, "most"
    )
    spans = [0.02, 0.04, 0.08, 0.16]
    setup = prepare("inverse")
    times = [processor_seconds(lambda u=until: _run(setup, 2e-5, u)) for until in spans]
    yield Row("growth of time with simulated time, exponent", exponent(spans, times), "", 1.15, "most")


def _run(setup: Setup, step: float, until: float) -> None:
    """Simulate the inverse test with another step and end."""
    procedure = setup.procedure
    end = type(procedure.run.until)(until, f"{until} s", "benchmark", "estimated")
    run = procedure.run.model_copy(update={"until": end})
    simulate(procedure.model_copy(update={"run": run}), setup.legform, time_step=step, vehicle=setup.vehicle)
