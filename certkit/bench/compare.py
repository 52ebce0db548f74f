"""`compare`: two results, two recordings, or one of each."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, cast

from certkit.bench.regrade import embedded_store
from certkit.bench.setup import input_file
from certkit.bench.sources import Source, load_source
from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.loading.channel_tables import all_channels
from certkit.definitions.loading.library import load, stores
from certkit.definitions.loading.validation import read_document
from certkit.documents.comparison import Side
from certkit.grading.agreement import LimitedCriterion, hold_against
from certkit.grading.compare_tests import ComparedTest, side_by_side
from certkit.reporting.language import worded
from certkit.signals import condition

if TYPE_CHECKING:
    from certkit.definitions.agreement_rule import AgreementRule
    from certkit.definitions.loading.library import Library, Loaded
    from certkit.definitions.procedure import Procedure
    from certkit.documents.comparison import ComparisonDocument
    from certkit.documents.result import Result


def compare(  # noqa: PLR0913  # as many as `certkit compare` has options
    a: str | Path | Result,
    b: str | Path | Result,
    *,
    procedure: str | Path | None = None,
    mapping: str | Path | None = None,
    lenient: bool = False,
    library: Library = (),
    until: float | None = None,
    unverified: bool = False,
    rule: str | Path | None = None,
) -> ComparisonDocument:
    """Compare two tests, and hold the comparison against a rule.

    A is the reference, unless it was simulated and B measured: then the measured one is, as in the
    paper's Table 1.

    Parameters
    ----------
    a, b : str, Path or Result
        A result, its `result.json`, the folder of a run, or measured data.
    procedure : str or Path, optional
        By which measured data are conditioned (offsets, time zero); the one of a result when missing.
    mapping : str or Path, optional
        Mapping file for measured data.
    lenient : bool
        Of measured data, list assumptions instead of stopping at departures.
    library : str, Path, or sequence of them
        Folders with own definitions.
    until : float, optional
        End of the comparison, s after contact.
    unverified : bool
        Compare results that were changed since certkit wrote them as well, and say so in the comparison.
    rule : str or Path, optional
        Name or file of what the comparison has to keep; the document has a verdict then.

    Raises
    ------
    DataError
        When a source cannot be read, was changed, or they share nothing.
    """
    own = read_document(Path(mapping), Mapping, all_channels(library)) if mapping is not None else None
    first, second = (
        load_source(source, own, lenient=lenient, library=library, unverified=unverified) for source in (a, b)
    )
    sheet = _procedure(procedure, (first, second), library)
    if first.recording.kind != "measured" and second.recording.kind == "measured":
        first, second = second, first
    labels = _labels(first, second)
    document = side_by_side(
        _test(first, labels[0], sheet, lenient=lenient),
        _test(second, labels[1], sheet, lenient=lenient),
        until=until,
    )
    if rule is not None:
        loaded = cast("Loaded[AgreementRule]", load("agreement", rule, library=library))
        kept = loaded.document
        checks, verdict = hold_against(kept, document, _criteria(first.result, second.result))
        told = {"rule": kept.title, "checks": checks, "verdict": verdict, "inputs": [input_file(loaded)]}
        document = document.model_copy(update=told).with_id()
    return worded(document)


def _criteria(reference: Result | None, other: Result | None) -> list[LimitedCriterion]:
    """Return the criteria that both have, with their limits: the upper one, else where points end."""
    if reference is None or other is None or reference.procedure != other.procedure:
        return []
    ends = {score.criterion: score.zero for score in reference.scores}
    theirs = {criterion.id: criterion for criterion in other.criteria}
    found = []
    for own in reference.criteria:
        limit = ends.get(own.id) if own.upper is None else own.upper
        value = theirs[own.id].value if own.id in theirs else None
        if own.value is not None and value is not None and limit:
            found.append(LimitedCriterion(own.id, own.value, value, limit))
    return found


def _procedure(named: str | Path | None, sources: tuple[Source, ...], library: Library) -> Procedure | None:
    """Return the procedure that is named, else the one that a result carries."""
    if named is not None:
        return load("procedure", named, library=library).document
    for result in (source.result for source in sources if source.result):
        return load(
            "procedure", result.procedure, library=(*stores(library), embedded_store(result.provenance))
        ).document
    return None


def _test(source: Source, label: str, sheet: Procedure | None, *, lenient: bool) -> ComparedTest:
    recording, result = source.recording, source.result
    if sheet is not None:
        recording = condition(recording, sheet, lenient=lenient)
    side = Side(
        label=label,
        kind=recording.kind,
        title=result.title if result else "",
        procedure=result.procedure if result else "",
        verdict=result.verdict if result else None,
        id=result.id if result else "",
    )
    return ComparedTest(side, recording, result)


def _labels(first: Source, second: Source) -> tuple[str, str]:
    """Tell two sources of the same name apart."""
    if first.label != second.label:
        return first.label, second.label
    return f"{first.label} (A)", f"{second.label} (B)"
