"""`campaign`: all impact points of a car with their sources, judged by its schemes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, cast

from msgspec import Struct
from msgspec.structs import replace

from certkit._version import __version__
from certkit.bench.campaign_pages import write_campaign
from certkit.bench.campaign_schemes import campaign_schemes
from certkit.bench.package_versions import package_versions
from certkit.bench.point_sources import CampaignFiles, load_point_source
from certkit.bench.result_folder import distinct_names
from certkit.bench.setup import input_file
from certkit.definitions.campaign import RANK
from certkit.definitions.loading.library import load, stores
from certkit.definitions.units import parse_quantity
from certkit.documents.campaign_report import CampaignReport, CarFront, PointReport
from certkit.documents.result import Provenance
from certkit.documents.unverified import MARK
from certkit.grading.car_verdict import car_verdict
from certkit.grading.judge_car import judge_car
from certkit.grading.prediction_agreement import agreement
from certkit.reasons import Reason
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from certkit.bench.point_sources import LoadedSource
    from certkit.definitions.campaign import Campaign, ImpactPoint, PointSource
    from certkit.definitions.loading.library import Library
    from certkit.documents.result import Result


class AssessedCampaign(Struct, frozen=True):
    """The document, and the result behind each source by the folder that the document names for it."""

    document: CampaignReport
    results: dict[str, Result]


def campaign(
    car: str | Path,
    out: str | Path | None = None,
    formats: str | Collection[str] | None = None,
    *,
    library: Library = (),
    unverified: bool = False,
    force: bool = False,
    step: Callable[[str], None] = lambda _: None,
) -> CampaignReport:
    """Judge a car by its impact points, and write the document with its page where a folder is named.

    Parameters
    ----------
    car : str or Path
        The campaign's file; its paths are meant from its folder.
    out : str or Path, optional
        Folder for the document, its reports, and the report of every point under `points/`.
    formats : str or collection of str, optional
        As for `certkit.render`: `html` when not given.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first; those beside the campaign's file come next.
    unverified : bool
        Take results that were changed since certkit wrote them as well, also those that come to other values
        when they are graded again.
    force : bool
        Replace another campaign in the folder.
    step : callable
        Told each point before it is read or simulated.

    Raises
    ------
    DefinitionError, UsageError
        When the campaign, a scheme or a procedure cannot be used.
    DataError
        When a source cannot: names its point.
    """
    found = assess(car, library=library, unverified=unverified, step=step)
    if out is not None:
        write_campaign(found.document, found.results, Path(out), formats, force=force)
    return found.document


def assess(
    car: str | Path,
    *,
    library: Library = (),
    unverified: bool = False,
    step: Callable[[str], None] = lambda _: None,
) -> AssessedCampaign:
    """Do as `campaign`, without writing anything."""
    path = Path(car)
    loaded = load("campaign", path, library=library)
    sheet = cast("Campaign", loaded.document)
    store = (*stores(library), path.parent)
    terms, used = campaign_schemes(sheet, store)
    files = CampaignFiles(sheet, path.parent, store, terms[0].scheme.impactor, unverified)
    points, read = [], []
    results: dict[str, Result] = {}
    folders = distinct_names([(_plain(point.point), "") for point in sheet.points])
    for point, folder in zip(sheet.points, folders, strict=True):
        step(point.point)
        report, sources = _point(point, folder, sheet, files)
        points.append(report)
        read += [item for each in sources for item in each.inputs]
        results |= {s.report.folder: s.result for s in sources if s.result is not None}
    schemes = [judge_car(each, points, symmetric=sheet.car.symmetric) for each in terms]
    criteria = {name for each in terms for name in each.criteria}
    tolerance = None if sheet.agreement is None else 100.0 * parse_quantity(sheet.agreement, "ratio")
    rows = agreement(points, criteria, tolerance)
    verdict, remarks = car_verdict(schemes, rows, tolerance)
    changed = [f"{p.name} ({s.label})" for p in points for s in p.sources if s.certificate == MARK]
    if changed:
        remarks.append(Reason.of("point-results-changed", mark=MARK, points=changed))
    bare = {place for place, result in results.items() if result.channels is None}
    taken = [f"{p.name} ({s.label})" for p in points for s in p.sources if s.folder in bare]
    if taken:
        remarks.append(Reason.of("point-results-without-channels", points=taken))
    document = CampaignReport(
        campaign=sheet.campaign,
        title=sheet.title,
        verdict=verdict,
        car=_car(sheet),
        schemes=schemes,
        points=points,
        agreement=rows,
        tolerance_percent=tolerance,
        coded_remarks=remarks,
        notes=sheet.notes,
        provenance=Provenance(
            certkit=__version__,
            inputs=[input_file(each) for each in (loaded, *used)] + read,
            packages=dict(package_versions()),
        ),
    )
    return AssessedCampaign(worded(document).with_id(), results)


def _point(
    point: ImpactPoint, name: str, sheet: Campaign, files: CampaignFiles
) -> tuple[PointReport, list[LoadedSource]]:
    later = next((each for each in sheet.replace if each.point == point.point), None)
    given: list[tuple[PointSource, bool]] = [(source, later is not None) for source in point.sources]
    given += [(source, False) for source in later.sources] if later else []
    loaded = [(load_point_source(source, files, point.point), replaced) for source, replaced in given]
    current = [each.report.kind for each, replaced in loaded if not replaced]
    decisive = next((kind for kind in RANK if kind in current), None)
    sources, taken = [], set()
    for number, (each, replaced) in enumerate(loaded, 1):
        decides = not replaced and each.report.kind == decisive and decisive not in taken
        taken |= {each.report.kind} if decides else set()
        folder = f"points/{name}-{number}-{each.report.kind.replace(' ', '-')}"
        update = {"decides": decides, "replaced": replaced, "folder": folder if each.result else ""}
        sources.append(replace(each, report=each.report.model_copy(update=update)))
    report = PointReport(
        name=point.point,
        across=1e3 * point.metres,
        height=1e3 * parse_quantity(point.height or sheet.car.bumper, "length"),
        angle=parse_quantity(point.angle, "angle") / parse_quantity("1 deg", "angle"),
        column=point.column,
        relaxed=any(start <= point.metres <= end for start, end in sheet.zones),
        sources=[each.report for each in sources],
        replacement=later.reason if later else "",
    )
    return report, sources


def _plain(name: str) -> str:
    """Return a point's name as a folder's: `L+2` is `L+2`, anything that leads elsewhere is not."""
    return re.sub(r"[^A-Za-z0-9+-]+", "_", name) or "_"


def _car(sheet: Campaign) -> CarFront:
    car = sheet.car
    width, height, edge, bumper = (
        1e3 * parse_quantity(each, "length") for each in (car.width, car.height, car.bonnet_edge, car.bumper)
    )
    area = None
    if car.test_area is not None:
        low, high = (1e3 * parse_quantity(each, "length") for each in car.test_area)
        area = (low, high)
    return CarFront(
        name=car.name,
        width=width,
        height=height,
        bonnet_edge=edge,
        bumper=bumper,
        test_area=area,
        zones=[(1e3 * start, 1e3 * end) for start, end in sheet.zones],
        symmetric=car.symmetric,
    )
