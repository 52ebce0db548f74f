"""The folder of a campaign: its document and reports, and the report of every result behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.render_documents import render
from certkit.files import write_whole

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence
    from pathlib import Path

    from certkit.documents.campaign_report import CampaignReport
    from certkit.documents.result import Result


def write_campaign(  # noqa: PLR0913  # as many as the command has options
    document: CampaignReport,
    results: Mapping[str, Result],
    out: Path,
    formats: str | Collection[str] | None,
    *,
    language: str = "en",
    force: bool = False,
    numbered: bool = False,
    tell: Callable[[str], None] = lambda _: None,
) -> list[Path]:
    """Write a campaign; see `certkit.render`. Each source's result goes to the folder the document names.

    Returns
    -------
    list of Path
        What was written, the campaign's JSON first.
    """

    def beside(stage: Path) -> Sequence[Path]:
        from certkit.reporting.document_reports import render_document  # noqa: PLC0415  # jinja2 waits

        written = []
        for place, result in results.items():
            folder = stage / place
            folder.mkdir(parents=True, exist_ok=True)
            text = result.to_json()
            write_whole(folder / "result.json", text)
            written.append(folder / "result.json")
            written += render_document(result.from_json(text), folder, ["html"], spoken=language)
        return written

    return render(
        document,
        out,
        formats,
        language=language,
        force=force,
        numbered=numbered,
        tell=tell,
        beside=beside,
    )
