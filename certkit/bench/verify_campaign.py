"""Checks of a campaign: judged again by the schemes that it carries, and the results beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from msgspec.structs import replace

from certkit.bench.campaign_schemes import campaign_schemes
from certkit.bench.compare_documents import differences
from certkit.bench.regrade import embedded_store
from certkit.bench.verification import Check, fails, holds, unchecked
from certkit.bench.verify_document import input_checks
from certkit.bench.verify_reports import report_checks
from certkit.definitions.loading.library import load
from certkit.documents.result import Result
from certkit.errors import CertkitError
from certkit.grading.car_verdict import car_verdict
from certkit.grading.judge_car import judge_car
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from certkit.definitions.campaign import Campaign
    from certkit.definitions.loading.search_path import TextStore
    from certkit.documents.campaign_report import CampaignReport, SourceReport


def campaign_checks(
    folder: Path, document: CampaignReport, content_checks: Callable[[Result], list[Check]]
) -> Iterator[Check]:
    """Check what a campaign carries, that its judgement follows from its points, and the results beside it.

    Parameters
    ----------
    folder : Path
        That the document lies in.
    document : CampaignReport
    content_checks : callable
        Checks of what a result says: grades it again and so on.
    """
    yield from input_checks("campaign", document.provenance)
    yield _judged_again(document, embedded_store(document.provenance))
    for point in document.points:
        for source in point.sources:
            if source.folder:
                what = f"point {point.name}: {source.kind}"
                yield from _beside(folder, what, source, content_checks)


def _judged_again(document: CampaignReport, store: TextStore) -> Check:
    what = "campaign: judged again"
    try:
        sheet = cast("Campaign", load("campaign", document.campaign, library=(store,)).document)
        terms, _ = campaign_schemes(sheet, (store,))
        made = [worded(judge_car(each, document.points, symmetric=sheet.car.symmetric)) for each in terms]
    except CertkitError as error:
        return fails(what, "not-judgeable", error=str(error))
    verdict, _ = car_verdict(made, document.agreement, document.tolerance_percent)
    found = [
        *differences(document.schemes, made, "schemes"),
        *differences(document.verdict, verdict, "verdict"),
    ]
    if found:
        first = found[0]
        return fails(what, "judged-otherwise", place=first.place, said=first.said, made=first.made)
    return holds(what)


def _beside(
    folder: Path, what: str, source: SourceReport, content_checks: Callable[[Result], list[Check]]
) -> Iterator[Check]:
    """Check that the result behind a source is the one that is named, that it holds, and its values."""
    path = folder / source.folder / Result.file_name
    if not path.is_file():
        yield unchecked(what, "point-result-missing")
        return
    result = Result.read(path)
    made = result.content_id()
    if source.certificate not in {made, result.id} or made != result.id:
        yield fails(what, "point-result-differs", said=source.certificate, made=made)
        return
    differ = (
        fails(what, "point-value-differs", said=f"{value.id} {value.value:g}", made=str(real))
        for value in source.values
        for real in [result.criteria[value.id].value if value.id in result.criteria.ids else None]
        if value.value is not None and value.value != real
    )
    yield next(differ, holds(what))
    for each in (*report_checks(path.parent, result), *content_checks(result)):
        yield replace(each, what=f"{what}: {each.what}")
