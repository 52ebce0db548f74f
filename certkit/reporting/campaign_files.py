"""The reports of a campaign."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.language import ENGLISH
from certkit.reporting.named_files import Files, write_named

if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

    from certkit.documents.campaign_report import CampaignReport

CAMPAIGN_FILES: Files = {
    "csv": ("campaign.csv", "certkit.reporting.campaign_csv:campaign_csv"),
    "junit": ("junit.xml", "certkit.reporting.campaign_junit:campaign_junit"),
    "xlsx": ("campaign.xlsx", "certkit.reporting.campaign_xlsx:campaign_xlsx"),
    "pptx": ("campaign.pptx", "certkit.reporting.campaign_pptx:campaign_pptx"),
    "html": ("campaign.html", "certkit.reporting.campaign_page:campaign_page"),
}


def render_campaign(
    document: CampaignReport, out: Path, formats: Collection[str], *, spoken: str = ENGLISH
) -> list[Path]:
    """Write the wanted reports, and return what was written."""
    return write_named(document, out, formats, CAMPAIGN_FILES, spoken)
