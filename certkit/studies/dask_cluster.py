"""Runs on a Dask cluster: whoever reaches its scheduler runs code on it, so it belongs behind TLS.

A worker that dies loses nothing: Dask does its runs again elsewhere. A cluster that cannot be reached any
more, or has no worker left, ends the study with one line; its finished runs are in the journal.
"""

from __future__ import annotations

import contextlib
import logging
import time
from concurrent.futures import CancelledError
from importlib import import_module
from itertools import chain, islice
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from certkit._version import __version__
from certkit.errors import RunError, UsageError
from certkit.studies import worker
from certkit.studies.points import Outcome
from certkit.studies.pools import DIED, IN_FLIGHT, Chunks

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from certkit.studies.points import Evaluate
    from certkit.studies.worker import Done, Task

ANSWER_SECONDS = 10.0
"""After which a scheduler counts as not there."""

WORKER_SECONDS = 60.0
"""For which a cluster may be without a worker."""

LOOK_SECONDS = 2.0
"""Between two looks at the cluster while nothing ends."""

MOST_RETRIES = 5
"""How often a chunk is sent again that was lost with the workers that held the evaluation."""


class ClusterAddress(Struct, frozen=True):
    """Where a scheduler listens, and what proves to it who we are.

    Parameters
    ----------
    scheduler : str
        Such as `tcp://host:8786`, or `tls://host:8786`.
    ca_file, cert, key : Path, optional
        PEM files: the authority that both sides trust, our certificate, its key. All three or none.
    """

    scheduler: str
    ca_file: Path | None = None
    cert: Path | None = None
    key: Path | None = None

    def check(self) -> None:
        """Refuse an address whose parts do not fit together.

        Raises
        ------
        UsageError
            When they do not, or a file is missing.
        """
        files = (self.ca_file, self.cert, self.key)
        if not any(files):
            return
        if not all(files):
            raise UsageError("TLS needs all three: --tls-ca-file, --tls-cert and --tls-key")
        if not self.scheduler.startswith("tls://"):
            raise UsageError(f"`{self.scheduler}` is not reached by TLS; write tls://HOST:PORT")
        for file in files:
            if file is not None and not file.is_file():
                raise UsageError(f"{file}: no such file; name a PEM file")


class DaskCluster:
    """The Dask cluster whose scheduler listens at an address.

    Raises
    ------
    UsageError
        When dask.distributed is not installed, nobody answers at the address, or no worker comes.
    """

    def __init__(self, evaluate: Evaluate, address: ClusterAddress) -> None:
        """Connect, and hand the evaluation to every worker."""
        address.check()
        try:
            self._dask: Any = import_module("distributed")  # an extra, and 0.5 s
        except ImportError:
            raise UsageError("`--cluster` needs Dask: pip install 'certkit[cluster]'") from None
        _silence()
        self._where = address.scheduler
        self._mine = evaluate
        try:
            self._client: Any = self._dask.Client(
                address.scheduler,
                timeout=f"{ANSWER_SECONDS:g}s",
                set_as_default=False,
                security=self._security(address),
            )
        except (OSError, TimeoutError, TypeError, ValueError, RuntimeError) as error:
            raise UsageError(
                f"no Dask scheduler answers at `{self._where}`: {_line(error)}"
                "; start it, or correct the address"
            ) from None
        try:
            self._client.wait_for_workers(1, timeout=WORKER_SECONDS)
            self._evaluate = self._handed_out()
        except (TimeoutError, CancelledError, self._dask.comm.CommClosedError):
            self.close()
            raise UsageError(
                f"the Dask cluster at `{self._where}` has no worker; start one: dask worker {self._where}"
            ) from None

    def _security(self, address: ClusterAddress) -> Any:  # noqa: ANN401  # Dask is untyped
        if address.ca_file is None:
            return None  # what Dask's own configuration says
        try:
            return self._dask.security.Security(
                tls_ca_file=str(address.ca_file),
                tls_client_cert=str(address.cert),
                tls_client_key=str(address.key),
                require_encryption=True,
            )
        except ImportError as error:
            raise UsageError(f"TLS with Dask: {error}") from None

    def _handed_out(self) -> Any:  # noqa: ANN401  # likewise
        return self._client.scatter(self._mine, broadcast=True, timeout=WORKER_SECONDS)

    def run(self, tasks: Iterable[Task]) -> Iterator[Done]:
        """Yield outcomes as they come.

        Raises
        ------
        RunError
            When the cluster is lost.
        """
        closed = (self._dask.client.ClosedClientError, self._dask.comm.CommClosedError)
        try:
            yield from self._run(tasks)
        except (CancelledError, OSError, TimeoutError, *closed):
            raise RunError(
                f"the Dask cluster at `{self._where}` is gone; runs that are done are kept, the same command "
                "goes on from there"
            ) from None

    def _run(self, tasks: Iterable[Task]) -> Iterator[Done]:
        source = Chunks(tasks)
        flying: dict[Any, list[Task]] = {}
        lost: list[list[Task]] = []
        retries = 0
        while True:
            threads = sum(self._client.nthreads().values())
            again, lost = lost, []
            for chunk in islice(chain(again, source), max(1, len(again), IN_FLIGHT * threads - len(flying))):
                flying[self._client.submit(worker.work_with, self._evaluate, chunk, pure=False)] = chunk
            if not flying:
                return
            for future in self._ended(list(flying)):
                chunk = flying.pop(future)
                try:
                    done, seconds = self._result(future, chunk)
                except CancelledError:
                    lost.append(chunk)
                    continue
                if seconds:
                    source.learn(len(chunk), seconds)
                yield from done
            if lost:
                # The workers that held the evaluation are gone: others get it, if the scheduler lives.
                retries += 1
                if retries > MOST_RETRIES:
                    raise CancelledError
                self._client.wait_for_workers(1, timeout=WORKER_SECONDS)
                self._evaluate = self._handed_out()

    def _result(self, future: Any, chunk: list[Task]) -> tuple[list[Done], float]:  # noqa: ANN401  # likewise
        """Return what came of a chunk, and how long it took; 0 when its workers died of it.

        Raises
        ------
        CancelledError
            When it was lost with the workers that held the evaluation.
        """
        try:
            done: tuple[list[Done], float] = future.result()
        except self._dask.KilledWorker:
            return [(index, Outcome({}, DIED)) for index, _ in chunk], 0.0
        except (ImportError, AttributeError) as error:
            raise RunError(
                f"a worker of `{self._where}` cannot do the runs ({_line(error)}); install certkit "
                f"{__version__} there, with the same packages"
            ) from None
        return done

    def _ended(self, flying: list[Any]) -> list[Any]:
        """Wait until some have ended.

        Raises
        ------
        RunError
            When there is no worker for `WORKER_SECONDS`.
        """
        last_seen = time.monotonic()
        while True:
            # A cancelled future is an error to `wait`; here it is one of those that have ended.
            with contextlib.suppress(TimeoutError, CancelledError), self._client.as_current():
                self._dask.wait(flying, timeout=LOOK_SECONDS, return_when="FIRST_COMPLETED")
            if done := [future for future in flying if future.status != "pending"]:
                return done
            now = time.monotonic()
            if self._client.nthreads():
                last_seen = now
            elif now - last_seen > WORKER_SECONDS:
                raise RunError(
                    f"the Dask cluster at `{self._where}` has had no worker for {WORKER_SECONDS:g} s; runs "
                    "that are done are kept, the same command goes on from there"
                )

    def close(self, *, at_once: bool = False) -> None:
        """Leave the cluster; it is not ours to end, and drops by itself what nobody waits for any more."""
        del at_once
        with contextlib.suppress(Exception):  # whatever state a lost cluster is in, we are leaving it
            self._client.close(timeout=2)


def _silence() -> None:
    """Keep Dask's own log quiet: what matters is said in one line."""
    for name in [*logging.root.manager.loggerDict]:
        if name.split(".")[0] == "distributed":
            logging.getLogger(name).setLevel(logging.CRITICAL)


def _line(error: BaseException) -> str:
    return (str(error).splitlines() or [type(error).__name__])[0]
