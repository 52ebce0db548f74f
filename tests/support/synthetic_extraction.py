"""A made-up extraction of a front with two faces and a beam, hit by a leg: all that its page can show."""

from __future__ import annotations

import math

from certkit.bench.tried_check import TITLES
from certkit.documents.extraction import (
    ClosureResult,
    ExtractionResult,
    GroupResult,
    LawResult,
    PathResult,
    SheetResult,
)
from certkit.documents.front_motion import FrontMotion, MovingLine
from certkit.documents.self_check import ChannelCheck, GroupCheck, PathCheck, SelfCheck

COUNT = 46
TIMES = [1e-3 * k for k in range(COUNT)]
PUSH = tuple(math.sin(math.pi * t / 0.045) for t in TIMES)
"""A half sine over all instants, 0 to 1 and back."""


def scaled(factor: float) -> tuple[float, ...]:
    """Return the half sine times a factor."""
    return tuple(factor * v for v in PUSH)


def group(name: str, kind: str, low: float | None, depth: float) -> GroupResult:
    """Return a group that moves by `depth` (m) and back; with a face of 0.2 m where it has a lower edge."""
    return GroupResult(
        name=name,
        kind=kind,
        parts=(name,),
        mass=1.0,
        momentum=scaled(3.0),
        displacement=scaled(depth),
        low=low,
        high=None if low is None else low + 0.2,
        position=None if low is None else 0.02,
        slope=0.0 if low is not None else None,
    )


def self_check(key: str, **figures: object) -> SelfCheck:
    """Return a self-check of 45 ms."""
    return SelfCheck.model_validate(
        {"id": key, "title": TITLES[key], "start": 0.0, "interval": 1e-3, "until": 0.045, **figures}
    )


def path(name: str, force: float, depth: float, *, contact: bool = False, sheet: bool = False) -> PathResult:
    """Return a load path of a half sine; a sheet, a contact without a law, or a spring that unloads."""
    source, _, target = name.partition(" – ")
    law = LawResult(
        shortening=(0.0, 0.5 * depth, depth),
        force=(0.0, 0.4 * force, force),
        unloading=4 * force / max(depth, 1e-3),
        residual=0.2,
        permanent_set=0.3,
        damping=50.0,
        tension=False,
        misfit_percent=3.0,
        unloaded=True,
    )
    laid = SheetResult(
        progress=(0.0, depth),
        shortening=(0.0, depth),
        force=(0.0, force),
        shares=(1.0,),
        back_shortening=(0.0,),
        back_force=(0.0,),
        stiffness=1e4,
        damping=20.0,
        misfit_percent=5.0,
    )
    return PathResult(
        name=name,
        source=source,
        target=target,
        known_by="recorded contact",
        impulse=scaled(10.0),
        force=scaled(force),
        shortening=scaled(0.0 if contact else depth),
        recorded_force=scaled(1.01 * force),
        force_error_percent=1.0,
        closures=(ClosureResult(title="whole", residual=0.1, impulse=20.0, percent=0.5),),
        law=None if contact or sheet else law,
        sheet=laid if sheet else None,
        peak_force=force,
        peak_time=0.0225,
    )


def group_check(name: str, depth: float, error: float, *, contact: float = 0.0) -> GroupCheck:
    """Return a group that moves by a share too much, and of a face what pressed on it."""
    more = (
        {
            "impulse": 22.0,
            "run_impulse": 20.0,
            "work": 40.0,
            "run_work": 38.0,
            "force": scaled(contact),
            "force_peak": contact,
            "run_force_peak": 1.1 * contact,
            "force_rms_percent": 0.01 * contact,
        }
        if contact
        else {}
    )
    return GroupCheck(
        name=name,
        peak=depth * (1 + error),
        run_peak=depth,
        rms_percent=100 * abs(error),
        displacement=scaled(depth * (1 + error)),
        **more,
    )


def channel_check(name: str, peak: float, error: float) -> ChannelCheck:
    """Return a channel of the leg whose model is wrong by a share."""
    return ChannelCheck(
        name=name,
        peak=peak * (1 + error),
        run_peak=peak,
        time=0.022,
        run_time=0.0225,
        error_percent=100 * error,
        rms_percent=100 * abs(error),
        values=scaled(peak * (1 + error)),
        run_values=scaled(peak),
        start=0.0,
        interval=1e-3,
    )


def path_check(name: str, force: float, depth: float, error: float) -> PathCheck:
    """Return a spring that was pushed by a share too far."""
    own = 1 + error
    return PathCheck(
        name=name,
        peak=force * own,
        run_peak=force,
        largest=depth * own,
        run_largest=depth,
        impulse=10.0 * own,
        run_impulse=10.0,
        absorbed=30.0 * own,
        run_absorbed=30.0,
        shortening=scaled(depth * own),
        force=scaled(force * own),
    )


def motion() -> FrontMotion:
    """Return a leg and the three groups in motion; a millimetre lies between run and model."""

    def line(name: str, kind: str, points: list[tuple[float, float]], depth: float) -> MovingLine:
        sides = [
            [[(round(x + depth * push + lag, 5), z) for x, z in points] for push in PUSH]
            for lag in (0.0, 0.001)
        ]
        colours = [[100 * push] * (len(points) - 1) for push in PUSH] if kind == "leg" else []
        return MovingLine(
            name=name,
            kind=kind,  # of the three words
            run=sides[0],
            model=sides[1],
            run_moments=colours,
            model_moments=colours,
        )

    return FrontMotion(
        times=TIMES,
        lines=(
            line("leg", "leg", [(-0.06, 0.1), (-0.06, 0.5), (-0.06, 1.0)], 0.1),
            line("F1", "face", [(0.02, 0.2), (0.02, 0.4)], 0.06),
            line("F2", "face", [(0.02, 0.4), (0.02, 0.6)], 0.08),
            line("E1", "inside", [(0.1, 0.45), (0.2, 0.45)], 0.01),
        ),
    )


def extraction() -> ExtractionResult:
    """Return the extraction, with its id and with the digits that a file keeps."""
    found = ExtractionResult(
        case="made-up-front",
        title="A made-up front <of two faces>",
        start=0.0,
        interval=1e-3,
        count=COUNT,
        smoothing=0.0,
        groups=(
            group("leg", "impactor", None, 0.1),
            group("F1", "fascia", 0.2, 0.06),
            group("F2", "fascia", 0.4, 0.08),
            group("E1", "engine room", None, 0.01),
        ),
        paths=(
            path("leg – F1", 1000.0, 0.0, contact=True),
            path("leg – F2", 3000.0, 0.0, contact=True),
            path("F1 – F2", 500.0, 0.02, sheet=True),
            path("F2 – E1", 2500.0, 0.07),
            path("E1 – ground", 2400.0, 0.01),
        ),
        vehicle="made-up-front",
        material=None,
        warnings=("F1 – F2: its force repeats the run's only within 16 % rms",),
        notes=(),
        inputs={"case.yaml": "ab" * 32},
        checks=(
            self_check(
                "front alone",
                groups=(group_check("F2", 0.08, 0.12), group_check("F1", 0.06, 0.05)),
                mean_percent=8.5,
                worst_percent=12.0,
                within=True,
            ),
            self_check(
                "leg alone",
                channels=(channel_check("T1", 300.0, -0.05), channel_check("MCL", 0.02, 0.02)),
            ),
            self_check(
                "contact alone",
                groups=(
                    group_check("F2", 0.08, 0.0, contact=2900.0),
                    group_check("F1", 0.06, 0.0, contact=1300.0),
                ),
                force_percent=4.0,
                impulse_percent=2.0,
                wrong_group_percent=5.0,
            ),
            self_check(
                "coupled",
                groups=(
                    group_check("F2", 0.08, 0.2, contact=3300.0),
                    group_check("F1", 0.06, 0.1, contact=1100.0),
                    group_check("E1", 0.01, 0.3),
                ),
                channels=(
                    channel_check("T1", 300.0, 0.09),
                    channel_check("F1", 250.0, 0.04),
                    channel_check("MCL", 0.02, 0.03),
                ),
                mean_percent=15.0,
                worst_percent=20.0,
                force_percent=5.0,
                impulse_percent=1.0,
                rebound_percent=-2.0,
                wrong_group_percent=7.0,
                within=True,
                paths=(
                    path_check("F1 – F2", 500.0, 0.02, 0.05),
                    path_check("F2 – E1", 2500.0, 0.07, 0.2),
                    path_check("E1 – ground", 2400.0, 0.01, -0.1),
                ),
            ),
        ),
        motion=motion(),
    ).with_id()
    return ExtractionResult.from_json(found.to_json())
