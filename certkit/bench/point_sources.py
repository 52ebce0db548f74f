"""One source of an impact point's values: a measured test, a run, a simulation made here, or named values."""

from __future__ import annotations

from hashlib import sha256
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.bench.grade_measurement import grade
from certkit.bench.graded_again import wrong_values
from certkit.bench.regrade import embedded_channels
from certkit.bench.results_at_path import result_at
from certkit.bench.run_simulation import run
from certkit.definitions.units import UNITS, dimensions, from_si, parse_quantity
from certkit.documents.campaign_report import PointValue, SourceReport
from certkit.documents.result import InputFile, Result
from certkit.documents.unverified import MARK, is_marked, marked
from certkit.documents.verdicts import worst
from certkit.errors import DataError, DefinitionError, InputError, RunError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.definitions.campaign import Campaign, PointSource
    from certkit.definitions.loading.library import Library
    from certkit.documents.result import CriterionResult


class CampaignFiles(Struct, frozen=True):
    """Where a campaign's paths lead.

    Parameters
    ----------
    campaign : Campaign
    folder : Path
        Of its file.
    library : Library
        Folders with own definitions, the campaign's own among them.
    impactor : str
        That its schemes are for.
    unverified : bool
        Whether changed results are taken.
    """

    campaign: Campaign
    folder: Path
    library: Library
    impactor: str
    unverified: bool = False


class LoadedSource(Struct, frozen=True):
    """A source with the result it stands on, if any, and the files that were read."""

    report: SourceReport
    result: Result | None = None
    inputs: tuple[InputFile, ...] = ()


def load_point_source(source: PointSource, files: CampaignFiles, point: str) -> LoadedSource:
    """Read, grade or simulate one source of a point.

    A simulation that does not finish makes the source unusable; it does not take the other points with it.

    Raises
    ------
    InputError
        When a file or definition cannot be used: names the point.
    """
    if source.predicted is not None:
        values = [_predicted(name, text) for name, text in source.predicted.items()]
        return LoadedSource(SourceReport(kind="predicted", label=source.by or "the maker", values=values))
    try:
        if source.lumped is not None:
            return _lumped(source, files)
        return _from_file(source, files)
    except DefinitionError:
        raise  # each of its problems says its own place
    except InputError as error:
        raise DataError(f"point {point}: {error}") from error


def _lumped(source: PointSource, files: CampaignFiles) -> LoadedSource:
    procedure = source.lumped or ""
    label = source.by or procedure
    changes = {path: str(value) for path, value in source.set.items()}
    try:
        result = run(_named(procedure, files), library=files.library, overrides=changes)
    except RunError as error:
        told = Reason.of("simulation-unfinished", error=str(error))
        return LoadedSource(
            SourceReport(
                kind="lumped", label=label, verdict="error", usable=False, coded_reason=told, changes=changes
            )
        )
    return _of_result(source, result, label, files, changes=changes)


def _from_file(source: PointSource, files: CampaignFiles) -> LoadedSource:
    path = files.folder / (source.file or "")
    found = result_at(path, unverified=files.unverified)
    document = path if found is None else Result.file_at(path)
    result = found or grade(
        _named(source.procedure or files.campaign.procedure, files),
        path,
        laboratory=None if source.laboratory is None else files.folder / source.laboratory,
        mapping=None if source.mapping is None else files.folder / source.mapping,
        library=files.library,
    )
    measured = result.kind == "test evaluation"
    if measured != (source.measured is not None):
        said = "finite elements" if measured else "measured"
        raise DataError(f"{path}: holds a {result.kind}, and stands under `{said}` in the campaign; move it")
    if found is not None:
        result = _graded_again(found, document, files)
    return _of_result(
        source, result, source.by or source.file or "", files, read=_read(source, document, result)
    )


def _graded_again(result: Result, path: Path, files: CampaignFiles) -> Result:
    """Return a result that comes to its values when it is graded again; a changed one marked, if allowed."""
    faults = [] if is_marked(result) else wrong_values(str(path), result)
    if not faults:
        return result
    if not files.unverified:
        raise DataError("\n".join(faults))
    return marked(result)


def _read(source: PointSource, path: Path, result: Result) -> tuple[InputFile, ...]:
    """Return the file that was read, or the recordings of a folder."""
    named = source.file or ""
    if path.is_file():
        role = "result" if path.suffix.lower() == ".json" else "recording"
        return (InputFile(role=role, path=named, sha256=sha256(path.read_bytes()).hexdigest()),)
    return tuple(
        InputFile(role="recording", path=f"{named}: {item.path}", sha256=item.sha256)
        for item in result.provenance.inputs
        if item.role == "recording"
    )


def _named(name: str, files: CampaignFiles) -> str | Path:
    """Return a procedure's name, or its path from the campaign's folder."""
    return files.folder / name if name.endswith((".yaml", ".yml")) else name


def _of_result(
    source: PointSource,
    result: Result,
    label: str,
    files: CampaignFiles,
    *,
    changes: dict[str, str] | None = None,
    read: tuple[InputFile, ...] = (),
) -> LoadedSource:
    reason = _unusable(result) or _other_impactor(result, files)
    report = SourceReport(
        kind=source.kind,
        label=f"{label} ({MARK})" if is_marked(result) else label,
        verdict=result.verdict,
        values=[_value(criterion) for criterion in result.criteria],
        usable=reason is None,
        coded_reason=reason,
        certificate=result.id,
        changes=changes or {},
    )
    return LoadedSource(report, result, read)


def _unusable(result: Result) -> Reason | None:
    """Say why a test or run does not count as a whole: its conditions, or the trust in it."""
    criteria = worst(criterion.verdict for criterion in result.criteria if criterion.graded)
    if result.verdict != "error" and (result.verdict != "not evaluated" or criteria == "not evaluated"):
        return None
    found = [
        Reason.of(
            "condition-not-kept", quantity=row.quantity, why=row.coded_reason or row.reason or row.verdict
        )
        for row in result.preconditions
        if row.verdict == "fail" or (row.required and row.verdict != "pass")
    ]
    checks = result.quality.checks if result.quality else []
    found += [
        Reason.of("check-beyond-limit", check=check.coded_title or check.title)
        for check in checks
        if check.verdict != "pass"
    ]
    found = found or result.coded_remarks[:1] or [Reason.words(each) for each in result.remarks[:1]]
    if not found:
        return Reason.of("result-is", verdict=result.verdict)
    return Reason.of("several-reasons", reasons=found)


def _other_impactor(result: Result, files: CampaignFiles) -> Reason | None:
    channels = embedded_channels(result)
    if channels is None or channels.impactor == files.impactor:
        return None
    return Reason.of("of-other-impactor", impactor=channels.impactor, wanted=files.impactor)


def _value(criterion: CriterionResult) -> PointValue:
    lost = criterion.graded and criterion.verdict in {"not evaluated", "error"}
    return PointValue(
        id=criterion.id,
        title=criterion.title,
        value=None if lost else criterion.value,
        unit=criterion.unit,
        guard=criterion.uncertainty.guard_band if criterion.uncertainty else None,
        coded_reason=_why_lost(criterion) if lost else None,
    )


def _why_lost(criterion: CriterionResult) -> Reason:
    if criterion.coded_reason is not None:
        return criterion.coded_reason
    if criterion.reason:
        return Reason.words(criterion.reason)
    return Reason.of("value-is", verdict=criterion.verdict)


def _predicted(name: str, text: str) -> PointValue:
    """Return a named value in the unit that the field shows such a quantity in."""
    dimension = next(each for each in dimensions(text) if each not in {"ratio", "count"})
    shown = {"moment": "N·m", "length": "mm", "angle": "deg", "force": "N"}
    unit = shown.get(dimension, next(iter(UNITS[dimension])))
    return PointValue(id=name, value=from_si(parse_quantity(text, dimension), dimension, unit), unit=unit)
