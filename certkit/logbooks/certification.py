"""One legform's certification tests put together into its certificate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msgspec import Struct

from certkit._version import __version__
from certkit.documents.document_kinds import MEASURED
from certkit.documents.legform_certificate import CertifiedTest, LegformCertificate
from certkit.documents.verdicts import worst
from certkit.errors import DataError
from certkit.logbooks.logbook_entry import entry_of, serial_key
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.documents.logbook_overview import LegOverview, TestLine
    from certkit.documents.result import Result


class Issue(Struct, frozen=True):
    """Who issues a certificate, under which number."""

    laboratory: Mapping[str, Any] | None = None
    number: str = ""


def tests_to_certify(leg: LegOverview) -> dict[str, TestLine | None]:
    """Return the last test of each procedure that the rules certify by; None where there is none.

    A report that was replaced does not count.
    """
    last: dict[str, TestLine | None] = dict.fromkeys(leg.certified_by)
    for line in leg.tests:
        if line.procedure in last and line.replaced_by is None:
            last[line.procedure] = line
    return last


def certificate_of(leg: LegOverview, results: Sequence[Result], issue: Issue) -> LegformCertificate:
    """Put results together.

    Parameters
    ----------
    leg : LegOverview
        The legform's logbook on the day of issue.
    results : sequence of Result
        The last test of each procedure; see `tests_to_certify`.
    issue : Issue

    Raises
    ------
    DataError
        When a result is of another legform, was not measured, was replaced, or is not the last of its
        procedure; with all that is wrong.
    """
    wanted = tests_to_certify(leg)
    faults = [fault for result in results for fault in _faults(leg, result, wanted)]
    faults += _mixed(results)
    if faults:
        raise DataError("\n".join(f"certificate of {leg.serial}: {fault}" for fault in faults))
    by_procedure = {result.procedure: result for result in results}
    lost = [name for name, line in wanted.items() if line is not None and name not in by_procedure]
    if lost:
        raise DataError(
            f"certificate of {leg.serial}: the result of {lost[0]} is not handed over"
            "; hand over its result.json"
        )
    ordered = [by_procedure[name] for name in wanted if name in by_procedure]
    tests = [_test(name, by_procedure.get(name)) for name in wanted]
    verdict = worst(test.verdict for test in tests)
    overdue = [line for line in leg.validity if line.state in {"due", "revoked"}]
    if verdict == "pass" and overdue:
        verdict = "not evaluated"
    return LegformCertificate(
        serial=leg.serial,
        legform=ordered[0].specimen.get("legform", "") if ordered else "",
        number=issue.number,
        day=leg.day,
        verdict=verdict,
        coded_remarks=[
            *_unpassed(tests),
            *(
                Reason.of("certificate-overdue", rule=line.title, why=line.coded_why or line.why)
                for line in overdue
            ),
            Reason.of("certificate-scope", serial=leg.serial, rules=leg.rules),
        ],
        rules=leg.rules,
        next_due=min((line.due for line in leg.validity if line.due), default=None),
        laboratory=None if issue.laboratory is None else dict(issue.laboratory),
        tests=tests,
        logbook=leg,
        results=ordered,
        certkit=__version__,
    )


def _faults(leg: LegOverview, result: Result, wanted: Mapping[str, TestLine | None]) -> list[str]:
    """Say why a result cannot stand in the certificate."""
    named = f"{result.procedure} ({result.id})"
    if result.kind != MEASURED:
        return [f"{named} is a {result.kind}, not a measured test; a legform is certified by measured ones"]
    try:
        entry = entry_of(result, named)
    except DataError as error:
        return [str(error)]
    exact = leg.serial_numbers == "exact"
    if serial_key(entry.serial, exact=exact) != serial_key(leg.serial, exact=exact):
        return [f"{named} is a test of the legform {entry.serial}; serial numbers are not mixed"]
    return _out_of_turn(leg, result, wanted, named)


def _out_of_turn(
    leg: LegOverview, result: Result, wanted: Mapping[str, TestLine | None], named: str
) -> list[str]:
    """Say why a test of this legform is not the one that counts."""
    line = next((test for test in leg.tests if test.id == result.id), None)
    if line is not None and line.replaced_by is not None:
        return [f"{named} was replaced by the report {line.replaced_by}"]
    if result.procedure not in wanted:
        return [f"{named} is none of the tests that “{leg.rules}” asks for"]
    last = wanted[result.procedure]
    if last is None or last.id != result.id:
        said = "the logbook has none" if last is None else f"that is {last.id} of {last.day}"
        return [f"{named} is not the last test of its procedure in the logbook; {said}"]
    return []


def _mixed(results: Sequence[Result]) -> list[str]:
    """Say where tests of different kinds of legform, or two of one procedure, would be mixed."""
    legforms = sorted({legform for r in results if (legform := _legform_file(r))})
    faults = (
        [f"tests of different legforms ({' and '.join(legforms)}) are not mixed"] if len(legforms) > 1 else []
    )
    names = [result.procedure for result in results]
    return faults + [f"two tests of {name}" for name in sorted(set(names)) if names.count(name) > 1]


def _legform_file(result: Result) -> str:
    """Return the definition of the legform that a test was graded with."""
    return next((item.path for item in result.provenance.inputs if item.role == "legform"), "")


def _test(name: str, result: Result | None) -> CertifiedTest:
    if result is None:
        missing = Reason.of("certificate-test-missing", procedure=name)
        return CertifiedTest(procedure=name, verdict="not evaluated", coded_reasons=[missing])
    header = result.laboratory or {}
    entry = entry_of(result, result.id)
    return CertifiedTest(
        procedure=name,
        title=result.title,
        verdict=result.verdict,
        id=result.id,
        day=entry.day.isoformat(),
        number=entry.number,
        revision=entry.revision,
        replaces=entry.replaces,
        laboratory=str(header.get("laboratory", "")),
        coded_reasons=[] if result.verdict == "pass" else _why(result),
    )


def _why(result: Result) -> list[Reason]:
    """Return why a test has not passed: conditions that were not kept, criteria that failed, or no limits."""
    found = [
        row.coded_reason or Reason.words(row.reason)
        for row in result.preconditions
        if row.verdict == "fail" or (row.required and row.verdict != "pass")
    ]
    graded = [c for c in result.criteria if c.graded]
    for verdict in ("fail", "conditional", "not evaluated", "error"):
        names = [c.id for c in graded if c.verdict == verdict]
        if names:
            found.append(Reason.of("certificate-criteria", verdict=verdict, criteria=names))
    if not graded:
        found.append(Reason.of("certificate-no-limits"))
    return found


def _unpassed(tests: Sequence[CertifiedTest]) -> list[Reason]:
    """Return what stands against the certificate, test by test."""
    said = []
    for test in tests:
        if test.verdict == "pass":
            continue
        if not test.id:
            said += test.coded_reasons
            continue
        said.append(
            Reason.of(
                "certificate-test",
                procedure=test.procedure,
                verdict=test.verdict,
                reasons=test.coded_reasons,
            )
        )
    return said
