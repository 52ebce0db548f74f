"""What a legform's certification is still good for, rule by rule."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING, Any

from certkit.definitions.logbook_rules import Count, Interval
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
    rule : Interval, Count or Overload
        The rule.
    entries : sequence of Entry
        One legform's tests, in order.
    day : date
        The day that validity is asked for.
    """
    if isinstance(rule, Interval):
        return _interval(rule, entries, day)
    return _count(rule, entries) if isinstance(rule, Count) else _overload(rule, entries)


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


def _overload(rule: Overload, entries: Sequence[LogbookEntry]) -> Validity:
    passes = _last_passes(rule.certified_by, entries)
    lacking = _not_certified(rule, passes, entries)
    if lacking is not None:
        return lacking
    for entry in entries[min(passes.values()) + 1 :]:
        if entry.procedure not in rule.counts:
            continue
        for reading in entry.readings:
            if reading.value is None or reading.upper is None or reading.upper <= 0:
                continue
            over = reading.value / reading.upper - 1
            if over > rule.share:
                why = (
                    f"{reading.criterion} read {reading.value:.4g} {reading.unit} on {entry.day} "
                    f"({entry.procedure}), {over:.0%} over {reading.upper:.4g} {reading.unit}"
                )
                return _said(rule, state="due", why=why, due=entry.day.isoformat())
    return _said(rule, state="valid", why=f"no reading more than {rule.beyond} over its limit since then")
