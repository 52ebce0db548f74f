"""Commands that are killed at random moments, and what is wrong afterwards."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)


def command(*words: str, folder: Path) -> subprocess.Popen[bytes]:
    """Start certkit in a folder."""
    # In the background of a shell it is ignored, which a child would inherit.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    return subprocess.Popen(
        [sys.executable, "-m", "certkit", *words],
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "NO_COLOR": "1"},
    )


def killed(words: Sequence[str], folder: Path, after: float, by: signal.Signals) -> None:
    """Start a command and send it a signal after some seconds, if it still runs."""
    child = command(*words, folder=folder)
    try:
        child.wait(timeout=after)
    except subprocess.TimeoutExpired:
        child.send_signal(by)
        child.wait(timeout=60)


def seconds_of(words: Sequence[str], folder: Path) -> float:
    """Return how long a command takes when it is left alone."""
    begun = time.monotonic()
    assert command(*words, folder=folder).wait(timeout=300) in {0, 1, 4}
    return time.monotonic() - begun


def is_whole(folder: Path, files: set[str]) -> bool:
    """Tell whether a result folder holds one result: all files, and one id in all that can be read."""
    there = {path.name for path in folder.iterdir() if not path.name.startswith(".")}
    if there != files:
        return False
    said = json.loads((folder / "result.json").read_bytes())["id"]
    return all(said in (folder / name).read_text("utf-8") for name in files - {"result.json"})


def kill_runs(folder: Path, count: int, seed: int) -> list[str]:
    """Kill `run` while it replaces one result by another, again and again; return what was wrong."""
    chance = random.Random(seed)  # noqa: S311  # moments, no secrets
    run = ["run", "static-tibia", "--format", "html,junit", "--out", "out", "--force"]
    changed = [*run, "--set", "run.time step=10 µs"]
    files = {"result.json", "report.html", "junit.xml"}
    whole = max(seconds_of(words, folder) for words in (changed, run))
    wrong = []
    for number in range(count):
        after, by = chance.uniform(0.3, 1.1) * whole, chance.choice(SIGNALS)
        killed((run, changed)[number % 2], folder, after, by)
        if not is_whole(folder / "out", files):
            wrong.append(f"kill {number} by {by.name} after {after:.2f} s: the folder is not whole")
    seconds_of(run, folder)
    if not is_whole(folder / "out", files) or {path.name for path in folder.iterdir()} != {"out"}:
        wrong.append(f"left behind: {sorted(path.name for path in folder.rglob('*'))}")
    return wrong
