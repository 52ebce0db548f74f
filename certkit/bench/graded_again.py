"""Results that are taken over into something else: each has to come to its values when it is graded again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.verify_grading import grading_checks

if TYPE_CHECKING:
    from certkit.documents.result import Result


def wrong_values(place: str, result: Result) -> list[str]:
    """Grade a result again where it carries its channels; say whether it comes to other values.

    An id is no proof: whoever changes a value can make it anew.
    """
    if result.channels is None:
        return []
    if all(check.outcome != "does not hold" for check in grading_checks(result)):
        return []
    return [f"{place}: comes to other values when it is graded again; `certkit verify` tells more"]
