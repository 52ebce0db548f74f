"""One line of a logbook, taken from a result document."""

from __future__ import annotations

import re
from datetime import date
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.documents.document_kinds import MEASURED
from certkit.errors import DataError
from certkit.logbooks.same_blow import channel_digests

if TYPE_CHECKING:
    from collections.abc import Iterable

    from certkit.documents.result import Result


def serial_key(serial: str, *, exact: bool) -> str:
    """Return what two ways of writing one serial number have in common: all but case and blanks, or all."""
    return serial if exact else "".join(serial.split()).casefold()


class Reading(Struct, frozen=True):
    """A criterion's value with its limits, in its unit."""

    criterion: str
    title: str
    value: float | None
    unit: str
    lower: float | None
    upper: float | None
    verdict: str


class LogbookEntry(Struct, frozen=True):
    """A test of one legform.

    Parameters
    ----------
    id : str
        Certificate id.
    serial : str
        Serial number of the legform.
    day : date
        When it was tested.
    number : str
        The laboratory's number of the test; tests of one day follow each other by it.
    procedure, verdict, kind : str
        As in the document.
    readings : tuple of Reading
        In the procedure's order.
    recordings : tuple of str
        Hashes of the data that were graded.
    revision : int
        Of the report.
    replaces : str
        Id or number of the report that this one replaces; empty for a first report.
    laboratory : str
        Who reported it.
    channels : tuple of str
        Digests of what was recorded, see `channel_digests`.
    """

    id: str
    serial: str
    day: date
    number: str
    procedure: str
    verdict: str
    kind: str
    readings: tuple[Reading, ...]
    recordings: tuple[str, ...] = ()
    revision: int = 0
    replaces: str = ""
    laboratory: str = ""
    channels: tuple[str, ...] = ()

    def takes_the_place_of(self, earlier: LogbookEntry) -> bool:
        """Tell whether this report replaces another: it names its id, or an earlier revision's number."""
        if not self.replaces or earlier.id == self.id:
            return False
        named = self.replaces == earlier.number and self.laboratory == earlier.laboratory
        return self.replaces == earlier.id or (named and earlier.revision < self.revision)

    @property
    def test_key(self) -> tuple[str, str, tuple[str, ...]]:
        """What makes it this test, however often it was graded: procedure, the laboratory's number, data."""
        return self.procedure, self.number, self.recordings

    @property
    def order(self) -> tuple[date, list[tuple[int, int, str]], str]:
        """Key that puts tests into the order in which they were done."""
        parts = re.findall(r"\d+|\D+", self.number)
        return self.day, [(0, int(p), "") if p.isdigit() else (1, 0, p) for p in parts], self.id


def replacements(entries: Iterable[LogbookEntry]) -> dict[str, str]:
    """Return the id of the report that took the place of each replaced one, by the id of the latter."""
    listed = list(entries)
    return {old.id: new.id for new in listed if new.replaces for old in listed if new.takes_the_place_of(old)}


def entry_of(result: Result, place: str) -> LogbookEntry:
    """Take a logbook's line from a document.

    Parameters
    ----------
    result : Result
        With a laboratory's header.
    place : str
        The document, for messages.

    Raises
    ------
    DataError
        When the test was not measured, or the document does not say which legform was tested, or when.
    """
    if result.kind != MEASURED:
        raise DataError(
            f"{place}: is a {result.kind}; measured tests only are taken here; name the evaluation of one"
        )
    header = result.laboratory or {}
    item, test = header.get("item"), header.get("test")
    serial = item.get("serial") if isinstance(item, dict) else None
    if not isinstance(serial, str) or not serial.strip():
        raise DataError(f"{place}: names no serial number; grade the test with --lab, whose `item` has one")
    performed = test.get("performed") if isinstance(test, dict) else None
    try:
        day = date.fromisoformat(str(performed))
    except ValueError as error:
        raise DataError(f"{place}: `test: performed` is no date; grade the test with --lab") from error
    told = test if isinstance(test, dict) else {}
    number, revision = told.get("number"), told.get("revision")
    return LogbookEntry(
        id=result.id,
        serial=serial.strip(),
        day=day,
        number=str(number or ""),
        procedure=result.procedure,
        verdict=result.verdict,
        kind=result.kind,
        readings=tuple(
            Reading(c.id, c.title, c.value, c.unit, c.lower, c.upper, c.verdict if c.graded else "")
            for c in result.criteria
        ),
        revision=revision if isinstance(revision, int) else 0,
        replaces=str(told.get("replaces") or "").strip(),
        laboratory=str(header.get("laboratory") or ""),
        recordings=tuple(sorted(i.sha256 for i in result.provenance.inputs if i.role == "recording")),
        channels=channel_digests(result),
    )
