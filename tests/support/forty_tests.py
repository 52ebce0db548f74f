"""Forty made-up tests of two legforms, as result documents of a laboratory."""

from __future__ import annotations

from datetime import date, timedelta

from certkit.documents.result import CriterionResult, Provenance, Result

CERTIFICATIONS = ("pendulum", "inverse", "static-femur", "static-tibia", "static-knee")
BEGIN = date(2025, 1, 6)


def document(
    serial: str, day: date, number: int, procedure: str, t1: float, *, upper: float = 272.0
) -> Result:
    verdict = "pass" if 235.0 <= t1 <= upper else "fail"
    if procedure == "vehicle":
        verdict = "pass" if t1 <= upper else "fail"
    lower = None if procedure == "vehicle" else 235.0
    result = Result(
        kind="test evaluation",
        procedure=procedure,
        title=procedure,
        verdict=verdict,
        criteria=[
            CriterionResult(
                id="T1",
                title="Tibia moment 1",
                value=t1,
                unit="N·m",
                lower=lower,
                upper=upper,
                verdict=verdict,
            )
        ],
        laboratory={
            "laboratory": "Example",
            "item": {"serial": serial},
            "test": {"performed": day.isoformat(), "number": f"2025-{number}"},
        },
        provenance=Provenance(certkit="0", inputs=[], packages={}),
    )
    return result.with_id()


def forty() -> list[Result]:
    """Per leg 5 certifications, then 9 vehicle tests among 6 pendulums; A-1 drifts up, B-2 does not."""
    results = []
    for serial, drift in (("A-1", 2.0), ("B-2", 0.0)):
        number = 1
        for procedure in CERTIFICATIONS:
            results.append(document(serial, BEGIN, number, procedure, 250.0))
            number += 1
        pendulums = 0
        for week in range(1, 16):
            day = BEGIN + timedelta(weeks=week)
            if week % 5 in {0, 3}:
                pendulums += 1
                wobble = 0.1 if pendulums % 2 else -0.1
                results.append(document(serial, day, number, "pendulum", 250.0 + drift * pendulums + wobble))
            else:
                results.append(document(serial, day, number, "vehicle", 300.0 + week, upper=340.0))
            number += 1
    return results
