"""The page of a campaign: the car's front with its points, the table, prediction against verification."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.campaign_view import CampaignView
from certkit.reporting.charts.car_front import car_front
from certkit.reporting.charts.lines import Line, lines_chart
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.static_page import static_page
from certkit.reporting.templating import text

if TYPE_CHECKING:
    from certkit.documents.campaign_report import CampaignReport
    from certkit.reporting.svg import Drawing


def campaign_page(document: CampaignReport, spoken: str = ENGLISH) -> str:
    """Return the page."""
    shown = worded(document, spoken) if spoken != ENGLISH else document
    view = CampaignView(shown, language(spoken))
    return static_page(
        "campaign.html.j2",
        document.title,
        spoken=spoken,
        more_style=text("styles/campaign.css"),
        doc=shown,
        view=view,
        fronts=[car_front(view, scheme) for scheme in shown.schemes],
        profile=profile(view),
    )


def profile(view: CampaignView) -> Drawing | None:
    """Draw each criterion's share of its limit over the place across the car; None with too few points."""
    places: dict[str, list[tuple[float, float]]] = {head.id: [] for head in view.criteria}
    for row in view.points:
        for each in row.judged[0].criteria:
            if each.percent is not None:
                places[each.id].append((row.point.across, each.percent))
    lines: list[Line] = [
        (name, [x for x, _ in found], [y for _, y in found])
        for name, found in places.items()
        if len(found) > 1
    ]
    if not lines:
        return None
    return lines_chart(
        lines,
        view.t("Share of the limit of {scheme}; 100 % is the limit", scheme=view.short(view.first)),
        view.t("mm from the middle"),
        "%",
        width=900,
    )
