"""Many runs: a Latin hypercube over the inverse test in one process and in two, the same to the bit."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from clock import Row, exponent

from certkit.definitions.study import Study
from certkit.studies.designs.latin_hypercube import latin_hypercube
from certkit.studies.execution import Execution
from certkit.studies.runs import Runs
from certkit.studies.study_findings import set_up

if TYPE_CHECKING:
    from collections.abc import Iterator

RUNS = 1000
SHEET = {
    "study": "benchmark",
    "title": "Scatter of the inverse test",
    "procedures": ["inverse"],
    "parameters": [
        {"path": "rig.ram.speed", "normal": {"sd": "1 %"}},
        {"path": "rig.ram.mass", "uniform": "1 %"},
        {"path": "rig.ram.top edge", "uniform": ["-2 mm", "2 mm"]},
        {"path": "legform.femur.bending stiffness", "uniform": "5 %"},
        {"path": "legform.knee.condyles.friction", "uniform": "20 %"},
    ],
    "design": {"kind": "latin hypercube", "runs": RUNS},
}


def rows() -> Iterator[Row]:
    """Yield runs a second, the gain of a second process, and the growth with the number of runs."""
    trial, factors = set_up(Study.model_validate(SHEET))
    points = latin_hypercube(factors, RUNS, 1)
    seconds, outcomes = {}, {}
    for processes in (1, 2):
        with Runs(trial, Execution(processes=processes)) as runs:
            runs(points[:20])  # warm the workers
            start = time.perf_counter()
            outcomes[processes] = runs(points[20:])
            seconds[processes] = time.perf_counter() - start
        yield Row(f"inverse runs a second, {processes} process(es)", (RUNS - 20) / seconds[processes], "1/s")
    if outcomes[1] != outcomes[2]:
        raise SystemExit("two processes gave other numbers than one")
    yield Row(
        f"gain of two processes over one, {RUNS} runs, same bits", seconds[1] / seconds[2], "", 1.7, "least"
    )
    sizes, times = [25, 50, 100, 200], []
    for size in sizes:
        with Runs(trial, Execution(processes=1)) as runs:
            start = time.process_time()
            runs(points[:size])
            times.append(time.process_time() - start)
    yield Row(
        "growth of time with runs, exponent", exponent([float(s) for s in sizes], times), "", 1.15, "most"
    )
