"""Against version 0.1.0, unpacked from this repository's history: help, a warm run, the solver, all tests."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from clock import Row, child_seconds, waited_seconds

if TYPE_CHECKING:
    from collections.abc import Iterator

VERSION = "0.1.0"
COMMIT = "21e88c19d583"
"""Where 0.1.0 ended."""

PROCEDURES = ("inverse", "pendulum", "vehicle", "static-femur", "static-tibia", "static-knee")
"""Tests that both versions have."""

INVERSE = ("run", "-p", "inverse", "--format", "junit", "--quiet")
SOLVER = f"""
import json, time
from certkit.bench.setup import prepare
from certkit.mechanics import simulate
found = {{}}
for name in {PROCEDURES!r}:
    s = prepare(name)
    static = name.startswith("static")  # of which a whole one is compared: its steps mean nothing
    simulate(s.procedure, s.legform, vehicle=s.vehicle)
    spent = []
    for _ in range(3):
        begun = time.process_time()
        steps = simulate(s.procedure, s.legform, vehicle=s.vehicle).quality.steps
        spent.append((time.process_time() - begun) / (1 if static else steps))
    found[name] = min(spent)
print(json.dumps(found))
"""
ROUNDS = 3


def rows() -> Iterator[Row]:
    """Yield ratios of processor times, this version's over that of 0.1.0; nothing without its commit."""
    here = Path(__file__).parent.parent
    with tempfile.TemporaryDirectory() as folder:
        old = Path(folder) / "before"
        if not _unpacked(here, old):
            print(f"version {VERSION} ({COMMIT}) is not in this checkout's history: no comparison")
            return
        now, before = _environment(here, folder, "now"), _environment(old, folder, "old")
        for environment in (now, before):
            _certkit(environment, *INVERSE)
        for words, command in {"certkit --help": ("--help",), "a warm run of inverse": INVERSE}.items():
            after, earlier = child_seconds(
                lambda c=command: _certkit(now, *c), lambda c=command: _certkit(before, *c)
            )
            promise = 1.0 if command == ("--help",) else None
            yield Row(f"{words}: now over {VERSION}", after / earlier, "", promise, "most")
        # The step check runs beside the rest: what is promised is how long a person waits.
        after, earlier = waited_seconds(lambda: _certkit(now, *INVERSE), lambda: _certkit(before, *INVERSE))
        yield Row(
            f"a warm run of inverse, by the clock: now over {VERSION}", after / earlier, "", 1.0, "most"
        )
        yield from _solver(now, before)
        named = [word for name in PROCEDURES for word in ("-p", name)]
        after, earlier = child_seconds(
            *(lambda e=environment: _certkit(e, "run", *named, "--quiet") for environment in (now, before)),
            repeats=2,
        )
        yield Row(f"run of all tests with page and PDF: now over {VERSION}", after / earlier, "", 0.5, "most")


def _solver(now: dict[str, str], before: dict[str, str]) -> Iterator[Row]:
    """Yield the time of a static test, else of one step, which does not depend on how long a test lasts."""
    least: list[dict[str, float]] = [{}, {}]
    for _ in range(ROUNDS):
        for environment, best in zip((now, before), least, strict=True):
            done = subprocess.run(
                [sys.executable, "-c", SOLVER],
                check=True,
                capture_output=True,
                env=environment,
                cwd=environment["PYTHONPATH"],  # where Python looks first
            )
            for name, seconds in json.loads(done.stdout).items():
                best[name] = min(seconds, best.get(name, seconds))
    for name in PROCEDURES:
        ratio = least[0][name] / least[1][name]
        what = "simulation" if name.startswith("static") else "simulation, per time step"
        yield Row(f"{name}: {what}, now over {VERSION}", ratio, "", 1.05, "most")


def _unpacked(repository: Path, place: Path) -> bool:
    """Unpack the version's files; False where the history does not go back to it."""
    packed = subprocess.run(
        ["git", "-C", str(repository), "archive", COMMIT],  # noqa: S607  # whichever git there is
        check=False,
        capture_output=True,
    )
    if packed.returncode:
        return False
    with tarfile.open(fileobj=io.BytesIO(packed.stdout)) as archive:
        archive.extractall(place, filter="data")
    return True


def _environment(root: Path, folder: str, name: str) -> dict[str, str]:
    """Return the surroundings in which a version is what `certkit` means, with bytecode and solver kept."""
    own = {
        "PYTHONPATH": str(root),
        "PYTHONPYCACHEPREFIX": f"{folder}/{name}-bytecode",
        "CERTKIT_CACHE": f"{folder}/{name}-solver",
        "OPENBLAS_NUM_THREADS": "1",
    }
    environment = {**os.environ, **own}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    return environment


def _certkit(environment: dict[str, str], *command: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, "-m", "certkit", *command],
            capture_output=True,
            check=False,
            env=environment,
            cwd=folder,
        )
    if done.returncode not in {0, 1, 4}:
        raise SystemExit(done.stderr.decode())
