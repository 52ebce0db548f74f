"""Where runs are done: in this process, or in processes of this machine; see also `dask_cluster`.

The numbers are the same everywhere.
Each pool hands back finished runs as they come and keeps a bounded number of them in flight, so that a
million points need no more memory than a hundred.
"""

from __future__ import annotations

import os
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from itertools import islice
from multiprocessing import get_all_start_methods, get_context
from typing import TYPE_CHECKING, Any, Protocol

from certkit.errors import RunError
from certkit.studies import worker
from certkit.studies.points import Evaluate, Outcome, attempt

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from multiprocessing.context import BaseContext

    from certkit.studies.worker import Done, Task

CHUNK_SECONDS = 0.05
"""Chunks grow until they last this long: it hides their transport, and little is lost when killed."""

MAX_CHUNK = 64
IN_FLIGHT = 2  # chunks a worker: one at work, one waiting
NO_START = (
    "worker processes cannot be started here; in a script, put the call under `if __name__ == '__main__':`, "
    "or use one process"
)
DIED = "the process that ran it died; out of memory?"


class Pool(Protocol):
    """A place where runs are done; it stays warm between batches."""

    def run(self, tasks: Iterable[Task]) -> Iterator[Done]:
        """Yield every task's index and outcome, in the order in which they finish."""
        ...

    def close(self, *, at_once: bool = False) -> None:
        """Send the workers home; `at_once` drops what they are at."""
        ...


class OneProcess:
    """No workers: one run after the other in this very process."""

    def __init__(self, evaluate: Evaluate) -> None:
        """Keep what one run is."""
        self._evaluate = evaluate

    def run(self, tasks: Iterable[Task]) -> Iterator[Done]:
        """Yield outcomes in the order of the tasks."""
        for index, point in tasks:
            yield index, attempt(self._evaluate, point)

    def close(self, *, at_once: bool = False) -> None:
        """Do nothing: there is nobody to send home."""


class Processes:
    """Workers on this machine, started once.

    A run that kills its worker costs only its own row: the pool is started again, and what was in flight is
    done one by one, so that the culprit is found.
    """

    def __init__(self, evaluate: Evaluate, count: int) -> None:
        """Keep what one run is; the workers start with the first batch."""
        self._evaluate = evaluate
        self._count = count
        self._pool: ProcessPoolExecutor | None = None

    def run(self, tasks: Iterable[Task]) -> Iterator[Done]:
        """Yield outcomes as they come."""
        source = Chunks(tasks)
        flying: dict[Future[tuple[list[Done], float]], list[Task]] = {}
        while True:
            pool = self._pool = self._pool or self._start(self._count)
            suspects: list[Task] = []
            for chunk in islice(source, IN_FLIGHT * self._count - len(flying)):
                try:
                    flying[pool.submit(worker.work, chunk)] = chunk
                except BrokenProcessPool:
                    suspects += chunk
            if not flying and not suspects:
                return
            for future in wait(flying, return_when=FIRST_COMPLETED).done if flying else ():
                chunk = flying.pop(future)
                try:
                    done, seconds = future.result()
                except BrokenProcessPool:
                    suspects += chunk
                else:
                    source.learn(len(chunk), seconds)
                    yield from done
            if suspects:
                suspects += [task for chunk in flying.values() for task in chunk]
                flying.clear()
                self.close()
                yield from self._one_by_one(suspects)

    def close(self, *, at_once: bool = False) -> None:
        """Drop what is still waiting and end the workers, after the runs that they are at or before."""
        if self._pool:
            if at_once:
                # The executor's own `terminate_workers` comes with Python 3.14.
                for process in list((getattr(self._pool, "_processes", None) or {}).values()):
                    process.terminate()
            self._pool.shutdown(wait=True, cancel_futures=True)
        self._pool = None

    def _start(self, count: int) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(
            count,
            mp_context=_context(type(self._evaluate).__module__),
            initializer=worker.arrive,
            initargs=(self._evaluate,),
        )

    def _one_by_one(self, suspects: list[Task]) -> Iterator[Done]:
        for task in sorted(suspects, key=lambda task: task[0]):
            with self._start(1) as pool:
                try:
                    pool.submit(worker.work, []).result()
                except BrokenProcessPool:
                    raise RunError(NO_START) from None
                try:
                    done, _ = pool.submit(worker.work, [task]).result()
                except BrokenProcessPool:
                    done = [(task[0], Outcome({}, DIED))]
            yield from done


def _context(module: str) -> BaseContext:
    """Return how workers are started.

    A server that has imported everything and started nothing forks the workers: as quick as a fork of this
    process, and safe beside the threads it may have. Where nothing can be forked, as on Windows, every worker
    imports for itself.
    """
    if "forkserver" not in get_all_start_methods():
        return get_context("spawn")
    context = get_context("forkserver")
    context.set_forkserver_preload(["certkit.studies.worker", module])
    return context


class Chunks:
    """Cuts tasks into chunks that last about `CHUNK_SECONDS`, by what earlier chunks took."""

    def __init__(self, tasks: Iterable[Task]) -> None:
        """Start with single runs."""
        self._tasks = iter(tasks)
        self._size = 1

    def __iter__(self) -> Iterator[list[Task]]:
        """Go on where the last iteration stopped."""
        while chunk := list(islice(self._tasks, self._size)):
            yield chunk

    def learn(self, runs: int, seconds: float) -> None:
        """Take note of how long a chunk of `runs` took."""
        wanted = CHUNK_SECONDS * runs / max(seconds, 1e-6)
        self._size = max(1, min(MAX_CHUNK, 2 * self._size, int(wanted)))


def available_processes() -> int:
    """Return the number of cores this process may use."""
    affinity: Any = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1
