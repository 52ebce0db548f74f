"""The verdict over a campaign: the worst of its schemes that gate, and of the agreement asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.verdicts import worst

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.campaign_report import AgreementRow, JudgedScheme
    from certkit.documents.result import Verdict


def car_verdict(
    schemes: Sequence[JudgedScheme], rows: Sequence[AgreementRow], tolerance: float | None
) -> tuple[Verdict, list[str]]:
    """Return the worst of what gates, and what a reader should know of it."""
    verdicts: list[Verdict] = [each.verdict for each in schemes if each.verdict is not None]
    remarks = []
    outside = [row for row in rows if row.within is False]
    if tolerance is not None and not rows:
        verdicts.append("not evaluated")
        remarks.append("no point was both predicted and measured, so that their agreement cannot be judged")
    elif tolerance is not None:
        verdicts.append("fail" if outside else "pass")
    if outside:
        far = max(outside, key=lambda row: abs(row.error_percent))
        remarks.append(
            f"{len(outside)} of {len(rows)} predictions are more than {tolerance:g} % off, the farthest "
            f"{far.criterion} at {far.point} by {far.error_percent:+.1f} %"
        )
    if not verdicts:
        remarks.append(
            "no scheme here has limits, and no points are asked for: say `at least` to have a gate"
        )
    return worst(verdicts), remarks
