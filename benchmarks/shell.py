"""One run from the shell, cold and warm, by phase, beside what its imports and the solver take."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from typing import TYPE_CHECKING

from clock import Row, child_seconds, processor_seconds, wall_seconds

if TYPE_CHECKING:
    from collections.abc import Iterator

IMPORTS = "import numpy, pymunk, pydantic"
# What a run imports as it is built: definitions of pydantic in YAML, commands of typer, a kept solver.
LIBRARIES = (
    "import os\n"
    "os.environ['PYDANTIC_DISABLE_PLUGINS'] = '__all__'\n"
    "import numpy, pymunk, pydantic, typer, yaml, llvmlite.binding\n"
    "class Definition(pydantic.BaseModel):\n"
    "    title: str\n"
)
SOLVER = (
    "import time\n"
    "from certkit.bench.setup import prepare\n"
    "from certkit.mechanics import simulate\n"
    "s = prepare('inverse')\n"
    "simulate(s.procedure, s.legform, vehicle=s.vehicle)\n"
    "t = time.process_time()\n"
    "for k in range(10): simulate(s.procedure, s.legform, vehicle=s.vehicle)\n"
    "print((time.process_time() - t) / 10)\n"
)


def rows() -> Iterator[Row]:
    """Yield times of single runs."""
    solve = float(_python(SOLVER))
    # A run simulates three times: as reported, with half the step (twice the work), with more iterations.
    solver = 4 * solve
    yield Row("inverse test, one simulation without step check", solve, "s")
    yield Row("  as promised for one run of 60 ms (processor time)", solve, "s", 0.15, "most")
    with tempfile.TemporaryDirectory() as folder:
        # As installed: with bytecode, which some machines are told not to write. One thread counts clearly.
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": f"{folder}/bytecode", "OPENBLAS_NUM_THREADS": "1"}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        _certkit("junit", environment)
        cold = {**environment, "CERTKIT_CACHE": f"{folder}/solver"}
        yield Row(
            "certkit run --procedure inverse --format junit, solver not compiled yet",
            wall_seconds(lambda: _certkit("junit", cold), 1),
            "s",
        )
        bare, imports, libraries, warm = child_seconds(
            lambda: _python("pass", environment),
            lambda: _python(IMPORTS, environment),
            lambda: _python(LIBRARIES, environment),
            lambda: _certkit("junit", environment),
        )
        yield Row("the same, warm (processor time)", warm, "s")
        yield Row("  python with numpy, pymunk and pydantic", imports, "s")
        yield Row("  of which python itself", bare, "s")
        yield Row("  the solver, with step and iteration check", solver, "s")
        yield Row("warm run / (imports + solver)", warm / (imports + solver), "", 1.5, "most")
        yield Row("  python with all libraries of a run, and one class made", libraries, "s")
        yield Row("  warm run / (these libraries + solver)", warm / (libraries + solver))
        for formats in ("junit,html", "junit,html,pdf"):
            yield Row(
                f"certkit run --procedure inverse --format {formats}",
                wall_seconds(lambda f=formats: _certkit(f, environment)),
                "s",
            )
    yield from _phases()


def _phases() -> Iterator[Row]:
    """Yield the phases of one run inside a warm process."""
    from certkit.bench.setup import prepare  # noqa: PLC0415  # timed from here on
    from certkit.grading import grade_criteria, measure_all  # noqa: PLC0415  # likewise
    from certkit.mechanics import simulate  # noqa: PLC0415  # likewise

    yield Row("  phase: load and check definitions", processor_seconds(lambda: prepare("inverse")), "s")
    setup = prepare("inverse")
    simulation = simulate(setup.procedure, setup.legform, vehicle=setup.vehicle)
    yield Row(
        "  phase: simulate",
        processor_seconds(lambda: simulate(setup.procedure, setup.legform, vehicle=setup.vehicle)),
        "s",
    )
    yield Row(
        "  phase: grade",
        processor_seconds(
            lambda: grade_criteria(measure_all(setup.procedure, simulation.recording), setup.corridors)
        ),
        "s",
    )


def _python(code: str, environment: dict[str, str] | None = None) -> str:
    command = [sys.executable, "-c", code]
    return subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout


def _certkit(formats: str, environment: dict[str, str] | None = None) -> None:
    with tempfile.TemporaryDirectory() as folder:
        command = ["run", "--procedure", "inverse", "--format", formats, "--out", folder, "--quiet"]
        done = subprocess.run(
            [sys.executable, "-m", "certkit", *command], capture_output=True, check=False, env=environment
        )
    if done.returncode not in {0, 1, 4}:
        raise SystemExit(done.stderr.decode())
