"""The section on the vehicle: what is recovered from finite-element histories, and what the leg then does."""

from __future__ import annotations

from typing import TYPE_CHECKING

import certkit
from certkit.definitions.loading.library import load
from certkit.definitions.loading.search_path import shipped_root
from certkit.identification.five_steps import extract
from docs.make.markdown import figure, signed, table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from certkit.documents.comparison import Overlay
    from certkit.documents.result import Comparison, Result
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


def peaks_table(comparison: Comparison) -> str:
    """Return the finite-element run's peaks beside those of the extracted front."""
    rows = [
        (
            row.channel,
            figure(row.test),
            figure(row.simulation),
            row.unit,
            f"{signed(row.error_percent)} %",
        )
        for row in comparison.rows
    ]
    return table(("channel", "finite elements", "lumped front", "unit", "error"), rows)


UNTIL = 0.044
"""Later the leg hardly touches the front, s."""


def first_peaks_table(lumped: Result) -> str:
    """Return the tibia's first peaks, and when they come, beside those of the finite-element run."""
    run = shipped_root() / "examples" / "extract" / "front1" / "fe-run.csv"
    document = certkit.compare(run, lumped, until=UNTIL)
    rows = []
    for overlay in document.overlays:
        if not overlay.channel.startswith("T"):
            continue
        (a, at_a), (b, at_b) = (_peak(curve, overlay) for curve in (overlay.reference, overlay.other))
        rows.append(
            (
                overlay.channel,
                f"{figure(a)} at {at_a:.1f} ms",
                f"{figure(b)} at {at_b:.1f} ms",
                f"{signed((b - a) / a * 100)} %",
                f"{signed(at_b - at_a)} ms",
            )
        )
    heads = ("peak up to 44 ms after contact, N·m", "finite elements", "lumped front", "error", "later by")
    return table(heads, rows)


def _peak(values: Sequence[float], overlay: Overlay) -> tuple[float, float]:
    """Return the largest value and its time in ms."""
    most = max(range(len(values)), key=values.__getitem__)
    return values[most], (overlay.start + most * overlay.interval) * 1e3
