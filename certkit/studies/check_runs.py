"""How many runs are too many: refused before a single point is made."""

from __future__ import annotations

from certkit.errors import UsageError
from certkit.files.limits import MAX_RUNS, MAX_SETTINGS


def check_runs(runs: int, factors: int, wanted: str) -> None:
    """Refuse too many runs, before a single point is made.

    Parameters
    ----------
    runs, factors : int
    wanted : str
        What asks for them.

    Raises
    ------
    UsageError
        Above `MAX_RUNS`, or `MAX_SETTINGS` for all runs together.
    """
    most = min(MAX_RUNS, MAX_SETTINGS // max(1, factors))
    if runs > most:
        raise UsageError(
            f"a {wanted} of {factors} parameters has {runs:,} runs; more than {most:,} are refused: take a "
            "smaller one, or split it (the bounds are MAX_RUNS and MAX_SETTINGS in certkit/files/limits.py)"
        )
