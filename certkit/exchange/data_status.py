"""Data status: what a file says of its own samples, `ok` or anything else."""

from __future__ import annotations

from certkit.reasons import Reason

_GOOD = frozenset({"ok", "okay", "good", "valid", "linearised data", "linearized data"})
_DOUBTFUL = frozenset({"questionable data", "questionable"})


def judged(status: str, place: str, channel: str) -> tuple[Reason | None, tuple[Reason, ...]]:
    """Understand a status: `ok` is good, `questionable data` is told, anything else is not used.

    Parameters
    ----------
    status : str
        As the file has it; empty where it says nothing, which says nothing against its samples.
    place : str
        Where it stands.
    channel : str
        Whose samples are meant; empty for the whole test.

    Returns
    -------
    (Reason or None, tuple of Reason)
        Why the samples are not used, and what has to be told when they are.
    """
    word = " ".join(status.casefold().split())
    if not word or word in _GOOD:
        return None, ()
    if word in _DOUBTFUL:
        return None, (Reason.of("questionable-data", place=place),)
    return Reason.of("status-not-good", channel=channel, place=place, status=status[:60]), ()
