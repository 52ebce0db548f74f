"""The reports of a campaign: which format becomes which file."""

from __future__ import annotations

from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING

from certkit.errors import MissingPartError
from certkit.files import write_whole
from certkit.reporting.left_out import leave_out

if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

    from certkit.documents.campaign_report import CampaignReport

CAMPAIGN_FILES = MappingProxyType(
    {
        "csv": ("campaign.csv", "certkit.reporting.campaign_csv:campaign_csv"),
        "junit": ("junit.xml", "certkit.reporting.campaign_junit:campaign_junit"),
        "xlsx": ("campaign.xlsx", "certkit.reporting.campaign_xlsx:campaign_xlsx"),
        "pptx": ("campaign.pptx", "certkit.reporting.campaign_pptx:campaign_pptx"),
        "html": ("campaign.html", "certkit.reporting.campaign_page:campaign_page"),
    }
)
"""Name of the file of each format, and the function that returns its content."""


def render_campaign(document: CampaignReport, out: Path, formats: Collection[str]) -> list[Path]:
    """Write the wanted reports into a folder, and return what was written."""
    written = []
    for name, (file, home) in CAMPAIGN_FILES.items():
        if name in formats:
            module, _, function = home.partition(":")
            try:
                content = getattr(import_module(module), function)(document)
            except MissingPartError as error:
                leave_out(file, error)
                continue
            write_whole(out / file, content)
            written.append(out / file)
    return written
