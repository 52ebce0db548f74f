"""What a legform's certification is still good for, rule by rule."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from certkit.definitions.logbook_rules import Count, Interval, TestSequence
from certkit.documents.logbook_overview import Validity
from certkit.errors import DataError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import date

    from certkit.definitions.logbook_rules import Overload, Rule
    from certkit.logbooks.logbook_entry import LogbookEntry

_DAY = 86400.0
PASSED = "pass"
REVOKING = frozenset({"fail", "conditional", "error"})
"""Verdicts of a later test that take the certification back; `not evaluated` says nothing about the leg."""


def validity(rule: Rule, entries: Sequence[LogbookEntry], day: date) -> Validity:
    """Apply a rule.

    Parameters
    ----------
    rule : Interval, Count, TestSequence or Overload
        The rule.
    entries : sequence of LogbookEntry
        One legform's tests, in order.
    day : date
        The day that validity is asked for.
    """
    if isinstance(rule, Interval):
        return _interval(rule, entries, day)
    if isinstance(rule, Count):
        return _count(rule, entries)
    return _sequence(rule, entries) if isinstance(rule, TestSequence) else _overload(rule, entries)


def _last_passes(names: Sequence[str], entries: Sequence[LogbookEntry]) -> dict[str, int]:
    """Return the place of the last passed test of each procedure; those never passed are missing."""
    found = {}
    for place, entry in enumerate(entries):
        if entry.procedure in names and entry.verdict == PASSED:
            found[entry.procedure] = place
    return found


def _counted(rule: Count | TestSequence, used: int, last: LogbookEntry) -> Reason:
    """Say how many of the tests that are allowed were used, and since when."""
    return Reason.of(
        "validity-counted",
        used=used,
        most=rule.at_most,
        counted=list(rule.counts),
        procedure=last.procedure,
        day=last.day.isoformat(),
    )


def _said(rule: Rule, *, why: Reason, **values: Any) -> Validity:  # noqa: ANN401  # the document's fields
    """Make the line of a rule, with the rule's origin."""
    if rule.source is None or rule.confidence is None:
        raise DataError(f"rule `{rule.title}` has no source; give it one")
    return Validity(
        rule=rule.rule,
        title=rule.title,
        source=rule.source,
        confidence=rule.confidence,
        coded_why=why,
        **values,
    )


def _not_certified(rule: Rule, passes: dict[str, int], entries: Sequence[LogbookEntry]) -> Validity | None:
    """Say that a procedure was never passed, or that a later test took the pass back; None otherwise."""
    missing = [name for name in rule.certified_by if name not in passes]
    if missing:
        return _said(
            rule, state="never certified", why=Reason.of("validity-never-passed", procedures=missing)
        )
    for name, place in passes.items():
        for entry in entries[place + 1 :]:
            if entry.procedure == name and entry.verdict in REVOKING:
                why = Reason.of(
                    "validity-ended-otherwise",
                    procedure=name,
                    passed=entries[place].day.isoformat(),
                    verdict=entry.verdict,
                    day=entry.day.isoformat(),
                )
                return _said(rule, state="revoked", why=why, due=entry.day.isoformat())
    return None


def _interval(rule: Interval, entries: Sequence[LogbookEntry], day: date) -> Validity:
    passes = _last_passes(rule.certified_by, entries)
    lacking = _not_certified(rule, passes, entries)
    if lacking is not None:
        return lacking
    oldest = min(rule.certified_by, key=lambda name: entries[passes[name]].day)
    last = entries[passes[oldest]].day
    due = last + timedelta(days=rule.seconds / _DAY)
    state = "valid" if day <= due else "due"
    why = Reason.of("validity-last-passed", procedure=oldest, day=last.isoformat(), every=str(rule.every))
    return _said(rule, state=state, why=why, due=due.isoformat())


def _count(rule: Count, entries: Sequence[LogbookEntry]) -> Validity:
    passes = _last_passes(rule.certified_by, entries)
    lacking = _not_certified(rule, passes, entries)
    if lacking is not None:
        return lacking
    first = min(passes.values())
    used = sum(entry.procedure in rule.counts for entry in entries[first + 1 :])
    left = max(0, rule.at_most - used)
    last = entries[first]
    why = _counted(rule, used, last)
    return _said(rule, state="valid" if left else "due", why=why, left=left, used=used)


class _Turn(Struct):
    """Where a sequence of certification tests stands.

    Parameters
    ----------
    place : int
        Tests passed in turn since the series began.
    used : int
        Counted tests since the last of them, which is `last`.
    failed : LogbookEntry, optional
        The certification test that did not pass since then.
    broken : Reason, optional
        Why the series has to start again.
    """

    place: int = 0
    used: int = 0
    last: LogbookEntry | None = None
    failed: LogbookEntry | None = None
    broken: Reason | None = None

    def count(self, rule: TestSequence, entry: LogbookEntry) -> None:
        """Count a test; one too many ends the series."""
        self.used += 1
        if self.place and self.used > rule.at_most:
            self.broken = Reason.of(
                "validity-series-broken",
                used=self.used,
                counted=list(rule.counts),
                day=entry.day.isoformat(),
                first=rule.certified_by[0],
            )
            self.place = 0

    def certify(self, rule: TestSequence, entry: LogbookEntry) -> None:
        """Take a certification test: the next in turn, or the first, which always opens a series."""
        turn = rule.certified_by
        if entry.verdict != PASSED:
            self.failed = entry
            return
        next_one = entry.procedure == turn[self.place % len(turn)]
        if next_one or entry.procedure == turn[0]:
            self.place = self.place + 1 if next_one else 1
            self.used, self.last, self.failed, self.broken = 0, entry, None, None


def _sequence(rule: TestSequence, entries: Sequence[LogbookEntry]) -> Validity:
    now = _Turn()
    for entry in entries:
        if entry.procedure in rule.counts:
            now.count(rule, entry)
        elif entry.procedure in rule.certified_by:
            now.certify(rule, entry)
    first, last = rule.certified_by[0], now.last
    if last is None:
        return _said(
            rule, state="never certified", why=Reason.of("validity-never-passed", procedures=[first])
        )
    if now.failed is not None:
        why = Reason.of(
            "validity-ended-after",
            procedure=now.failed.procedure,
            verdict=now.failed.verdict,
            day=now.failed.day.isoformat(),
            last=last.day.isoformat(),
        )
        return _said(rule, state="revoked", why=why, due=now.failed.day.isoformat())
    if now.broken:
        return _said(rule, state="due", why=now.broken, used=now.used)
    left = max(0, rule.at_most - now.used)
    following = rule.certified_by[now.place % len(rule.certified_by)]
    why = Reason.of("validity-counted-in-turn", counted=_counted(rule, now.used, last), following=following)
    return _said(rule, state="valid" if left else "due", why=why, left=left, used=now.used)


def _overload(rule: Overload, entries: Sequence[LogbookEntry]) -> Validity:
    passes = _last_passes(rule.certified_by, entries)
    lacking = _not_certified(rule, passes, entries)
    if lacking is not None:
        return lacking
    for entry in entries[min(passes.values()) + 1 :]:
        if entry.procedure not in rule.counts:
            continue
        for reading in entry.readings:
            bound = rule.bound(reading.upper, reading.unit)
            if reading.value is None or bound is None or reading.value <= bound:
                continue
            upper = bound if rule.beyond is None or reading.upper is None else reading.upper
            why = Reason.of(
                "validity-overload",
                criterion=reading.criterion,
                value=reading.value,
                unit=reading.unit,
                day=entry.day.isoformat(),
                procedure=entry.procedure,
                over=reading.value / upper - 1,
                limit=upper,
            )
            return _said(rule, state="due", why=why, due=entry.day.isoformat())
    kept = (
        Reason.of("validity-no-overload", beyond=str(rule.beyond))
        if rule.beyond
        else Reason.of("validity-no-reading-over-class")
    )
    return _said(rule, state="valid", why=kept)
