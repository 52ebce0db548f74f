"""A campaign as a table: one line a point, source and criterion, for whoever works on with it."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

from certkit.exchange.csv_cells import harmless

if TYPE_CHECKING:
    from certkit.documents.campaign_report import CampaignReport

HEADS = (
    *("point", "across [mm]", "height [mm]", "angle [deg]", "source", "label", "decides", "replaced"),
    *("criterion", "value", "unit"),
)


def campaign_csv(document: CampaignReport) -> str:
    """Return every value of every source, and behind it what each scheme says of the ones that decide."""
    stream = io.StringIO()
    table = csv.writer(stream, lineterminator="\n")
    names = [f"{scheme.scheme} ({scheme.kind})" for scheme in document.schemes]
    table.writerow(
        [*HEADS, *(f"{name} [%]" for name in names), *(f"{name} verdict or share" for name in names)]
    )
    for point in document.points:
        rows = [next(row for row in scheme.points if row.point == point.name) for scheme in document.schemes]
        for source in point.sources:
            for value in source.values:
                judged = [
                    next((c for c in row.criteria if c.id == value.id), None)
                    if source.decides and row.basis == "own"
                    else None
                    for row in rows
                ]
                table.writerow(
                    [
                        harmless(point.name),
                        *(f"{each:.7g}" for each in (point.across, point.height, point.angle)),
                        source.kind,
                        harmless(source.label),
                        "yes" if source.decides else "no",
                        "yes" if source.replaced else "no",
                        harmless(value.id),
                        "" if value.value is None else f"{value.value:.7g}",
                        value.unit,
                        *("" if c is None or c.percent is None else f"{c.percent:.4g}" for c in judged),
                        *(
                            "" if c is None else c.verdict or f"{c.share if c.share is not None else 0:.4g}"
                            for c in judged
                        ),
                    ]
                )
    return stream.getvalue()
