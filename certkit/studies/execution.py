"""Where and how the runs of a study or a fit are done: processes or cluster, journal, progress."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.studies.dask_cluster import ClusterAddress

Progress = Callable[[int, int, int], None]
"""Called with how many runs of a batch are done, how many it has, and how many of them failed."""


class Execution(Struct, frozen=True):
    """Where and how runs are done; their numbers are the same everywhere.

    Parameters
    ----------
    processes : int, optional
        Workers on this machine; all cores when None, this very process when 1.
    cluster : str or ClusterAddress, optional
        A Dask scheduler, used instead.
    progress : callable, optional
        Told of every finished run.
    journal : Path, optional
        File in which finished runs outlive this process, so that an interrupted study goes on from there.
    """

    processes: int | None = None
    cluster: str | ClusterAddress | None = None
    progress: Progress | None = None
    journal: Path | None = None

    def kept_in(self, journal: Path) -> Execution:
        """Return the same with finished runs kept in a file."""
        return replace(self, journal=journal)


USUAL = Execution()
"""All cores of this machine, without a word and without a journal."""
