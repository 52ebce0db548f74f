"""A laboratory's file in the terms of grading: header, sensor checks, decision rule, uncertainties."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from certkit.definitions.laboratory import Laboratory
from certkit.definitions.loading.validation import read_bytes, validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.definitions.logo import embedded_logo
from certkit.documents.result import InputFile, PreconditionResult
from certkit.errors import DataError
from certkit.exchange.codes import code_table
from certkit.exchange.conditions import read_condition
from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


@dataclass(frozen=True)
class LaboratoryPart:
    """What a laboratory's file adds to a grading.

    Parameters
    ----------
    header : dict or None
        For the report.
    checks : tuple of PreconditionResult
        One row a sensor: whether its calibration covers the day of the test.
    decision : DecisionRule
        Simple acceptance or a guard band.
    uncertainties : dict of str to float
        Expanded uncertainty by channel, SI.
    conditions : dict of str to float
        Conditions of the test, SI.
    specimen : dict of str to str
        The legform on the rig.
    inputs : tuple of InputFile
        The file itself.
    """

    header: dict[str, Any] | None
    checks: tuple[PreconditionResult, ...]
    decision: DecisionRule
    uncertainties: dict[str, float]
    conditions: dict[str, float]
    specimen: dict[str, str]
    inputs: tuple[InputFile, ...]


NO_LABORATORY = LaboratoryPart(None, (), SIMPLE_ACCEPTANCE, {}, {}, {}, ())


def read_laboratory(path: Path) -> LaboratoryPart:
    """Read `lab.yaml`.

    Raises
    ------
    DefinitionError
        With all problems of the file; also when its logo cannot be used.
    """
    data = read_bytes(path)
    laboratory = validate(read_tree(data, path.name), Laboratory)
    logo = embedded_logo(laboratory.logo, path.parent) if laboratory.logo else None
    digest = hashlib.sha256(data).hexdigest()
    source = InputFile(role="laboratory", path=path.name, sha256=digest, text=data.decode("utf-8-sig"))
    return laboratory_part(laboratory, logo, source)


def laboratory_part(laboratory: Laboratory, logo: str | None, source: InputFile) -> LaboratoryPart:
    """Bring a laboratory's words into the terms of grading.

    Raises
    ------
    DataError
        When a condition is no quantity.
    """
    rule = laboratory.decision
    return LaboratoryPart(
        header=laboratory.header(logo),
        checks=_sensor_checks(laboratory),
        decision=DecisionRule(rule.r) if rule.rule == "guard band" else SIMPLE_ACCEPTANCE,
        uncertainties={name: laboratory.uncertainty(name) for name in laboratory.uncertainties},
        conditions=_conditions(laboratory),
        specimen={"legform": laboratory.item.legform, "serial": laboratory.item.serial},
        inputs=(source,),
    )


def _sensor_checks(laboratory: Laboratory) -> tuple[PreconditionResult, ...]:
    expired = laboratory.expired_sensors
    day = laboratory.test.performed
    rows = []
    for sensor in laboratory.sensors:
        left = (sensor.expires - day).days
        reason = ""
        if sensor in expired:
            when = (
                f"expired on {sensor.expires}" if left < 0 else f"was calibrated on {sensor.calibrated} only"
            )
            reason = (
                f"the calibration of sensor {sensor.serial} ({sensor.channel}) {when}; the test was on {day}"
            )
        rows.append(
            PreconditionResult(
                quantity=f"calibration left, sensor {sensor.serial} ({sensor.channel})",
                value=float(left),
                unit="d",
                lower=0.0,
                verdict="fail" if reason else "pass",
                reason=reason,
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
            raise DataError(f"laboratory file, condition {word}: {error}") from error
    return found


def merged_conditions(told: Mapping[str, float], laboratory: Mapping[str, float]) -> dict[str, float]:
    """Join the conditions of the data with the laboratory's.

    Raises
    ------
    DataError
        When both tell a condition and differ by more than 0.1 %.
    """
    for word, value in laboratory.items():
        if word in told and not math.isclose(told[word], value, rel_tol=1e-3):
            raise DataError(
                f"condition {word}: the data say {told[word]:.6g}, the laboratory file {value:.6g} (SI); "
                "correct one of them"
            )
    return {**told, **laboratory}
