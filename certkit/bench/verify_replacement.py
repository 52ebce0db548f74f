"""Check of a report against others that are handed beside it: whether one of them took its place."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.verification import Check, fails
from certkit.errors import DataError
from certkit.logbooks.logbook_entry import entry_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from certkit.documents.result import Result


def replacement_checks(result: Result, others: Iterable[Result]) -> Iterator[Check]:
    """Say which of the others replaces a report, when, and why.

    A report that none of them replaces says nothing: it cannot be known that there is no other.
    """
    try:
        old = entry_of(result, result.id)
    except DataError:
        return
    for other in others:
        try:
            new = entry_of(other, other.id)
        except DataError:
            continue
        if new.takes_the_place_of(old):
            test = (other.laboratory or {}).get("test") or {}
            yield fails(
                f"in force: {old.number or old.id}",
                "replaced-by",
                number=new.number or new.id,
                revision=new.revision,
                id=new.id,
                issued=test.get("issued", "an unknown day"),
                reason=test.get("reason", "not stated"),
                changes=test.get("changes", "not stated"),
            )
