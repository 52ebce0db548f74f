"""Debian's Chromium through Playwright, on pages written to a folder and opened as files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from support import synthetic_campaign, synthetic_extraction, synthetic_result

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

CHROMIUM = Path("/usr/bin/chromium")


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Start the browser once."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if not CHROMIUM.exists():
        pytest.skip(f"{CHROMIUM} is not installed")
    try:
        running = playwright.sync_playwright().start()
    except Exception as error:  # noqa: BLE001  # the driver's own words for a missing library
        pytest.skip(f"Playwright's driver does not start ({error}); it needs the system's libatomic1")
    chromium = running.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox"])
    yield chromium
    chromium.close()
    running.stop()


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the pages that all tests look at."""
    from certkit.reporting.campaign_page import campaign_page  # noqa: PLC0415  # likewise
    from certkit.reporting.extraction_report import extraction_page  # noqa: PLC0415  # likewise
    from certkit.reporting.html_report import page, suite_page  # noqa: PLC0415  # the browser tests alone need it
    from certkit.reporting.result_view import unique_views, view  # noqa: PLC0415  # likewise

    place = tmp_path_factory.mktemp("pages")
    results = {
        "pendulum": synthetic_result.result(),
        "static": synthetic_result.static_result(),
        "measured": synthetic_result.laboratory_result(),
    }
    for name, result in results.items():
        (place / f"{name}.html").write_text(page(view(result)))
    (place / "suite.html").write_text(suite_page(unique_views(list(results.values()))))
    (place / "campaign.html").write_text(campaign_page(synthetic_campaign.campaign()))
    (place / "extraction.html").write_text(extraction_page(synthetic_extraction.extraction()))
    return place
