"""Made-up certificates of one test at several laboratories, and a published round robin."""

from __future__ import annotations

from datetime import date

from certkit.documents.result import CriterionResult, Provenance, Result

SULFUR_IN_COAL = (
    ((0.71, 0.71, 0.70, 0.71), (1.20, 1.18, 1.23, 1.21), (1.68, 1.70, 1.68, 1.69), (3.26, 3.26, 3.20, 3.24)),
    ((0.69, 0.67, 0.68), (1.22, 1.21, 1.22), (1.64, 1.64, 1.65), (3.20, 3.20, 3.20)),
    ((0.66, 0.65, 0.69), (1.28, 1.31, 1.30), (1.61, 1.61, 1.62), (3.37, 3.36, 3.38)),
    ((0.67, 0.65, 0.66), (1.23, 1.18, 1.20), (1.68, 1.66, 1.66), (3.16, 3.22, 3.23)),
    (
        (0.70, 0.69, 0.66, 0.71, 0.69),
        (1.31, 1.22, 1.22, 1.24),
        (1.64, 1.67, 1.60, 1.66, 1.68),
        (3.20, 3.19, 3.18, 3.27, 3.24),
    ),
    ((0.73, 0.74, 0.73), (1.39, 1.36, 1.37), (1.70, 1.73, 1.73), (3.27, 3.31, 3.29)),
    ((0.71, 0.71, 0.69), (1.20, 1.26, 1.26), (1.69, 1.70, 1.68), (3.27, 3.24, 3.23)),
    ((0.70, 0.65, 0.68), (1.24, 1.22, 1.30), (1.67, 1.68, 1.67), (3.25, 3.26, 3.26)),
)
"""ISO 5725-2:1994, B.1: sulfur content of coal, eight laboratories × four levels, mass %."""

PRINTED = ((0.690, 0.015, 0.026), (1.252, 0.029, 0.061), (1.667, 0.017, 0.035), (3.250, 0.026, 0.058))
"""Mean, s_r and s_R of each level, as printed there."""


def level(number: int) -> dict[str, tuple[float, ...]]:
    """Return the values of one level by laboratory."""
    return {f"laboratory {place}": row[number] for place, row in enumerate(SULFUR_IN_COAL, 1)}


def certificate(
    laboratory: str, number: int, t1: float, *, serial: str = "A-1", kind: str = "test evaluation"
) -> Result:
    """Return a pendulum test's certificate without channels."""
    verdict = "pass" if 235.0 <= t1 <= 272.0 else "fail"
    criterion = CriterionResult(
        id="T1", title="Tibia moment 1", value=t1, unit="N·m", lower=235.0, upper=272.0, verdict=verdict
    )
    return Result(
        kind=kind,  # one of the kinds, by the caller
        procedure="pendulum",
        title="Pendulum test",
        verdict=verdict,
        criteria=[criterion],
        laboratory={
            "laboratory": laboratory,
            "item": {"serial": serial},
            "test": {"performed": date(2026, 1, number).isoformat(), "number": f"{laboratory}-{number}"},
        },
        provenance=Provenance(certkit="0", inputs=[], packages={}),
    ).with_id()
