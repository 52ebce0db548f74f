"""A self-check of an extraction whose run may not come to its end."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.self_check import SelfCheck
from certkit.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Callable

TITLES = {
    "front alone": "The front alone, driven by the run's contact forces",
    "leg alone": "The leg alone, driven by the run's contact forces",
    "contact alone": "The contact alone, leg and front led along the run's motion",
    "coupled": "Leg and front together",
}


def tried(key: str, axis: tuple[float, float], until: float, check: Callable[[], SelfCheck]) -> SelfCheck:
    """Return a check, or that its run did not come to its end and why.

    Parameters
    ----------
    key : str
        Of `TITLES`.
    axis : tuple of float
        Start and interval of its series, s.
    until : float
        Its end, s.
    check : callable
        Makes it.
    """
    try:
        return check()
    except RunError as error:
        return SelfCheck(
            id=key,
            title=TITLES[key],
            start=axis[0],
            interval=axis[1],
            until=until,
            within=False,
            failed=str(error),
        )
