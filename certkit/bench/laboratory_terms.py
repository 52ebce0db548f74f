"""A laboratory's file in the terms of grading: header, logo, sensor checks, decision rule, uncertainties."""

from __future__ import annotations

import base64
import hashlib
import re
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from certkit.definitions.laboratory import Laboratory
from certkit.definitions.loading.channel_tables import default_channels
from certkit.definitions.loading.validation import read_bytes, validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.documents.result import InputFile, PreconditionResult
from certkit.errors import DataError, DefinitionError, Problem
from certkit.exchange.codes import code_table
from certkit.exchange.conditions import Told, read_condition, together
from certkit.files.bounded import open_plain
from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule
from certkit.grading.grading_terms import LaboratoryTerms
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.channels import ChannelTable

LOGO_BYTES = 300_000
LOGO_PIXELS = 4_000
"""Largest logo: it is embedded in every page and certificate."""

_PNG = b"\x89PNG\r\n\x1a\n"
_JPEG = b"\xff\xd8\xff"


def read_laboratory(path: str | Path, channels: ChannelTable | None = None) -> LaboratoryTerms:
    """Read `lab.yaml`; `channels` are those of the legform that was tested.

    Raises
    ------
    DefinitionError
        With all problems of the file; also when its logo cannot be used.
    """
    path = Path(path)
    data = read_bytes(path)
    laboratory = validate(read_tree(data, path.name), Laboratory, channels=channels)
    logo = embedded_logo(laboratory.logo, path.parent) if laboratory.logo else None
    digest = hashlib.sha256(data).hexdigest()
    source = InputFile(role="laboratory", path=path.name, sha256=digest, text=data.decode("utf-8-sig"))
    return laboratory_terms(laboratory, logo, source, channels)


def laboratory_terms(
    laboratory: Laboratory, logo: str | None, source: InputFile, channels: ChannelTable | None = None
) -> LaboratoryTerms:
    """Bring a laboratory's words into the terms of grading; `channels` are those of the legform.

    Raises
    ------
    DataError
        When a condition is no quantity.
    """
    rule, known = laboratory.decision, channels or default_channels()
    if laboratory.item.legform is None:
        item = laboratory.item.model_copy(update={"legform": known.impactor})
        laboratory = laboratory.model_copy(update={"item": item})
    return LaboratoryTerms(
        header=laboratory.header(logo),
        checks=_sensor_checks(laboratory),
        decision=DecisionRule(rule.r) if rule.rule == "guard band" else SIMPLE_ACCEPTANCE,
        uncertainties={name: laboratory.uncertainty(name, known) for name in laboratory.uncertainties},
        conditions=_conditions(laboratory),
        specimen={"legform": laboratory.item.legform or known.impactor, "serial": laboratory.item.serial},
        inputs=(source,),
    )


def _sensor_checks(laboratory: Laboratory) -> tuple[PreconditionResult, ...]:
    expired = laboratory.expired_sensors
    day = laboratory.test.performed
    rows = []
    for sensor in laboratory.sensors:
        left = (sensor.expires - day).days
        reason = None
        if sensor in expired:
            reason = Reason.of(
                "sensor-expired" if left < 0 else "sensor-calibrated-later",
                sensor=sensor.serial,
                channel=sensor.channel,
                day=str(sensor.expires if left < 0 else sensor.calibrated),
                tested=str(day),
            )
        rows.append(
            PreconditionResult(
                quantity=f"calibration left, sensor {sensor.serial} ({sensor.channel})",
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


def embedded_logo(name: str, folder: Path) -> str:
    """Return the picture as a `data:` address.

    Parameters
    ----------
    name : str
        As written in the laboratory file: a file in or below its folder.
    folder : Path
        That folder.

    Raises
    ------
    DefinitionError
        When it leads out of the folder, is missing, too large, or no PNG or JPEG.
    """
    path = folder / name
    if not path.resolve().is_relative_to(folder.resolve()):
        raise _logo_problem(name, "lies outside the laboratory file's folder; put the logo beside the file")
    if not path.is_file():
        raise _logo_problem(name, "there is no such logo beside the laboratory file")
    with open_plain(path) as stream:
        data = stream.read(LOGO_BYTES + 1)
    if len(data) > LOGO_BYTES:
        raise _logo_problem(name, f"is larger than {LOGO_BYTES // 1000} kB; scale the logo down")
    if data.startswith(_PNG) and data[12:16] == b"IHDR":
        if max(int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")) > LOGO_PIXELS:
            raise _logo_problem(name, f"is wider or higher than {LOGO_PIXELS} pixels; scale the logo down")
        kind = "png"
    elif data.startswith(_JPEG):
        kind = "jpeg"
    else:
        raise _logo_problem(name, "is neither PNG nor JPEG; other formats can carry code")
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"


def _logo_problem(name: str, message: str) -> DefinitionError:
    return DefinitionError([Problem(name, 0, 0, message)])
