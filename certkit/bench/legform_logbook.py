"""`logbook`: put graded tests into the logbook of the legforms, and draw up what is known of each."""

from __future__ import annotations

from datetime import UTC, date, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from certkit.bench.graded_again import wrong_values_today
from certkit.definitions.loading.validation import read_document
from certkit.definitions.logbook_rules import LogbookRules
from certkit.errors import UsageError
from certkit.logbooks import Logbook, add, overview, rebuild, shipped_rules
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.logbook_overview import LegOverview
    from certkit.logbooks.logbook_entry import LogbookEntry

FOLDER = "logbook"


def logbook(
    folder: str | Path = FOLDER,
    *,
    tests: str | Path | Sequence[str | Path] = (),
    serials: Sequence[str] = (),
    rules: str | Path | None = None,
    day: str | date | None = None,
    curves: bool = False,
) -> list[LegOverview]:
    """Put tests into a logbook, and return what is known of each legform: validity left and why, trends.

    Parameters
    ----------
    folder : str or Path
        Of the logbook; made with the first test.
    tests : str, Path, or sequence of them
        `result.json` of graded tests, or folders of their runs. Those that it has already are left alone.
    serials : sequence of str
        Legforms; all when none is named.
    rules : str or Path, optional
        File with own rules of validity, or the name of shipped ones (`r127`, `euro-ncap-v7`); those of UN
        R127 when missing.
    day : str or date, optional
        The day that validity is asked for: `2026-03-31` or `today`; the day of the last test when missing.
    curves : bool
        Read the last ten curves of each channel as well.

    Raises
    ------
    DataError
        When there is no logbook, or a test is damaged, was changed, or names no legform and day.
    UsageError
        When the logbook does not know a legform, or the day is none.
    """
    book = Logbook(Path(folder))
    paths = [tests] if isinstance(tests, (str, Path)) else tests
    if paths:
        add_tests(paths, folder)
    own = None if rules is None else rules_of(Path(rules))
    asked = day_of(day) if isinstance(day, str) else day
    exact = own is not None and own.serial_numbers == "exact"
    return [
        worded(overview(book, serial, rules=own, day=asked, curves=curves))
        for serial in serials or book.serials(exact=exact)
    ]


def rules_of(named: Path) -> LogbookRules:
    """Read own rules from a file, else the shipped ones of that name."""
    if named.suffix or named.exists():
        return read_document(named, LogbookRules)
    return shipped_rules(str(named))


def add_tests(
    tests: Sequence[str | Path], folder: str | Path = FOLDER
) -> tuple[list[LogbookEntry], list[LogbookEntry]]:
    """Put tests into a logbook; return the entries that are new, and those that it had already.

    Parameters
    ----------
    tests : sequence of str or Path
        `result.json` of graded tests, or folders of their runs.
    folder : str or Path
        Of the logbook; made with the first test.

    Raises
    ------
    DataError
        When a test is damaged, was changed, comes to other values when it is graded again, or names no
        legform and day. One that cannot be graded again, or has the samples of another, is booked with a
        `TakenAsSaidWarning`.
    """
    return add(Logbook(Path(folder)), [Path(path) for path in tests], wrong_values_today)


def rebuild_index(folder: str | Path = FOLDER) -> int:
    """Make a logbook's index again from its documents; return how many tests it has."""
    return rebuild(Logbook(Path(folder)))


def day_of(text: str) -> date:
    """Read a day.

    Raises
    ------
    UsageError
        When it is none.
    """
    if text == "today":
        return datetime.now(tz=UTC).astimezone().date()
    try:
        return date.fromisoformat(text)
    except ValueError as error:
        raise UsageError(f"`{text}` is no day; write it as 2026-03-31, or `today`") from error
