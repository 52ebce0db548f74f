"""`Runs`: an evaluation that remembers. Every study, search and fit asks it for batches of points.

Because finished runs are found again by their content hash, an interrupted search needs no state of its
own: started again, it walks the same way and meets its own earlier answers until it comes to where it was.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Self

from certkit.studies.dask_cluster import ClusterAddress, DaskCluster
from certkit.studies.execution import USUAL, Execution
from certkit.studies.journal import Journal
from certkit.studies.points import Evaluate, Outcome, Point, key_of
from certkit.studies.pools import DIED, OneProcess, Pool, Processes, available_processes

if TYPE_CHECKING:
    from collections.abc import Sequence


class Runs:
    """Batches of runs over one evaluation, each distinct point done once.

    Parameters
    ----------
    evaluate : callable
        One run; see `certkit.studies.points.Evaluate`.
    context : str
        What besides the point decides the outputs; part of every run's key.
    execution : Execution
        Where and how they are done.
    """

    def __init__(self, evaluate: Evaluate, execution: Execution = USUAL, *, context: str = "") -> None:
        """Open the journal; workers are started when there is something to do."""
        self.evaluate = evaluate
        self.context = context
        self.processes = execution.processes or available_processes()
        named = execution.cluster
        self.cluster = ClusterAddress(named) if isinstance(named, str) else named
        self.progress = execution.progress
        self.done_here = 0
        self._pool: Pool | None = None
        self._journal = Journal(execution.journal) if execution.journal else None
        self._known: dict[str, Outcome] = self._journal.known if self._journal else {}

    def __call__(self, points: Sequence[Point]) -> list[Outcome]:
        """Return the outcome of every point, in the order of the points."""
        keys = [key_of(self.context, point) for point in points]
        times = Counter(keys)
        missing = {k: p for k, p in zip(keys, points, strict=True) if k not in self._known}
        done = len(points) - sum(times[key] for key in missing)
        failed = sum(bool(self._known[key].error) for key in keys if key in self._known)
        lost: dict[str, Outcome] = {}
        names = list(missing)
        self._tell(done, len(points), failed)
        for index, outcome in self._pool_for(len(missing)).run(enumerate(missing.values())):
            key = names[index]
            self.done_here += 1
            if outcome.error == DIED:
                lost[key] = outcome  # perhaps not the run's own fault: tried again next time
            elif self._journal:
                self._journal.append(key, missing[key], outcome)
            else:
                self._known[key] = outcome
            done += times[key]
            failed += times[key] * bool(outcome.error)
            self._tell(done, len(points), failed)
        return [lost[key] if key in lost else self._known[key] for key in keys]

    @property
    def known(self) -> int:
        """Number of distinct runs that are known, here or from the journal."""
        return len(self._known)

    def _pool_for(self, tasks: int) -> Pool:
        if self._pool is None and tasks > 1:
            if self.cluster is not None:
                self._pool = DaskCluster(self.evaluate, self.cluster)
            elif self.processes > 1:
                self._pool = Processes(self.evaluate, self.processes)
        return self._pool or OneProcess(self.evaluate)

    def _tell(self, done: int, total: int, failed: int) -> None:
        if self.progress:
            self.progress(done, total, failed)

    def close(self, *, at_once: bool = False) -> None:
        """Send the workers home and close the journal; `at_once` drops what they are at."""
        try:
            if self._pool:
                self._pool.close(at_once=at_once)
        finally:
            if self._journal:
                self._journal.close()

    def __enter__(self) -> Self:
        """Use as a context."""
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Close, and wait for nobody when Ctrl-C was pressed."""
        self.close(at_once=kind is KeyboardInterrupt)
