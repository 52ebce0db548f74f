"""The section on the vehicle: what is recovered from finite-element histories, and what the leg then does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import certkit
from certkit.definitions.loading.library import load
from certkit.definitions.loading.search_path import shipped_root
from certkit.identification.five_steps import extract
from docs.make.markdown import signed, table

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.documents.self_check import ChannelCheck, SelfCheck
    from certkit.identification import ExtractionResult

CASES = ("bumper-reference", "bumper-compliant-beam", "bumper-rate-dependent-foam", "bumper-local-crush")


def bumpers_table(tell: Callable[[str], None]) -> str:
    """Extract the four bumpers and return how well their curves are known."""
    rows = []
    for name in CASES:
        tell(f"extract {name}")
        result = _extract(name)
        path = next(path for path in result.paths if path.name == "fascia – beam")
        rows.append(
            (
                f"`{name}`",
                f"{path.peak_force:.0f} N",
                f"{max(closure.percent for closure in path.closures):.2f} %" if path.closures else "–",
                f"{path.law.misfit_percent:.1f} %" if path.law else "–",
                _against_material(result),
            )
        )
    heads = (
        "case",
        "peak force",
        "closure of the impulse",
        "law against history",
        "stress–strain against the material",
    )
    return table(heads, rows)


def _against_material(result: ExtractionResult) -> str:
    material = result.material
    if material is None or material.rms_percent is None or material.mean_percent is None:
        return "refused: the block is not crushed evenly"
    return f"{material.rms_percent:.1f} % ({signed(material.mean_percent)} % in the mean)"


def _extract(name: str) -> ExtractionResult:
    case = shipped_root() / "examples" / "extract" / name / "case.yaml"
    loaded = load("case", case)
    return extract(loaded.document, case.parent, case_folder=case.parent)


FRONT = "front1"
SCATTER = {
    "T1": (4.3, 5.0, 0.4),
    "T2": (4.3, 5.7, -1.2),
    "T3": (3.8, 3.8, -0.1),
    "T4": (2.4, 4.0, 0.4),
    "F1": (2.7, 5.1, 0.4),
    "F2": (3.9, 4.1, 0.0),
    "F3": (5.5, 6.4, -1.5),
    "MCL": (1.8, 4.2, -2.8),
    "ACL": (2.4, 6.0, -3.4),
    "PCL": (1.3, 3.0, -1.8),
}
"""Of the finite-element run's own peaks: standard deviation under changes that should not matter, change with
half the element size (%), and by how much that makes them later (ms); see `references/fe-front.yaml` and
`REPORT_FRONT1.md` of the example."""


def front_checks(tell: Callable[[str], None]) -> dict[str, SelfCheck]:
    """Extract the front of fourteen groups and hold it to its run."""
    tell(f"extract {FRONT}")
    case = shipped_root() / "examples" / "extract" / FRONT / "case.yaml"
    return {check.id: check for check in certkit.extract(case).checks}


def channels_table(checks: dict[str, SelfCheck]) -> str:
    """Return the leg's channels in the run, in the coupled model, and of the leg alone."""
    alone = {channel.name: channel for channel in checks["leg alone"].channels}
    rows = []
    for channel in sorted(checks["coupled"].channels, key=lambda c: c.name):
        scale, unit = (1e3, "mm") if channel.name.endswith("CL") else (1.0, "N·m")
        leg = alone[channel.name]
        deviation, mesh, later = SCATTER[channel.name]
        first, last = _on_top(channel, deviation)
        rows.append(
            (
                channel.name,
                f"{scale * channel.run_peak:.1f} {unit} at {1e3 * channel.run_time:.1f} ms",
                f"{signed(channel.error_percent)} %",
                f"{signed(1e3 * (channel.time - channel.run_time))} ms",
                f"{channel.rms_percent:.1f} %",
                f"{signed(leg.error_percent)} %",
                f"{signed(1e3 * (leg.time - leg.run_time))} ms",
                f"{leg.rms_percent:.1f} %",
                f"{deviation:.1f} / {mesh:.1f} %",
                f"{signed(later)} ms",
                f"{1e3 * first:.1f} to {1e3 * last:.1f} ms",
            )
        )
    heads = (
        "channel",
        "finite elements",
        "peak",
        "later by",
        "curve, rms",
        "leg alone: peak",
        "later by",
        "curve, rms",
        "scatter / mesh",
        "mesh: later by",
        "within its scatter of the peak",
    )
    return table(heads, rows)


def _on_top(channel: ChannelCheck, percent: float) -> tuple[float, float]:
    """Return from when to when the run's curve is within a share of its own peak, s."""
    start, interval = channel.start or 0.0, channel.interval or 0.0
    near = [
        k for k, value in enumerate(channel.run_values) if value >= channel.run_peak * (1 - percent / 100)
    ]
    return start + near[0] * interval, start + near[-1] * interval


def groups_table(checks: dict[str, SelfCheck]) -> str:
    """Return how the faces move, in the front alone and in the coupled model, and the impulse on them."""
    alone = {group.name: group for group in checks["front alone"].groups}
    rows = [
        (
            group.name,
            f"{1e3 * group.run_peak:.1f} mm",
            f"{1e3 * alone[group.name].peak:.1f} mm",
            f"{alone[group.name].rms_percent:.1f} %",
            f"{1e3 * group.peak:.1f} mm",
            f"{group.rms_percent:.1f} %",
            f"{group.run_impulse:.1f} N·s",
            f"{group.impulse:.1f} N·s",
        )
        for group in sorted(checks["coupled"].groups, key=lambda g: g.name)
        if group.run_impulse
    ]
    heads = (
        "face",
        "finite elements",
        "front alone",
        "rms",
        "leg and front",
        "rms",
        "impulse, finite elements",
        "leg and front",
    )
    return table(heads, rows)


def front_words(checks: dict[str, SelfCheck]) -> str:
    """Return force, impulse, rebound and movement of the coupled model in a sentence."""
    check = checks["coupled"]
    front = checks["front alone"]
    signs = (check.force_percent, check.impulse_percent, check.rebound_percent)
    force, impulse, rebound = (signed(value or 0.0) for value in signs)
    sizes = (check.wrong_group_percent, check.mean_percent, check.worst_percent)
    sizes += (front.mean_percent, front.worst_percent)
    wrong, mean, worst, mean_alone, worst_alone = (f"{value or 0.0:.1f} %" for value in sizes)
    return (
        f"Largest contact force {force} %, its impulse {impulse} %, rebound speed {rebound} %; {wrong} of "
        "the impulse acts on another group than in the run. Faces move with an error of "
        f"{mean} rms in the mean and {worst} at worst; driven by the run's own contact forces, "
        f"{mean_alone} and {worst_alone}."
    )
