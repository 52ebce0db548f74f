"""Points of rating schemes: full points up to one value, none from another on, on a straight line between."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.definitions.units import parse_quantity
from certkit.documents.result import ScoreResult
from certkit.errors import UsageError
from certkit.grading.corridors import impactor_of, made_for
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.corridor_set import CorridorSet, Score
    from certkit.documents.result import CriterionResult


def points(value: float, full: float, zero: float, maximum: float) -> float:
    """Return the points of a value on a sliding scale.

    Parameters
    ----------
    value : float
        Smaller is better, unless `full` lies above `zero`.
    full, zero : float
        Full points below `full`, none from `zero` on; where they are equal there is nothing between.
    maximum : float
        Full points.
    """
    if full == zero:
        return maximum if value < full else 0.0
    return maximum * min(1.0, max(0.0, (zero - value) / (zero - full)))


def procedure_scores(
    named: str | None,
    corridors: Mapping[str, CorridorSet],
    criteria: Mapping[str, CriterionResult],
    channels: ChannelTable,
) -> tuple[list[ScoreResult], list[Reason]]:
    """Give the points of the rating scheme that a procedure names; none without one. See `grade_scores`.

    Parameters
    ----------
    named : str or None
        Name of the corridor set with the scores.
    corridors : mapping of str to CorridorSet
        By name.
    criteria : mapping of str to CriterionResult
        By their ids.
    channels : ChannelTable
        Of the legform that was tested.
    """
    if named is None:
        return [], []
    found = corridors.get(named)
    if found is None:
        return [], [Reason.of("score-set-not-found", set=named)]
    if not made_for(found, channels):
        return [], [Reason.of("score-set-for-other", set=named, impactor=impactor_of(found))]
    return grade_scores(found.scores, criteria)


def grade_scores(
    scores: Mapping[str, Score], criteria: Mapping[str, CriterionResult]
) -> tuple[list[ScoreResult], list[Reason]]:
    """Give points.

    Parameters
    ----------
    scores : mapping of str to Score
        By their names.
    criteria : mapping of str to CriterionResult
        By their ids.

    Returns
    -------
    scores : list of ScoreResult
    remarks : list of Reason
        One for each score that cannot be given because a criterion is missing: a missing value earns
        nothing.
    """
    given: list[ScoreResult] = []
    remarks: list[Reason] = []
    for name, score in scores.items():
        needed = [*score.criteria, *(score.forfeit.criteria if score.forfeit is not None else ())]
        missing = [i for i in needed if i not in criteria or criteria[i].value is None]
        if missing:
            without = list(dict.fromkeys(missing))
            remarks.append(Reason.of("score-not-measured", score=name, criteria=without))
        else:
            given.append(_score(name, score, criteria))
    return given, remarks


def _score(name: str, score: Score, criteria: Mapping[str, CriterionResult]) -> ScoreResult:
    rated = [
        (points(value, full, zero, score.points), -value, criterion, full, zero)
        for criterion, value, full, zero in (
            (c, _value(c), _shown(score.full, c, name), _shown(score.zero, c, name))
            for c in (criteria[i] for i in score.criteria)
        )
    ]
    earned, _, decisive, full, zero = min(rated, key=lambda row: row[:2])
    if score.forfeit is not None:
        for i in score.forfeit.criteria:
            if _value(criteria[i]) >= _shown(score.forfeit.at, criteria[i], name):
                earned, decisive = 0.0, criteria[i]
                full = zero = _shown(score.forfeit.at, criteria[i], name)
                break
    return ScoreResult(
        id=name,
        points=earned,
        maximum=score.points,
        criterion=decisive.id,
        value=_value(decisive),
        unit=decisive.unit,
        full=full,
        zero=zero,
        confidence=score.confidence or "estimated",
        source=score.source or "",
        note=score.note or "",
    )


def _value(criterion: CriterionResult) -> float:
    if criterion.value is None:
        raise UsageError(f"criterion {criterion.id} has no value to be scored")
    return criterion.value


def _shown(text: str, criterion: CriterionResult, name: str) -> float:
    """Read a score's value and give it in the criterion's unit."""
    for dimension in ("moment", "length", "force", "angle", "acceleration", "time", "speed", "energy"):
        try:
            return parse_quantity(text, dimension) / parse_quantity(f"1 {criterion.unit}", dimension)
        except ValueError:
            continue
    raise UsageError(
        f"score {name}: `{text}` cannot be given in {criterion.unit}, the unit of {criterion.id}"
    )
