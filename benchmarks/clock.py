"""Clocks and the rows of the table."""

from __future__ import annotations

import gc
import resource
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


@dataclass(frozen=True)
class Row:
    """One figure, and what is promised of it where something is."""

    name: str
    value: float
    unit: str = ""
    promise: float | None = None
    better: Literal["least", "most"] = "most"

    @property
    def kept(self) -> bool | None:
        """Whether the promise is kept; None where there is none. `most`: the figure may be this at most."""
        if self.promise is None:
            return None
        return self.value <= self.promise if self.better == "most" else self.value >= self.promise

    @property
    def line(self) -> str:
        """Return the row as text."""
        words = ""
        if self.promise is not None:
            words = f"  at {self.better} {self.promise:g}: {'kept' if self.kept else 'MISSED'}"
        return f"{self.name:<62} {self.value:>10.3g} {self.unit:<8}{words}"


def processor_seconds(task: Callable[[], object], repeats: int = 5) -> float:
    """Return the least processor time of several calls: others on the machine can only add to it."""
    return seconds_in_turn(task, repeats=repeats)[0]


def seconds_in_turn(*tasks: Callable[[], object], repeats: int = 7) -> list[float]:
    """Return the least processor time of each task."""

    def spent(task: Callable[[], object]) -> float:
        gc.collect()  # nobody pays for what another has left lying about
        start = time.process_time()
        task()
        return time.process_time() - start

    return _in_turn(spent, tasks, repeats)


def child_seconds(*tasks: Callable[[], object], repeats: int = 7) -> list[float]:
    """Return the least processor time of the processes that each task starts."""

    def spent(task: Callable[[], object]) -> float:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        task()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime

    return _in_turn(spent, tasks, repeats)


def waited_seconds(*tasks: Callable[[], object], repeats: int = 7) -> list[float]:
    """Return the least wall time of each task."""
    return _in_turn(lambda task: wall_seconds(task, 1), tasks, repeats)


def _in_turn(
    spent: Callable[[Callable[[], object]], float], tasks: Sequence[Callable[[], object]], repeats: int
) -> list[float]:
    """Return the least that each task has spent; they take turns, so that all meet the machine's moods."""
    rounds = [[spent(task) for task in tasks] for _ in range(repeats)]
    return [min(times) for times in zip(*rounds, strict=True)]


def wall_seconds(task: Callable[[], object], repeats: int = 3) -> float:
    """Return the least wall time of several calls."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        task()
        times.append(time.perf_counter() - start)
    return min(times)


def reference_loop() -> float:
    """Return the seconds that this machine takes for ten million plain additions in Python."""

    def add() -> int:
        total = 0
        for i in range(10_000_000):
            total += i
        return total

    return processor_seconds(add, 3)


def exponent(sizes: list[float], seconds: list[float]) -> float:
    """Return the slope of time over size, both logarithmic."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])
