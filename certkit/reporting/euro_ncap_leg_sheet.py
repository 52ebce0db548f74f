"""The leg's rows as Euro NCAP's own workbook of 2026 has them, to be pasted into it.

Layout of the sheet `CP - VRU Pelvis & Leg Impact` as `euroncap-rating-2026` 5.4.9 (package index) writes it,
crash_protection/vru_processing.py: columns, words, the rows of a test point (1 femur, 2 knee and tibia), and
T, ST and SA for a point that was tested, that mirrors one, and that takes its neighbours' larger values.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.documents.campaign_report import CampaignReport, JudgedPoint, JudgedScheme
    from certkit.reporting.workbook import Cell

SHEET = "CP - VRU Pelvis & Leg Impact"
SCHEME = "euro-ncap-2026"
HEADS = (
    *("Loadcase", "Seat position", "Dummy", "Body region", "Test point", "Criteria"),
    *("HPL", "LPL", "Capping", "OEM Prediction", "Value"),
)
REGIONS = (
    ("Femur", 1, ("F1", "F2", "F3")),
    ("Knee", 2, ("MCL",)),
    ("Tibia", 2, ("T1", "T2", "T3", "T4")),
)
PREDICTIONS = {"own": "T", "mirrored": "ST", "neighbour": "SA"}


def leg_rows(document: CampaignReport, scheme: JudgedScheme) -> list[list[Cell]]:
    """Return the rows, a region at a time; of points without a `column` of the grid there are none.

    Words that repeat those above them are left out, as in that workbook. Only tested points carry values: the
    others are inferred there.
    """
    columns = {point.name: point.column for point in document.points if point.column is not None}
    rows: list[list[Cell]] = []
    for region, number, criteria in REGIONS:
        first = True
        for judged in scheme.points:
            if judged.point not in columns or judged.basis == "none":
                continue
            place = f"({number}, {columns[judged.point]})"
            for cells in _point(judged, criteria):
                start: list[Cell] = ["Lower Leg", "Driver", "aPLI"] if not rows else [None, None, None]
                rows.append([*start, region if first else None, place, *cells])
                first = False
    return rows


def _point(judged: JudgedPoint, criteria: tuple[str, ...]) -> Iterator[list[Cell]]:
    found = {each.id: each for each in judged.criteria}
    for name in criteria:
        each = found.get(name)
        words = "MCL elongation" if name == "MCL" else f"Bending moment, {name}"
        value = each.value if each is not None and judged.basis == "own" else None
        limits = (each.full, each.limit) if each is not None else (None, None)
        yield [words, *limits, None, PREDICTIONS[judged.basis], value]
