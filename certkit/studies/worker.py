"""The other side of a pool: what happens inside a worker process. Imports little: every worker does."""

from __future__ import annotations

import os
import signal
import threading
import time
import warnings
from multiprocessing import parent_process
from multiprocessing.connection import wait
from typing import TYPE_CHECKING

from certkit.errors import OldFormWarning
from certkit.studies.points import Evaluate, Outcome, Point, attempt

if TYPE_CHECKING:
    from collections.abc import Sequence

Task = tuple[int, Point]
Done = tuple[int, Outcome]

_evaluations: list[Evaluate] = []


def arrive(evaluate: Evaluate) -> None:
    """Make a worker ready: it leaves Ctrl-C to its parent, and ends when the parent is gone."""
    _evaluations[:] = [evaluate]
    warnings.simplefilter("ignore", OldFormWarning)  # the parent has said it once
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_follow_parent, daemon=True).start()


def _follow_parent() -> None:
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


def work(chunk: Sequence[Task]) -> tuple[list[Done], float]:
    """Do a chunk of runs with the evaluation this worker was given on arrival; say how long it took."""
    return work_with(_evaluations[0], chunk)


def work_with(evaluate: Evaluate, chunk: Sequence[Task]) -> tuple[list[Done], float]:
    """Do a chunk of runs, and say how many seconds it took."""
    start = time.perf_counter()
    done = [(index, attempt(evaluate, point)) for index, point in chunk]
    return done, time.perf_counter() - start
