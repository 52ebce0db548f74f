"""A laboratory's file in the terms of grading: header, calibration checks, decision rule, uncertainties."""

from __future__ import annotations

import re
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from certkit.bench.laboratory_files import read_files
from certkit.bench.report_numbers import report_number
from certkit.definitions.loading.channel_tables import default_channels
from certkit.documents.result import CALIBRATION, PreconditionResult
from certkit.errors import DataError, DefinitionError, Problem
from certkit.exchange.codes import code_table
from certkit.exchange.conditions import Told, read_condition, together
from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule
from certkit.grading.grading_terms import LaboratoryTerms
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from datetime import date

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.laboratory import Laboratory
    from certkit.documents.result import InputFile


def read_laboratory(
    path: str | Path, channels: ChannelTable | None = None, *, test: str = ""
) -> LaboratoryTerms:
    """Read `lab.yaml`; `channels` are those of the legform that was tested.

    Parameters
    ----------
    path : str or Path
    channels : ChannelTable, optional
        The shipped legform's when missing.
    test : str
        What makes it this test and no other, for the register of report numbers; none is given out without.

    Raises
    ------
    DefinitionError
        With all problems of the file; also when its logo cannot be used, or it describes no test.
    """
    path = Path(path)
    found = read_files(path, channels)
    laboratory = found.laboratory
    if laboratory.test is None:
        raise DefinitionError(
            [
                Problem(
                    path.name, 0, 0, "describes no test; name the test's file, with this one as its `shared`"
                )
            ]
        )
    number = laboratory.test.number or ""
    if laboratory.numbering is not None and test:
        register = path.parent / laboratory.numbering.register_
        number = report_number(register, laboratory.numbering.pattern, test, laboratory.test, number)
    return laboratory_terms(laboratory, found.logo, found.inputs, channels, number=number)


def laboratory_terms(
    laboratory: Laboratory,
    logo: str | None,
    sources: Sequence[InputFile],
    channels: ChannelTable | None = None,
    *,
    number: str = "",
) -> LaboratoryTerms:
    """Bring a laboratory's words into the terms of grading; `channels` are those of the legform.

    Parameters
    ----------
    laboratory : Laboratory
        With item and test.
    logo : str, optional
        As it is embedded.
    sources : sequence of InputFile
        The files.
    channels : ChannelTable, optional
    number : str
        Of the report, where the register gave it.

    Raises
    ------
    DataError
        When a condition is no quantity.
    """
    rule, known = laboratory.decision, channels or default_channels()
    item, test = laboratory.item, laboratory.test
    if test is None or item is None:
        raise DataError(f"{sources[0].path}: names no item and no test; give `item` and `test`")
    if item.legform is None:
        item = item.model_copy(update={"legform": known.impactor})
        laboratory = laboratory.model_copy(update={"item": item})
    if number:
        test = test.model_copy(update={"number": number})
        laboratory = laboratory.model_copy(update={"test": test})
    return LaboratoryTerms(
        header=laboratory.header(logo),
        checks=_calibration_checks(laboratory, test.performed),
        decision=DecisionRule(rule.r) if rule.rule == "guard band" else SIMPLE_ACCEPTANCE,
        uncertainties={name: laboratory.uncertainty(name, known) for name in laboratory.uncertainties},
        conditions=_conditions(laboratory),
        specimen={"legform": item.legform or known.impactor, "serial": item.serial},
        inputs=tuple(sources),
    )


def _calibration_checks(laboratory: Laboratory, day: date) -> tuple[PreconditionResult, ...]:
    """Hold the calibration of each sensor and of other equipment against the day of the test."""
    sensors = [(each, f"sensor {each.serial} ({each.channel})", each.channel) for each in laboratory.sensors]
    others = [(each, f"{each.name} {each.serial}", "") for each in laboratory.equipment]
    rows = []
    for each, named, channel in (*sensors, *others):
        left = (each.expires - day).days
        reason = None
        if not each.covers(day):
            told = {"day": str(each.expires if left < 0 else each.calibrated), "tested": str(day)}
            late = "expired" if left < 0 else "calibrated-later"
            if channel:
                reason = Reason.of(f"sensor-{late}", sensor=each.serial, channel=channel, **told)
            else:
                reason = Reason.of(f"equipment-{late}", equipment=named, **told)
        rows.append(
            PreconditionResult(
                quantity=f"{CALIBRATION}{named}",
                value=float(left),
                unit="d",
                lower=0.0,
                verdict="fail" if reason else "pass",
                coded_reason=reason,
            )
        )
    return tuple(rows)


def _conditions(laboratory: Laboratory) -> dict[str, float]:
    table = code_table()
    found = {}
    for word, text in laboratory.conditions.items():
        try:
            found[word] = read_condition(word, text, table)
        except ValueError as error:
            raise DataError(f"laboratory file, condition {word}: {error}; correct it there") from error
    return found


def merged_conditions(
    told: Mapping[str, Told], laboratory: Mapping[str, float], file: str
) -> dict[str, float]:
    """Join the conditions of the data with the laboratory's.

    Raises
    ------
    DataError
        When the two contradict each other, with both places.
    """
    own = {word: Told(value, f"{file}, condition {word}") for word, value in laboratory.items()}
    return {word: item.value for word, item in together(told, own).items()}


def header_contradictions(header: Mapping[str, str], terms: LaboratoryTerms, file: str) -> list[Reason]:
    """Hold the header of the data against the laboratory's file.

    Returns
    -------
    list of Reason
        What the two say differently of the laboratory and of the tested object.

    Raises
    ------
    DataError
        When they name different days of the test.
    """
    if terms.header is None:
        return []
    told = header.get("Date of the test", "")
    day = _day(told)
    performed = (terms.header.get("test") or {}).get("performed")
    if day is not None and performed is not None and day != performed:
        raise DataError(
            f"{file}, test.performed: {performed}, but the header of the data says {told[:40]} "
            "(Date of the test); correct one of them"
        )
    item = terms.header.get("item") or {}
    said = []
    for words, own in (
        ("Laboratory name", terms.header.get("laboratory")),
        ("Ref. number of test object 1", item.get("serial")),
    ):
        if own and words in header and not _alike(str(own), header[words]):
            said.append(
                Reason.of("header-says-other", words=words, data=header[words][:60], laboratory=str(own))
            )
    return said


def _day(text: str) -> str | None:
    """Return a day as ISO 8601 has it, from `2026-03-02` or `02.03.2026`; None where it is no day."""
    for form in ("%Y-%m-%d", "%d.%m.%Y"):
        try:
            return datetime.strptime(text.strip()[:10], form).date().isoformat()  # noqa: DTZ007  # a day, no instant
        except ValueError:
            continue
    return None


def _alike(one: str, other: str) -> bool:
    """Tell whether two names are one but for capitals, blanks and hyphens."""
    first, second = (re.sub(r"[\s_-]+", "", text).casefold() for text in (one, other))
    return first in second or second in first
