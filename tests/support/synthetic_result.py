"""A made-up result document with everything that a report can show. No physics: only its shape is right."""

from __future__ import annotations

import hashlib
import math
from typing import Any
from xml.etree import ElementTree as ET

from certkit.documents.result import Result
from certkit.reporting.svg import Drawing

CORRIDORS = {
    "T1": ("Tibia moment 1", "N·m", 235.0, 272.0, 253.4, 0.0231),
    "T2": ("Tibia moment 2", "N·m", 187.0, 219.0, 203.6, 0.0228),
    "T3": ("Tibia moment 3", "N·m", 139.0, 166.0, 153.6, 0.0224),
    "T4": ("Tibia moment 4", "N·m", 90.0, 111.0, 108.7, 0.0221),
    "MCL": ("MCL elongation", "mm", 20.5, 24.0, 22.36, 0.0263),
    "ACL": ("ACL elongation", "mm", 8.0, 10.5, 9.31, 0.0192),
    "PCL": ("PCL elongation", "mm", 3.5, 5.0, 4.19, 0.0302),
}
OPEN = {
    "F1": ("Femur moment 1", "N·m", 222.3, 0.0217),
    "F2": ("Femur moment 2", "N·m", 169.7, 0.0214),
    "F3": ("Femur moment 3", "N·m", 116.7, 0.0208),
}
MEASURED = {"F3": (81, 52), "F2": (126.2, 110), "F1": (158.3, 165), "T1": (193.5, 200)}
MEASURED |= {"T2": (149.7, 150), "T3": (100.9, 92), "T4": (47.8, 40)}
SOURCE = "UN R127 (01 series), annex 6, clause 1.2"
PROCEDURE_TEXT = "procedure: pendulum\ntitle: Dynamic certification, pendulum test\n"


def pulse(peak: float, at: float, interval: float, count: int) -> list[float]:
    """Return a damped swing whose largest value is `peak` at `at`."""
    width = at * 0.62
    return [
        peak
        * (
            math.exp(-(((i * interval - at) / width) ** 2))
            - 0.22 * math.exp(-(((i * interval - 3.1 * at) / (1.4 * width)) ** 2))
        )
        for i in range(count)
    ]


def histories(interval: float, count: int) -> dict[str, Any]:
    """Return all channels on one axis."""
    peaks = {name: (t, u, v, at) for name, (t, u, _, _, v, at) in CORRIDORS.items()} | OPEN
    series = {
        name: {
            "title": title,
            "unit": unit,
            "values": pulse(peak, round(at / interval) * interval, interval, count),
            "filter": "CFC 180",
        }
        for name, (title, unit, peak, at) in peaks.items()
    }
    series["contact force"] = {
        "title": "Contact force",
        "unit": "N",
        "values": pulse(8120, 0.012, interval, count),
    }
    return {"start": 0.0, "interval": interval, "count": count, "series": series}


def motion(frames: int = 81, step: float = 0.001) -> dict[str, Any]:
    """Return a leg of 20 pieces that bends about its knee against a stopper."""
    shapes: list[dict[str, Any]] = []
    stations = [(0.094 + 0.0424 * (index + 0.5), 0.0424, "femur") for index in range(8)]
    stations += [(0.047, 0.094, "upper knee block"), (-0.0455, 0.091, "lower knee block")]
    stations += [(-0.091 - 0.0404 * (index + 0.5), 0.0404, "tibia") for index in range(10)]
    names: dict[str, int] = {}
    for _, height, part in stations:
        names[part] = names.get(part, 0) + 1
        knee = "knee" in part
        name = part if knee else f"{part} {names[part]}"
        half = 0.054 if knee else 0.042
        box = [
            (-half, -height / 2),
            (half, -height / 2),
            (half, height / 2),
            (-half, height / 2),
        ]
        shapes.append({"name": name, "kind": "knee" if knee else "bone", "outline": box})
    poses, moments = [], []
    for frame in range(frames):
        bend = 0.35 * math.sin(math.pi * min(frame * step / 0.05, 1.4))
        row, colours = [], []
        for z, _, _ in stations:
            angle = bend * (0.3 if z > 0 else -0.7) * min(1.0, abs(z) / 0.4)
            row.append((abs(z) * math.sin(abs(angle)) * 0.8, z * math.cos(angle), -angle))
            colours.append(250 * bend / 0.35 * max(0.0, 1 - abs(z) / 0.52))
        poses.append(row)
        moments.append(colours)
    bar = [
        (0.03 * math.cos(a / 8 * math.pi) + 0.075, 0.03 * math.sin(a / 8 * math.pi) - 0.04) for a in range(16)
    ]
    return {
        "times": [frame * step for frame in range(frames)],
        "shapes": shapes,
        "poses": poses,
        "joints": [s["name"] for s in shapes],
        "moments": moments,
        "scene": [
            {"name": "stopper", "kind": "rig", "outline": bar},
            {"name": "hinge", "kind": "rig", "outline": [(-0.02, -0.55), (0.02, -0.55), (0.0, -0.52)]},
        ],
    }


def criteria() -> list[dict[str, Any]]:
    """Return seven graded criteria and three that nobody has a corridor for."""
    rows = [
        {
            "id": name,
            "title": title,
            "value": value,
            "unit": unit,
            "lower": lower,
            "upper": upper,
            "margin": min(value - lower, upper - value),
            "time": at,
            "verdict": "pass",
            "confidence": "recalled",
            "source": SOURCE,
            "corridor": f"r127-pendulum/{name}",
            "channel": name,
            "measure": "max abs" if unit == "N·m" else "max",
            "filter": "CFC 180",
            "uncertainty": {"numerical": abs(value) * 2e-4},
        }
        for name, (title, unit, lower, upper, value, at) in CORRIDORS.items()
    ]
    rows += [
        {
            "id": name,
            "title": title,
            "value": value,
            "unit": unit,
            "time": at,
            "verdict": "not evaluated",
            "graded": False,
            "reason": "informative: no corridor is known",
            "channel": name,
            "measure": "max abs",
            "filter": "CFC 180",
        }
        for name, (title, unit, value, at) in OPEN.items()
    ]
    return rows


def document(**changes: object) -> dict[str, Any]:
    """Return the document as plain data, with top-level fields replaced by `changes`."""
    texts = {
        "procedure": ("procedures/pendulum.yaml", PROCEDURE_TEXT),
        "legform": ("models/legforms/flex-pli-gtr.yaml", "legform: flex-pli-gtr\n"),
        "corridors": ("corridors/r127-pendulum.yaml", "corridors: r127-pendulum\n"),
        "reference": ("references/seed-table-1.yaml", "reference: seed-table-1\n"),
    }
    rows = [
        {
            "channel": name,
            "test": test,
            "simulation": round(test * factor, 1),
            "error_percent": round((factor - 1) * 100, 2),
            "published": published,
            "published_error_percent": (published - test) / test * 100,
        }
        for (name, (test, published)), factor in zip(
            MEASURED.items(), (1.055, 0.985, 0.947, 1.046, 1.051, 0.965, 0.938), strict=True
        )
    ]
    data: dict[str, Any] = {
        "schema": "certkit-result/1",
        "id": "CK-7F3A-91C2-04DE",
        "kind": "virtual certification",
        "procedure": "pendulum",
        "title": "Dynamic certification, pendulum test",
        "verdict": "pass",
        "remarks": [
            "Rests on recalled corridors, not verified against the regulation's text.",
            "Does not cover F1, F2 and F3: no corridor is known; their curves are shown.",
        ],
        "method": SOURCE,
        "specimen": {"legform": "flex-pli-gtr", "part": "leg", "flesh": "fitted"},
        "criteria": criteria(),
        "scores": [
            {
                "id": "tibia",
                "points": 0.5,
                "maximum": 0.5,
                "criterion": "T1",
                "value": 253.4,
                "unit": "N·m",
                "full": 282.0,
                "zero": 340.0,
                "confidence": "verified",
                "source": "Euro NCAP pedestrian protocol",
            }
        ],
        "comparison": {
            "reference": "seed-table-1",
            "title": "Published measured peaks",
            "rms_error_percent": 4.84,
            "published_rms_error_percent": 16.2,
            "rows": rows,
            "notes": ["Error = (simulation − test) / test."],
        },
        "quality": {
            "verdict": "pass",
            "energy_error_percent": 0.052,
            "joint_gap_mm": 0.0062,
            "step_change_percent": 0.041,
            "steps": 10000,
            "time_step": 2e-5,
            "solver_seconds": 0.21,
            "checks": [
                {"title": "Energy balance", "value": 0.052, "limit": 0.5, "unit": "%", "verdict": "pass"},
                {"title": "Joint gap", "value": 0.0062, "limit": 0.02, "unit": "mm", "verdict": "pass"},
                {"title": "Step halving", "value": 0.041, "limit": 0.5, "unit": "%", "verdict": "pass"},
            ],
        },
        "interval": (0.0, 0.0612),
        "energies": {
            "start": 0.0,
            "interval": 0.002,
            "count": 100,
            "series": {
                name: {"title": name, "unit": "J", "values": pulse(peak, at, 0.002, 100)}
                for name, peak, at in (
                    ("kinetic", 61, 0.003),
                    ("bones", 34, 0.024),
                    ("ligaments", 18, 0.026),
                    ("dissipated", 22, 0.09),
                )
            },
        },
        "curves": histories(0.0004, 500),
        "channels": histories(0.0002, 1000),
        "motion": motion(),
        "parameters": [
            {
                "path": "legform.parts.femur.bending_stiffness",
                "value": "182 N·m²",
                "source": "fit flex-pli-gtr-1",
                "confidence": "calibrated",
            },
            {
                "path": "rig.added mass.mass",
                "value": "5 kg",
                "source": "system model paper, 2.3.1",
                "confidence": "verified",
            },
            {"path": "rig.stopper.height", "value": "50 mm", "source": "own fit", "confidence": "estimated"},
        ],
        "notes": ["Started at first contact with the speed that energy gives."],
        "provenance": {
            "certkit": "0.1.0",
            "inputs": [
                {
                    "role": role,
                    "path": path,
                    "sha256": hashlib.sha256(text.encode()).hexdigest(),
                    "text": text,
                }
                for role, (path, text) in texts.items()
            ],
            "packages": {"numba": "0.68.1", "numpy": "2.4.6", "pymunk": "7.3.1"},
            "overrides": [{"path": "rig.stopper.height", "value": "50 mm", "was": "60 mm"}],
        },
    }
    return data | changes


def static_document() -> dict[str, Any]:
    """Return a static bending test: curves in a plane, one with a polygon and one without."""
    points = [(0.5 * i, 20.5 * i * (1 - 0.004 * i)) for i in range(41)]
    plane = {"x_title": "deflection at mid-span", "x_unit": "mm", "y_title": "moment at mid-span"}
    plane |= {"y_unit": "N·m", "points": points}
    polygon = [(0, 0), (16, 400), (24, 400), (4, 0)]
    base = {"unit": "N·m", "confidence": "recalled", "source": "made up", "filter": "none"}
    rows = [
        base
        | {"id": "moment-deflection", "title": "Moment over deflection", "value": 3.1, "verdict": "pass"}
        | {"margin": 3.1, "unit": "mm", "measure": "curve in polygon", "curve": plane | {"polygon": polygon}},
        base
        | {"id": "knee", "title": "Informative curve", "value": None, "verdict": "not evaluated"}
        | {"graded": False, "measure": "curve in polygon", "curve": plane},
        base
        | {"id": "M4848", "title": "Moment at 4,848 N", "value": 399.6, "lower": 398.0, "upper": 402.0}
        | {"margin": 1.6, "verdict": "pass", "measure": "value at", "channel": "mid moment"},
    ]
    return document(
        procedure="static-femur",
        title="Static certification, femur bending",
        id="CK-1111-2222-3333",
        criteria=rows,
        comparison=None,
        scores=[],
        curves=None,
        energies=None,
        interval=None,
        motion=motion(9, 0.005),
    )


def laboratory_document() -> dict[str, Any]:
    """Return a measured test: a laboratory's header, a failed criterion, one that could not be measured."""
    rows = criteria()
    rows[3] |= {"value": 112.4, "margin": -1.4, "verdict": "fail"}
    rows[4] |= {"value": 20.8, "margin": 0.3, "verdict": "conditional", "reason": "inside the guard band"}
    rows[4]["uncertainty"] = {"expanded": 0.4, "guard_band": 0.4, "false_accept": 0.07}
    rows[5] |= {"value": None, "margin": None, "time": None, "verdict": "not evaluated"}
    rows[5]["reason"] = "channel ACL was not recorded"
    return document(
        id="CK-4444-5555-6666",
        kind="test evaluation",
        verdict="fail",
        criteria=rows,
        motion=None,
        quality=None,
        energies=None,
        decision_rule="guard band w = 1.0 U (ILAC-G8)",
        preconditions=[
            {
                "quantity": "temperature",
                "value": 20.4,
                "unit": "degC",
                "lower": 18,
                "upper": 22,
                "verdict": "pass",
            },
            {
                "quantity": "humidity",
                "value": None,
                "unit": "%",
                "lower": 10,
                "upper": 70,
                "verdict": "not evaluated",
                "reason": "not recorded",
            },
        ],
        laboratory={
            "name": "Laboratory of Examples",
            "place": "Example Town",
            "customer": "Bumper & <Sons>",
            "item": {"serial": "GTR-0815", "condition": "as received"},
            "persons": {"tested by": "A. Tester", "authorised by": "B. Signer"},
            "dates": {"received": "2026-03-02", "performed": "2026-03-04", "issued": "2026-03-05"},
        },
    )


def result(**changes: object) -> Result:
    """Return the pendulum result."""
    return Result.model_validate(document(**changes)).with_id()


def static_result() -> Result:
    """Return the static bending result."""
    return Result.model_validate(static_document()).with_id()


def laboratory_result() -> Result:
    """Return the measured result."""
    return Result.model_validate(laboratory_document()).with_id()


def parsed(xml: str | bytes | Drawing) -> ET.Element:
    """Parse what certkit itself has written."""
    return ET.fromstring(xml if isinstance(xml, bytes) else str(xml))  # noqa: S314  # our own output
