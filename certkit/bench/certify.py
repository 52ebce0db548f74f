"""`certify`: one certificate for one legform, from the last certification tests in its logbook."""

from __future__ import annotations

from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from certkit.bench.graded_again import wrong_values
from certkit.bench.laboratory_files import read_files
from certkit.bench.legform_logbook import FOLDER, add_tests, day_of, rules_of
from certkit.bench.report_numbers import report_number
from certkit.definitions.laboratory import TestDetails
from certkit.documents.document_kinds import MEASURED
from certkit.documents.result import Result
from certkit.errors import DataError
from certkit.logbooks import Issue, Logbook, certificate_of, overview, tests_to_certify
from certkit.logbooks.logbook_entry import serial_key
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.legform_certificate import LegformCertificate
    from certkit.documents.logbook_overview import LegOverview

OF_A_TEST = ("item", "test", "sensors", "equipment")
"""Parts of a test's header that say nothing of who issues a certificate."""


def certify(  # as many as the command has options
    serial: str,
    tests: str | Path | Sequence[str | Path] = (),
    *,
    folder: str | Path = FOLDER,
    rules: str | Path | None = None,
    day: str | date | None = None,
    laboratory: str | Path | None = None,
) -> LegformCertificate:
    """Put the certification tests of a legform together into one certificate.

    Parameters
    ----------
    serial : str
        Of the legform.
    tests : str, Path, or sequence of them
        `result.json` of graded tests of it, or folders of their runs, that are put into the logbook first.
    folder : str or Path
        Of the logbook.
    rules : str or Path, optional
        File with own rules of validity, or the name of shipped ones; those of UN R127 when missing. They say
        which procedures a legform is certified by.
    day : str or date, optional
        Day of issue; that of the last test when missing.
    laboratory : str or Path, optional
        File of the laboratory that issues it, for name, signatories and number; that of the last test when
        missing.

    Returns
    -------
    LegformCertificate
        A procedure without a test is named in it, and its verdict is `not evaluated` then.

    Raises
    ------
    DataError
        When a test is of another legform, was not measured, was replaced or changed, or comes to other values
        when it is graded again; with all that is wrong.
    UsageError
        When the logbook does not know the legform.
    """
    given = [Path(each) for each in ([tests] if isinstance(tests, (str, Path)) else tests)]
    own = None if rules is None else rules_of(Path(rules))
    if given:
        _check_given(serial, given, exact=own is not None and own.serial_numbers == "exact")
        add_tests(given, folder)
    book = Logbook(Path(folder))
    asked = day_of(day) if isinstance(day, str) else day
    leg = overview(book, serial, rules=own, day=asked, curves=True)
    results = book.results(line.id for line in tests_to_certify(leg).values() if line is not None)
    faults = [each for result in results for each in wrong_values(f"{folder}: {result.id}", result)]
    if faults:
        raise DataError("\n".join(faults))
    issue = _issue(leg, results, None if laboratory is None else Path(laboratory))
    return worded(certificate_of(leg, results, issue)).with_id()


def _check_given(serial: str, tests: Sequence[Path], *, exact: bool) -> None:
    """Refuse all tests where one is of another legform or was not measured, before any is booked."""
    faults = []
    for path in tests:
        result = Result.read(Result.file_at(path))  # the logbook checks its id
        item = (result.laboratory or {}).get("item")
        said = str(item.get("serial", "")) if isinstance(item, dict) else ""
        if result.kind != MEASURED:
            faults.append(f"{path}: is a {result.kind}; a legform is certified by measured tests")
        elif serial_key(said, exact=exact) != serial_key(serial, exact=exact):
            faults.append(
                f"{path}: is a test of the legform {said or 'without serial number'}, not of {serial}"
            )
    if faults:
        raise DataError("\n".join(faults))


def _issue(leg: LegOverview, results: Sequence[Result], path: Path | None) -> Issue:
    """Return who issues the certificate: the named laboratory, else that of the last test."""
    if path is None:
        headers = [result.laboratory or {} for result in results]
        last = max(headers, key=lambda header: str((header.get("test") or {}).get("performed")), default={})
        return Issue({key: value for key, value in last.items() if key not in OF_A_TEST} or None)
    found = read_files(path)
    header = found.laboratory.header(found.logo)
    number, numbering = "", found.laboratory.numbering
    if numbering is not None:
        key = " ".join(("certificate", leg.serial, leg.day, *sorted(result.id for result in results)))
        details = TestDetails.model_validate({"performed": date.fromisoformat(leg.day)})
        number = report_number(path.parent / numbering.register_, numbering.pattern, key, details)
    return Issue({key: value for key, value in header.items() if key not in OF_A_TEST}, number)
