"""The verdict over a campaign: the worst of its schemes that gate, and of the agreement asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.verdicts import worst
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.campaign_report import AgreementRow, JudgedScheme
    from certkit.documents.result import Verdict


def car_verdict(
    schemes: Sequence[JudgedScheme], rows: Sequence[AgreementRow], tolerance: float | None
) -> tuple[Verdict, list[Reason]]:
    """Return the worst of what gates, and what a reader should know of it."""
    verdicts: list[Verdict] = [each.verdict for each in schemes if each.verdict is not None]
    remarks = []
    outside = [row for row in rows if row.within is False]
    if tolerance is not None and not rows:
        verdicts.append("not evaluated")
        remarks.append(Reason.of("agreement-without-points"))
    elif tolerance is not None:
        verdicts.append("fail" if outside else "pass")
    if outside:
        far = max(outside, key=lambda row: abs(row.error_percent))
        remarks.append(
            Reason.of(
                "predictions-off",
                outside=len(outside),
                count=len(rows),
                tolerance=tolerance or 0.0,
                criterion=far.criterion,
                point=far.point,
                error=far.error_percent,
            )
        )
    if not verdicts:
        remarks.append(Reason.of("campaign-without-gate"))
    return worst(verdicts), remarks
