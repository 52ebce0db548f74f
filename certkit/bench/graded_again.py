"""Results that are taken over into something else: each has to come to its values when it is graded again."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from certkit.bench.verify_grading import grading_checks
from certkit.errors import TakenAsSaidWarning

if TYPE_CHECKING:
    from certkit.documents.result import Result


def wrong_values(place: str, result: Result) -> list[str]:
    """Grade a result again where it carries its channels; say whether it comes to other values, or cannot be.

    An id is no proof: whoever changes a value can make it anew.
    """
    other, ungradable = _graded(place, result)
    return other or ungradable


def wrong_values_today(place: str, result: Result) -> list[str]:
    """Say whether a result comes to other values; one that cannot be graded any more is taken as it says.

    Definitions of an earlier version may have words that this one does not know. A logbook is there to keep
    such tests, so it is a `TakenAsSaidWarning`.
    """
    other, ungradable = _graded(place, result)
    for words in () if other else ungradable:
        warnings.warn(f"{words}; it is booked as it says", TakenAsSaidWarning, stacklevel=2)
    return other


def _graded(place: str, result: Result) -> tuple[list[str], list[str]]:
    """Return what to say where the values are others, and where the result cannot be graded again."""
    if result.channels is None:
        return [], []
    faults = [check for check in grading_checks(result) if check.outcome == "does not hold"]
    ungradable = [
        f"{place}: cannot be graded again by this certkit ({check.parameters['error']})"
        for check in faults
        if check.code == "not-gradable"
    ]
    if len(faults) == len(ungradable):
        return [], ungradable
    return [f"{place}: comes to other values when it is graded again; `certkit verify` tells more"], []
