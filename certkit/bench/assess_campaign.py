"""`campaign`: all impact points of a car with their sources, judged by its schemes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from certkit._version import __version__
from certkit.bench.campaign_pages import write_campaign
from certkit.bench.point_sources import CampaignFiles, load_point_source
from certkit.bench.setup import PACKAGES
from certkit.definitions.campaign import RANK
from certkit.definitions.loading.library import load, shelves
from certkit.definitions.units import parse_quantity
from certkit.documents.campaign_report import CampaignReport, CarFront, PointReport
from certkit.documents.result import InputFile, Provenance
from certkit.documents.unverified import MARK
from certkit.documents.verdicts import worst
from certkit.errors import UsageError
from certkit.grading.judge_car import judge_car
from certkit.grading.prediction_agreement import agreement
from certkit.grading.scheme_terms import SchemeTerms

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from certkit.bench.point_sources import LoadedSource
    from certkit.definitions.campaign import Campaign, ImpactPoint, PointSource
    from certkit.definitions.loading.library import Library, Loaded
    from certkit.definitions.scheme import Scheme
    from certkit.documents.campaign_report import AgreementRow, JudgedScheme, SourceReport
    from certkit.documents.result import Result, Verdict


@dataclass(frozen=True)
class AssessedCampaign:
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
        Take results that were changed since certkit wrote them as well.
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
    shelf = (*shelves(library), path.parent)
    terms, used = _terms(sheet, shelf)
    files = CampaignFiles(sheet, path.parent, shelf, terms[0].scheme.impactor, unverified)
    points, read = [], []
    results: dict[str, Result] = {}
    for point in sheet.points:
        step(point.point)
        report, sources = _point(point, sheet, files)
        points.append(report)
        read += [each.input for each in sources if each.input is not None]
        results |= {s.report.folder: s.result for s in sources if s.result is not None}
    schemes = [judge_car(each, points, symmetric=sheet.car.symmetric) for each in terms]
    criteria = {name for each in terms for name in each.criteria}
    tolerance = None if sheet.agreement is None else 100.0 * parse_quantity(sheet.agreement, "ratio")
    rows = agreement(points, criteria, tolerance)
    verdict, remarks = _verdict(schemes, rows, tolerance)
    changed = [f"{p.name} ({s.label})" for p in points for s in p.sources if s.certificate == MARK]
    if changed:
        remarks.append(f"{MARK}: changed since certkit wrote it: {', '.join(changed)}")
    document = CampaignReport(
        campaign=sheet.campaign,
        title=sheet.title,
        verdict=verdict,
        car=_car(sheet),
        schemes=schemes,
        points=points,
        agreement=rows,
        tolerance_percent=tolerance,
        remarks=remarks,
        notes=sheet.notes,
        provenance=Provenance(
            certkit=__version__,
            inputs=[_definition(each) for each in (loaded, *used)] + read,
            packages={name: version(name) for name in PACKAGES},
        ),
    )
    return AssessedCampaign(document.with_id(), results)


def _terms(sheet: Campaign, library: Library) -> tuple[list[SchemeTerms], list[Loaded[Any]]]:
    """Load the schemes and corridor sets that a campaign names."""
    used: dict[tuple[str, str], Loaded[Any]] = {}
    terms = []
    for name in sheet.schemes:
        terms.append(_scheme(name, library, used, at_least=sheet.at_least.get(name)))
        if name in sheet.at_least and not terms[-1].car_points:
            raise UsageError(f"`at least`: the scheme {name} has no rule for a total; leave it out")
    if sheet.targets is not None:
        target = sheet.targets
        own = _scheme(target.of, library, used)
        if own.scheme.limits is None:
            raise UsageError(f"`targets` are shares of limits; the scheme {target.of} has none")
        shares = {name: parse_quantity(text, "ratio") for name, text in target.criteria.items()}
        share = parse_quantity(target.share, "ratio")
        terms.append(SchemeTerms(own.scheme, own.corridors, share, shares, own_targets=True))
    impactors = list(dict.fromkeys(each.scheme.impactor for each in terms))
    if len(impactors) > 1:
        raise UsageError(
            f"the schemes are for different legforms ({', '.join(impactors)}); a campaign is of one"
        )
    _check_zones(sheet, terms)
    return terms, list(used.values())


def _scheme(
    name: str,
    library: Library,
    used: dict[tuple[str, str], Loaded[Any]],
    *,
    at_least: float | None = None,
) -> SchemeTerms:
    scheme = load("scheme", name, library=library)
    document = cast("Scheme", scheme.document)
    corridors = load("corridors", document.corridors, library=library)
    used |= {("scheme", name): scheme, ("corridors", corridors.name): corridors}
    return SchemeTerms(document, corridors.document, at_least=at_least)


def _check_zones(sheet: Campaign, terms: Sequence[SchemeTerms]) -> None:
    """Refuse relaxed zones that no scheme knows, or that are wider together than it allows."""
    width = sum(end - start for start, end in sheet.zones)
    allowed = [each.scheme.relaxation for each in terms if each.scheme.relaxation is not None]
    if sheet.zones and not allowed:
        raise UsageError("`relaxed`: none of the schemes has relaxed limits; leave it out")
    for rule in allowed:
        if width > rule.metres + 1e-9:
            raise UsageError(
                f"`relaxed`: the zones are {1e3 * width:g} mm wide together; at most {rule.width} may be"
            )


def _point(
    point: ImpactPoint, sheet: Campaign, files: CampaignFiles
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
        folder = f"points/{_plain(point.point)}-{number}-{each.report.kind.replace(' ', '-')}"
        update = {"decides": decides, "replaced": replaced, "folder": folder if each.result else ""}
        sources.append(_updated(each, each.report.model_copy(update=update)))
    report = PointReport(
        name=point.point,
        across=1e3 * point.metres,
        height=1e3 * parse_quantity(point.height or sheet.car.bumper, "length"),
        angle=parse_quantity(point.angle, "angle") / parse_quantity("1 deg", "angle"),
        relaxed=any(start <= point.metres <= end for start, end in sheet.zones),
        sources=[each.report for each in sources],
        replacement=later.reason if later else "",
    )
    return report, sources


def _updated(source: LoadedSource, report: SourceReport) -> LoadedSource:
    return type(source)(report, source.result, source.input)


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


def _definition(loaded: Loaded[Any]) -> InputFile:
    return InputFile(role=loaded.kind, path=loaded.path, sha256=loaded.sha256, text=loaded.text)


def _verdict(
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
