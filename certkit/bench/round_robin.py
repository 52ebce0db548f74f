"""`round_robin`: repeatability and reproducibility of a test from several laboratories' certificates."""

from __future__ import annotations

import math
from collections import defaultdict
from typing import TYPE_CHECKING

from certkit.bench.graded_again import wrong_values
from certkit.bench.results_at_path import results_at
from certkit.documents.round_robin_report import (
    CriterionPrecision,
    LaboratoryRow,
    RoundRobinReport,
    RoundRobinTest,
)
from certkit.errors import DataError, UsageError
from certkit.grading.interlaboratory import precision, robust_mean, statistics_by_laboratory
from certkit.logbooks.logbook_entry import entry_of, serial_key
from certkit.logbooks.same_blow import shared_channels
from certkit.reasons import Reason
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from certkit.documents.result import CriterionResult, Result
    from certkit.logbooks.logbook_entry import LogbookEntry

FACTOR = 2.8
"""Two values differ by less in 95 % of cases: 1.96·√2 times the standard deviation (ISO 5725-6, 4.1.4)."""


def round_robin(
    certificates: Sequence[str | Path],
    *,
    without: Sequence[str] = (),
    title: str = "Round robin",
    unverified: bool = False,
) -> RoundRobinReport:
    """Draw up how well laboratories agree.

    Every criterion that two laboratories have values of is judged, of each procedure by itself. The values
    are those of the certificates; each certificate that carries its channels is graded again first, and has
    to come to them.

    Parameters
    ----------
    certificates : sequence of str or Path
        Certificates (PDF), `result.json`, or folders of runs, of measured tests graded with `--lab`.
    without : sequence of str
        Laboratories to leave out, as the document says.
    title : str
        Of the document.
    unverified : bool
        Take documents that were changed since certkit wrote them as well.

    Raises
    ------
    DataError
        When a certificate is damaged, was changed, does not come to its values when it is graded again,
        names no laboratory, legform or day, is no measured test, or has the samples of another; all at once.
    UsageError
        When fewer than two laboratories are left, or one to leave out is not there.
    """
    tests = _read(certificates, unverified=unverified)
    names = _one_name_each([name for name, _, _ in tests])
    unknown = [name for name in without if _key(name) not in {_key(known) for known in names.values()}]
    if unknown:
        known = ", ".join(sorted(set(names.values())))
        raise UsageError(f"no certificate is of the laboratory `{unknown[0]}`; there are {known}")
    gone = {_key(name) for name in without}
    kept = [(names[name], entry, result) for name, entry, result in tests if _key(name) not in gone]
    laboratories = sorted({name for name, _, _ in kept})
    if len(laboratories) < 2:  # one alone agrees with itself
        raise UsageError("a round robin needs certificates of two laboratories or more; name more of them")
    criteria = _criteria(kept)
    if not criteria:
        raise UsageError("no criterion has values of two laboratories; name certificates of one procedure")
    document = RoundRobinReport(
        title=title,
        laboratories=laboratories,
        left_out=sorted({names[name] for name, _, _ in tests if _key(name) in gone}),
        tests=[
            RoundRobinTest(
                id=entry.id,
                laboratory=name,
                serial=entry.serial,
                day=entry.day.isoformat(),
                procedure=entry.procedure,
                verdict=result.verdict,
            )
            for name, entry, result in sorted(kept, key=lambda test: (test[0], test[1].order))
        ],
        criteria=criteria,
        coded_remarks=_remarks(kept, criteria),
    )
    return worded(document).as_written().with_id()


def _read(certificates: Sequence[str | Path], *, unverified: bool) -> list[tuple[str, LogbookEntry, Result]]:
    """Read all certificates, and say of all that cannot be taken why."""
    found: list[tuple[str, LogbookEntry, Result]] = []
    places: dict[object, str] = {}
    faults: list[str] = []
    for path in certificates:
        try:
            for place, result in results_at(path, unverified=unverified):
                entry = entry_of(result, place)
                name = str((result.laboratory or {}).get("laboratory") or "").strip()
                if not name:
                    faults.append(f"{place}: names no laboratory; grade the test with --lab")
                    continue
                same = entry.test_key if entry.recordings else entry.id
                if same in places:
                    faults.append(f"{place}: the test that {places[same]} has too; name each test once")
                    continue
                faults += _used_before(place, entry, zip(places.values(), found, strict=True))
                places[same] = place
                faults += wrong_values(place, result)
                found.append((name, entry, result))
        except DataError as error:
            faults.append(str(error))
    if faults:
        raise DataError("\n".join(faults))
    return found


def _used_before(
    place: str, entry: LogbookEntry, others: Iterable[tuple[str, tuple[str, LogbookEntry, Result]]]
) -> list[str]:
    """Say whose samples a test has, where another one has them too."""
    for there, (_, other, _) in others:
        same = shared_channels(entry.channels, other.channels)
        if same:
            return [
                f"{place}: {same} are sample by sample those of {there}; one blow is one test: leave one out"
            ]
    return []


def _key(name: str) -> str:
    return serial_key(name, exact=False)


def _one_name_each(written: Sequence[str]) -> dict[str, str]:
    """Give laboratories whose names differ in case or blanks one name, the one that came first."""
    first: dict[str, str] = {}
    return {name: first.setdefault(_key(name), name) for name in written}


def _criteria(tests: Sequence[tuple[str, LogbookEntry, Result]]) -> list[CriterionPrecision]:
    values: dict[tuple[str, str], dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    first: dict[tuple[str, str], CriterionResult] = {}
    for name, entry, result in sorted(tests, key=lambda test: (test[0], test[1].order)):
        for criterion in result.criteria:
            if criterion.value is None or not math.isfinite(criterion.value):
                continue
            key = (entry.procedure, criterion.id)
            known = first.setdefault(key, criterion)
            if known.unit == criterion.unit:
                values[key][name].append(criterion.value)
    order = sorted(values, key=lambda key: key[0])
    return [_criterion(key[0], first[key], values[key]) for key in order if len(values[key]) > 1]


def _criterion(
    procedure: str, criterion: CriterionResult, values: dict[str, list[float]]
) -> CriterionPrecision:
    of_all, each = precision(values), statistics_by_laboratory(values)
    centre, scale = robust_mean([one.mean for one in each.values()])
    return CriterionPrecision(
        procedure=procedure,
        criterion=criterion.id,
        title=criterion.title,
        unit=criterion.unit,
        lower=criterion.lower,
        upper=criterion.upper,
        tests=sum(map(len, values.values())),
        mean=of_all.mean,
        repeatability=of_all.within,
        between=of_all.between,
        reproducibility=of_all.total,
        repeatability_limit=None if of_all.within is None else FACTOR * of_all.within,
        reproducibility_limit=None if of_all.total is None else FACTOR * of_all.total,
        robust_mean=centre,
        robust_deviation=scale,
        rows=[
            LaboratoryRow(
                laboratory=name,
                values=values[name],
                mean=one.mean,
                deviation=one.deviation,
                z=one.z,
                h=one.h,
                k=one.k,
                **dict(one.found),
            )
            for name, one in each.items()
        ],
    )


def _remarks(
    tests: Sequence[tuple[str, LogbookEntry, Result]], criteria: Sequence[CriterionPrecision]
) -> list[Reason]:
    remarks = []
    serials = sorted({entry.serial for _, entry, _ in tests})
    if len({serial_key(serial, exact=False) for serial in serials}) > 1:
        remarks.append(Reason.of("robin-of-several-legforms", count=len(serials), serials=serials))
    if any(each.repeatability is None for each in criteria):
        remarks.append(Reason.of("robin-without-repetition"))
    few = min(len(each.rows) for each in criteria)
    if few < 8:  # ISO 5725-1, 6.3.4
        remarks.append(Reason.of("robin-of-few", count=few))
    if any(result.channels is None for _, _, result in tests):
        remarks.append(Reason.of("robin-without-channels"))
    return remarks
