"""The overview of one legform, put together from its logbook."""

from __future__ import annotations

from collections import Counter
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

from certkit.definitions.loading.validation import validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.definitions.logbook_rules import LogbookRules
from certkit.documents.logbook_overview import LegOverview, TestLine
from certkit.errors import UsageError
from certkit.logbooks.past_curves import MOST_TESTS, past_curves
from certkit.logbooks.trend import trends
from certkit.logbooks.validity import validity

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import date

    from certkit.documents.logbook_overview import PastCurves
    from certkit.logbooks.logbook_entry import LogbookEntry
    from certkit.logbooks.logbook_store import Logbook

_STATES = ("never certified", "revoked", "due", "valid")


DEFAULT = "r127"
"""Name of the rules that hold where none are named."""


@cache
def shipped_rules(name: str = DEFAULT) -> LogbookRules:
    """Read rules that certkit ships.

    Raises
    ------
    UsageError
        When none have this name.
    """
    names = shipped_names()
    if name not in names:
        raise UsageError(f"`{name}` are no rules of a logbook: neither a file nor one of {', '.join(names)}")
    source = files("certkit.logbooks") / f"{name}.yaml"
    return validate(read_tree(source.read_bytes(), source.name), LogbookRules)


def shipped_names() -> list[str]:
    """Return the names of all rules that certkit ships."""
    folder = files("certkit.logbooks")
    return sorted(
        entry.name.removesuffix(".yaml") for entry in folder.iterdir() if entry.name.endswith(".yaml")
    )


def overview(
    logbook: Logbook,
    serial: str,
    *,
    rules: LogbookRules | None = None,
    day: date | None = None,
    curves: bool = False,
) -> LegOverview:
    """Draw up the overview of a legform.

    Parameters
    ----------
    logbook : Logbook
        Where its tests are.
    serial : str
        Its serial number.
    rules : LogbookRules, optional
        The shipped ones when missing.
    day : date, optional
        The day that validity is asked for; the day of the last test when missing.
    curves : bool
        Read the last curves of each channel as well, from the documents.

    Raises
    ------
    UsageError
        When the logbook does not know the serial number.
    """
    rules = rules or shipped_rules()
    exact = rules.serial_numbers == "exact"
    entries = logbook.entries(serial, exact=exact)
    if not entries:
        known = ", ".join(logbook.serials(exact=exact)) or "none yet"
        raise UsageError(f"the logbook knows no legform `{serial}`; it has {known}")
    asked = day or entries[-1].day
    # Tests after the day that is asked for had not been done then.
    entries = [entry for entry in entries if entry.day <= asked]
    replaced = logbook.replaced()
    booked, entries = entries, [entry for entry in entries if entry.id not in replaced]
    lines = [validity(rule, entries, asked) for rule in rules.rules]
    certifying = list(dict.fromkeys(name for rule in rules.rules for name in rule.certified_by))
    states = {line.state for line in lines}
    return LegOverview(
        serial=serial,
        day=asked.isoformat(),
        rules=rules.title,
        certified_by=certifying,
        serial_numbers=rules.serial_numbers,
        state=next(state for state in _STATES if state in states),
        tests=[
            TestLine(
                day=entry.day.isoformat(),
                number=entry.number,
                procedure=entry.procedure,
                verdict=entry.verdict,
                id=entry.id,
                replaced_by=replaced.get(entry.id),
            )
            for entry in booked
        ],
        counts=dict(sorted(Counter(entry.procedure for entry in entries).items())),
        validity=lines,
        trends=trends([e for e in entries if e.procedure in certifying], rules.trend),
        curves=_curves(logbook, entries, certifying) if curves else [],
    ).with_id()


def _curves(logbook: Logbook, entries: list[LogbookEntry], procedures: Sequence[str]) -> list[PastCurves]:
    """Return the last curves of the tests that certify."""
    last = [
        entry.id
        for name in procedures
        for entry in [each for each in entries if each.procedure == name][-MOST_TESTS:]
    ]
    return past_curves(logbook.results(last))
