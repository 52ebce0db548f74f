"""Check of the grading: the carried channels graded again by the carried definitions, and all compared."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.bench.compare_documents import differences
from certkit.bench.model_origins import fits_of
from certkit.bench.regrade import embedded_setup, regrade
from certkit.bench.verification import Check, fails, holds, judged, left_out, unchecked
from certkit.documents.channel_curves import simulated_here
from certkit.errors import CertkitError
from certkit.grading.remarks import ACCEPTED, file_note

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.bench.compare_documents import Difference
    from certkit.documents.result import CriterionResult, Quality, Result
    from certkit.reasons import Reason

FIELDS = (
    "kind",
    "procedure",
    "title",
    "remarks",
    "coded_remarks",
    "method",
    "specimen",
    "decision_rule",
    "coded_decision_rule",
    "preconditions",
    "conditions",
    "scores",
    "comparison",
    "interval",
    "curves",
    "parameters",
    "laboratory",
)
"""What follows from channels and definitions, beside criteria, verdict and notes, each told by itself."""

WORDED = re.compile(r"remarks|notes|reason|decision_rule|coded_|parameters|specimen")
"""Fields that are worded: another version may word them otherwise."""

GATE_FIGURES = {
    "energy balance": "energy_error_percent",
    "joint gap": "joint_gap_mm",
    "penetration": "penetration_mm",
    "change when the step is halved": "step_change_percent",
}
"""Figure of the quality that each check of its gate, by its English title, holds against a limit."""

FROM_SIMULATION = ("quality", "energies", "motion", "front")


def grading_checks(result: Result) -> Iterator[Check]:
    """Grade again, and compare criteria, verdict, preconditions, remarks, notes, curves and all the rest."""
    yield from _kind_checks(result)
    if result.quality is not None:
        yield from gate_checks(result.quality)
    try:
        again = regrade(result)
    except CertkitError as error:
        yield fails("graded again", "not-gradable", error=" ".join(str(error).split()))
        return
    now = {criterion.id: criterion for criterion in again.criteria}
    for before in result.criteria:
        yield _criterion_check(result, before, now.pop(before.id, None))
    for name in now:
        yield fails(f"graded again: {name}", "criterion-left-out")
    same = again.verdict == result.verdict
    told = {"said": result.verdict, "made": again.verdict}
    yield (
        holds("graded again: verdict", "graded-again", verdict=again.verdict)
        if same
        else fails("graded again: verdict", "verdict-differs", **told)
    )
    for name in FIELDS:
        yield _field_check(name, result, again)
    yield from _note_checks(result, again)
    yield _override_check(result)


def _kind_checks(result: Result) -> Iterator[Check]:
    """Check that a measured test has nothing of a simulation, and names what it was made from."""
    if result.kind != "test evaluation":
        return
    parts = [name for name in FROM_SIMULATION if getattr(result, name) is not None]
    if parts:
        yield fails("kind", "simulated-parts-in-measured-test", parts=", ".join(parts))
    if not any(item.role == "recording" for item in result.provenance.inputs):
        yield fails("kind", "recording-not-named")


def gate_checks(quality: Quality) -> Iterator[Check]:
    """Check that the quality gate's verdicts are those of its own figures and limits."""
    for check in quality.checks:
        title = check.title or str(check.coded_title)
        figure = getattr(quality, GATE_FIGURES.get(title, ""), check.value)
        if figure != check.value:
            yield fails(f"quality: {title}", "gate-other-figure", said=check.value, made=figure)
        right = "pass" if check.value <= check.limit else "error"
        yield judged(
            f"quality: {title}",
            check.verdict == right,
            "gate-contradicts",
            title=title,
            value=check.value,
            limit=check.limit,
            unit=check.unit,
            verdict=check.verdict,
        )
    bad = any(check.verdict != "pass" for check in quality.checks)
    told = {"said": quality.verdict, "made": "error" if bad else "pass"}
    yield judged("quality: verdict", quality.verdict == told["made"], "verdict-differs", **told)


def _criterion_check(result: Result, before: CriterionResult, after: CriterionResult | None) -> Check:
    what = f"graded again: {before.id}"
    if after is None:
        return fails(what, "criterion-unknown")
    if before.verdict != after.verdict:
        return fails(what, "verdict-differs", said=before.verdict, made=after.verdict)
    # The spread comes from a whole family of legs, which no certificate carries.
    found = list(differences(before.model_copy(update={"spread": None}), after))
    places = {each.place for each in found}
    if "value" in places and None not in (before.value, after.value):
        return fails(what, "value-differs", said=before.value, made=after.value, unit=before.unit)
    if places & {"lower", "upper"}:
        return fails(what, "corridor-differs")
    return _told(what, result, found)


def _field_check(name: str, result: Result, again: Result) -> Check:
    what = f"graded again: {name.replace('_', ' ')}"
    before, after = getattr(result, name), getattr(again, name)
    if name == "laboratory" and before is not None:
        before = {key: value for key, value in before.items() if key != "logo"}  # a picture, not carried
        after = {key: value for key, value in (after or {}).items() if key != "logo"}
    if name in {"remarks", "coded_remarks"} and any(c.spread for c in result.criteria):
        before = [each for each in before if each in after]  # those on the family are of its runs
    if name in {"remarks", "coded_remarks"}:
        before = [each for number, each in enumerate(before) if not _passed_on(result, number)]
    found = [each for each in differences(before, after, name) if not each.place.endswith(".text")]
    if found and "remarks" in name and simulated_here(result) and not fits_of(embedded_setup(result)):
        return unchecked(what, "fits-not-known", place=found[0].place)
    if found and _other_numbers(name, result, again):
        return fails(what, "field-differs", place=name, said=result.decision_rule, made=again.decision_rule)
    return _told(what, result, found)


def _passed_on(result: Result, number: int) -> bool:
    """Tell whether a remark passes on a note of the recording's files, which the document has as well."""
    if number >= len(result.coded_remarks) or result.coded_remarks[number].code != ACCEPTED:
        return False
    note = file_note(result.coded_remarks[number])
    return note is not None and _plain(note) in map(_plain, result.coded_notes)


def _plain(reason: Reason) -> str:
    """Return a reason without its words."""
    return str(reason.worded("").model_dump(mode="json"))


def _told(what: str, result: Result, found: list[Difference]) -> Check:
    """Return the check with its first difference; another version may word some things otherwise."""
    version = result.provenance.certkit
    if version != __version__:
        found = [each for each in found if "coded_" not in each.place]  # it may know no codes; words are told
    hard = [each for each in found if version == __version__ or not WORDED.search(each.place)]
    if hard:
        first = hard[0]
        return fails(what, "field-differs", place=first.place, said=first.said, made=first.made)
    if found:
        return unchecked(what, "words-of-another-version", place=found[0].place, version=version)
    return holds(what)


def _other_numbers(name: str, result: Result, again: Result) -> bool:
    """Tell whether a decision rule has other numbers, however it is worded."""
    if name != "decision_rule":
        return False
    numbers = [re.findall(r"\d+(?:\.\d+)?(?= ?·)", each.decision_rule) for each in (result, again)]
    return numbers[0] != numbers[1]


def _override_check(result: Result) -> Check:
    """Check that the changed values are told as they were: what each was before."""
    what = "graded again: overrides"
    setup = embedded_setup(result)
    made = {change.path: change for change in setup.overrides}
    for change in result.provenance.overrides:
        now = made.get(change.path)
        if now is not None and change.was is not None and now.was != change.was:
            return fails(what, "field-differs", place=change.path, said=change.was, made=now.was)
    return holds(what)


def _note_checks(result: Result, again: Result) -> Iterator[Check]:
    """Check that the notes that grading makes are all there; those of the recording's files are not known."""
    what = "graded again: notes"
    remarked = {_plain(note) for each in result.coded_remarks if (note := file_note(each)) is not None}
    silent = [n for n in result.coded_notes if file_note(n) is not None and _plain(n) not in remarked]
    if silent and result.provenance.certkit == __version__:
        yield fails(what, "remark-missing", note=str(silent[0])[:120])
    missing = [note for note in again.notes if note not in result.notes]
    further = [note for note in result.notes if note not in again.notes]
    if missing:
        yield fails(what, "note-missing", note=missing[0][:120])
    elif further:
        told = {"count": len(further), "note": further[0][:60]}
        yield left_out(what, "notes-from-recording", **told)
    else:
        yield holds(what)
