"""Many runs: a Latin hypercube over the inverse test in one process and in two, the same to the bit."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from clock import Row, exponent, seconds_in_turn

from certkit.definitions.study import Study
from certkit.mechanics import simulate
from certkit.studies.designs.latin_hypercube import latin_hypercube
from certkit.studies.execution import Execution
from certkit.studies.runs import Runs
from certkit.studies.study_findings import set_up

if TYPE_CHECKING:
    from collections.abc import Iterator

RUNS = 1000
VEHICLES = int(os.environ.get("CERTKIT_VEHICLE_RUNS", "10000"))
SHEET: dict[str, Any] = {
    "study": "benchmark",
    "title": "Scatter of the inverse test",
    "procedures": ["inverse"],
    "parameters": [
        {"path": "rig.ram.speed", "normal": {"sd": "1 %"}},
        {"path": "rig.ram.mass", "uniform": "1 %"},
        {"path": "rig.ram.top edge", "uniform": ["-2 mm", "2 mm"]},
        {"path": "legform.parts.femur.bending stiffness", "uniform": "5 %"},
        {"path": "legform.knee.condyles.friction", "uniform": "20 %"},
    ],
    "design": {"kind": "latin hypercube", "runs": RUNS},
}


def rows() -> Iterator[Row]:
    """Yield runs a second, the gain of a second process, and the growth with the number of runs.

    The gain is of processor time: of one process over that of the busiest of several, which others on the
    machine cannot move. Runs a second are by the clock.
    """
    trial, factors = set_up(Study.model_validate(SHEET))
    points = latin_hypercube(factors, RUNS, 1)
    busiest, outcomes = {}, {}
    for processes in (1, 2):
        with Runs(trial, Execution(processes=processes)) as runs:
            runs(points[:20])  # warm the workers
            start, before = time.perf_counter(), _processor_seconds()
            outcomes[processes] = runs(points[20:])
            seconds, after = time.perf_counter() - start, _processor_seconds()
            busiest[processes] = max(spent - before.get(number, 0.0) for number, spent in after.items())
        yield Row(f"inverse runs a second, {processes} process(es)", (RUNS - 20) / seconds, "1/s")
    if outcomes[1] != outcomes[2]:
        raise SystemExit("two processes gave other numbers than one")
    yield Row(
        f"gain of two processes over one, {RUNS} runs, same bits", busiest[1] / busiest[2], "", 1.8, "least"
    )
    yield from _beside_simulation()
    yield from _flat()


def _beside_simulation() -> Iterator[Row]:
    """Yield what a run of a study costs beside its simulation, processor time, over the same points."""
    for procedure in ("inverse", "pendulum", "vehicle"):
        paths = [parameter for parameter in SHEET["parameters"] if parameter["path"].startswith("legform")]
        trial, factors = set_up(
            Study.model_validate({**SHEET, "procedures": [procedure], "parameters": paths})
        )
        points = latin_hypercube(factors, 12, 1)
        setups = [trial.prepared(procedure, point) for point in points]
        run, alone = seconds_in_turn(
            lambda t=trial, p=points: [t(point) for point in p],
            lambda s=setups: [simulate(x.procedure, x.legform, vehicle=x.vehicle) for x in s],
        )
        yield Row(f"{procedure}: run of a study over its simulation", run / alone, "", 1.15, "most")


def _flat() -> Iterator[Row]:
    """Yield memory and growth over vehicle runs without a step check, two processes that live on."""
    trial, factors = set_up(
        Study.model_validate({**SHEET, "procedures": ["vehicle"], "parameters": SHEET["parameters"][3:]})
    )
    points = latin_hypercube(factors, VEHICLES, 1)
    sizes = [VEHICLES // 8, VEHICLES // 4, VEHICLES // 2, VEHICLES]
    times, most = [], []
    with Runs(trial, Execution(processes=2)) as runs:
        runs(points[:4])  # starts the workers
        begun = sum(_processor_seconds().values())
        for size in sizes:
            runs(points[:size])  # those before are known
            times.append(sum(_processor_seconds().values()) - begun)
            most.append(max(_peak_megabytes()))
    slope = exponent([float(size) for size in sizes], times)
    yield Row(f"processor time of {VEHICLES} vehicle runs, two processes", times[-1], "s")
    yield Row(f"growth of time with vehicle runs up to {VEHICLES}, exponent", slope, "", 1.05, "most")
    yield Row(f"memory of {VEHICLES} runs over that of an eighth", most[-1] / most[0], "", 1.1, "most")


def _processor_seconds() -> dict[str, float]:
    """Return what this process and its workers have used so far, by their numbers, as Linux tells it."""
    ticks = os.sysconf("SC_CLK_TCK")
    lines = {p.name: (p / "stat").read_text().rpartition(")")[2].split() for p in _processes()}
    return {number: (int(line[11]) + int(line[12])) / ticks for number, line in lines.items()}


def _peak_megabytes() -> list[float]:
    """Return the most memory that each of them has held."""
    lines = [(process / "status").read_text().partition("VmHWM:")[2].split() for process in _processes()]
    return [int(line[0]) / 1024 for line in lines]


def _processes(parent: int | None = None) -> list[Path]:
    """Return this process and all that were started from it: a server starts the workers."""
    own = Path("/proc", str(parent or os.getpid()))
    children = (own / "task" / own.name / "children").read_text().split()
    return [own, *(process for child in children for process in _processes(int(child)))]
