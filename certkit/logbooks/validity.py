"""What a legform's certification is still good for, rule by rule."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING, Any

from certkit.definitions.logbook_rules import Count, Interval, TestSequence
from certkit.documents.logbook_overview import Validity
from certkit.errors import DataError

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
    entries : sequence of Entry
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


def _said(rule: Rule, **values: Any) -> Validity:  # noqa: ANN401  # the document's fields
    """Make the line of a rule, with the rule's origin."""
    if rule.source is None or rule.confidence is None:
        raise DataError(f"rule `{rule.title}` has no source")
    return Validity(
        rule=rule.rule, title=rule.title, source=rule.source, confidence=rule.confidence, **values
    )


def _not_certified(rule: Rule, passes: dict[str, int], entries: Sequence[LogbookEntry]) -> Validity | None:
    """Say that a procedure was never passed, or that a later test took the pass back; None otherwise."""
    missing = [name for name in rule.certified_by if name not in passes]
    if missing:
        return _said(rule, state="never certified", why=f"{' and '.join(missing)} never passed")
    for name, place in passes.items():
        for entry in entries[place + 1 :]:
            if entry.procedure == name and entry.verdict in REVOKING:
                why = f"{name} passed on {entries[place].day}, but ended in `{entry.verdict}` on {entry.day}"
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
    why = f"{oldest} last passed on {last}; good for {rule.every}"
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
    counted = f"{used} of {rule.at_most} {' and '.join(rule.counts)} tests"
    why = f"{counted} since {last.procedure} passed on {last.day}"
    return _said(rule, state="valid" if left else "due", why=why, left=left, used=used)


def _sequence(rule: TestSequence, entries: Sequence[LogbookEntry]) -> Validity:
    """Follow the turn: where it stands, and how many tests have gone by since its last test."""
    turn, counted = rule.certified_by, " and ".join(rule.counts)
    place = used = 0
    last: LogbookEntry | None = None
    failed: LogbookEntry | None = None
    broken = ""
    for entry in entries:
        if entry.procedure in rule.counts:
            used += 1
            if place and used > rule.at_most:
                broken = f"{used} {counted} tests without a certification by {entry.day}"
                place = 0
        elif entry.procedure in turn:
            if entry.verdict != PASSED:
                failed = entry
            elif entry.procedure == turn[place % len(turn)]:
                place, used, last, failed, broken = place + 1, 0, entry, None, ""
            elif entry.procedure == turn[0]:  # a new series is always opened by it
                place, used, last, failed, broken = 1, 0, entry, None, ""
    if failed is not None and last is not None:
        why = f"{failed.procedure} ended in `{failed.verdict}` on {failed.day}, after {last.day}"
        return _said(rule, state="revoked", why=why, due=failed.day.isoformat())
    if broken:
        return _said(rule, state="due", why=f"{broken}; the series starts again with {turn[0]}", used=used)
    if last is None:
        return _said(rule, state="never certified", why=f"{turn[0]} never passed")
    left = max(0, rule.at_most - used)
    why = (
        f"{used} of {rule.at_most} {counted} tests since {last.procedure} passed on {last.day}; "
        f"{turn[place % len(turn)]} is next"
    )
    return _said(rule, state="valid" if left else "due", why=why, left=left, used=used)


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
            why = (
                f"{reading.criterion} read {reading.value:.4g} {reading.unit} on {entry.day} "
                f"({entry.procedure}), {reading.value / upper - 1:.0%} over {upper:.4g} {reading.unit}"
            )
            return _said(rule, state="due", why=why, due=entry.day.isoformat())
    which = (
        f"no reading more than {rule.beyond} over its limit" if rule.beyond else "no reading over its class"
    )
    return _said(rule, state="valid", why=f"{which} since then")
