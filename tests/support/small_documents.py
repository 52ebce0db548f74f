"""Small documents of the kinds that need no builder: one of each, with something in every part."""

from __future__ import annotations

from certkit.documents.round_robin_report import (
    CriterionPrecision,
    LaboratoryRow,
    RoundRobinReport,
    RoundRobinTest,
)
from certkit.documents.twin_report import PartFinding, TwinCurve, TwinReport, TwinTest
from certkit.documents.uncertainty_report import BudgetLine, CriterionUncertainty, UncertaintyReport

UNCERTAINTY = UncertaintyReport(
    budget="toy",
    title="A <toy> budget",
    procedure="pendulum",
    risk=0.05,
    runs=100,
    failed=1,
    criteria=[
        CriterionUncertainty(
            criterion="T1",
            title="tibia moment 1",
            channel="T1",
            unit="N·m",
            value=250.0,
            lower=235.0,
            upper=272.0,
            expanded=10 / 3,
            simulated=3.3,
            shift=0.1,
            lines=[
                BudgetLine(
                    name="gain", standard=0.01, unit="", sensitivity=250.0, contribution=2.5, share=1.0
                )
            ],
        )
    ],
    sources={"gain": "a data sheet"},
).with_id()

TWIN = TwinReport(
    diagnosis="toy",
    title="A <toy> leg",
    legform="leg",
    against="none",
    tests=[
        TwinTest(
            id="AAAA-BBBB-CCCC-DDDD",
            procedure="pendulum",
            day="2026-03-01",
            serial="FLX-7",
            answer="one part",
            misfit=1 / 3,
            samples=100,
            findings=[
                PartFinding(
                    part="flesh",
                    change=-10.0,
                    unit="%",
                    lower=-12.0,
                    upper=-8.0,
                    misfit=0.1,
                    explained=0.9,
                    candidate=True,
                    remedy="look at the flesh",
                )
            ],
            curves=[
                TwinCurve(
                    channel="T1",
                    title="tibia moment 1",
                    unit="N·m",
                    time=[0.0, 0.001, 0.002],
                    recorded=[0.0, 1.0, 2.0],
                    model=[0.0, 1.5, 2.5],
                    changed=[0.0, 1.1, 2.1],
                )
            ],
        )
    ],
).with_id()

ROUND_ROBIN = RoundRobinReport(
    title="Three <toy> laboratories",
    laboratories=["North", "South"],
    tests=[
        RoundRobinTest(
            id=f"AAAA-BBBB-CCCC-000{number}",
            laboratory=name,
            serial="FLX-7",
            day="2026-03-01",
            procedure="pendulum",
            verdict="pass",
        )
        for number, name in enumerate(("North", "South"))
    ],
    criteria=[
        CriterionPrecision(
            procedure="pendulum",
            criterion="T1",
            title="tibia moment 1",
            unit="N·m",
            lower=235.0,
            upper=272.0,
            tests=2,
            mean=250.0,
            repeatability=1 / 3,
            between=1.0,
            reproducibility=1.1,
            robust_mean=250.0,
            robust_deviation=1.0,
            rows=[
                LaboratoryRow(laboratory="North", values=[249.0], mean=249.0),
                LaboratoryRow(laboratory="South", values=[251.0], mean=251.0),
            ],
        )
    ],
).with_id()
