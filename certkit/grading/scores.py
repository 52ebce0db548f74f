"""Points of rating schemes: all up to one value, none from another on, on a line or in steps between."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.documents.result import ScoreResult
from certkit.errors import UsageError
from certkit.grading.corridors import impactor_of, made_for
from certkit.grading.half_up import band_borders, half_up
from certkit.grading.quantities import in_unit
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.score import Score, SlidingScale
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


def share_of(value: float, borders: Sequence[float], shares: Sequence[float]) -> tuple[float, int]:
    """Return the share of the points that a value earns in steps, and the number of its band.

    A value on a border belongs to the band above it: all points are earned strictly below the first border,
    none from the last one on.

    Parameters
    ----------
    value : float
        Smaller is better.
    borders : sequence of float
        From full to none, one more than there are shares.
    shares : sequence of float
        Of the bands between the borders.
    """
    band = sum(value >= border for border in borders)
    return (1.0, *shares, 0.0)[band], band


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
    return grade_scores(found.scores, criteria, scheme=named)


def grade_scores(
    scores: Mapping[str, Score], criteria: Mapping[str, CriterionResult], *, scheme: str = ""
) -> tuple[list[ScoreResult], list[Reason]]:
    """Give points.

    Parameters
    ----------
    scores : mapping of str to Score
        By their names.
    criteria : mapping of str to CriterionResult
        By their ids.
    scheme : str
        Name of the corridor set that they are of.

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
        missing = [i for i in score.needs if i not in criteria or criteria[i].value is None]
        if missing:
            remarks.append(Reason.of("score-not-measured", score=name, criteria=missing))
        else:
            given.append(_score(name, score, criteria, scheme))
    return given, remarks


class _Rated(Struct, frozen=True):
    """A criterion on its scale: what it earns of all points, and in which band it lies."""

    share: float
    value: float
    criterion: CriterionResult
    full: float
    zero: float
    band: int | None = None

    @property
    def order(self) -> tuple[float, float]:
        """Worst first: fewest points, then farthest along its scale."""
        span = self.zero - self.full
        return self.share, -(self.value - self.full) / span if span else -self.value


def _score(name: str, score: Score, criteria: Mapping[str, CriterionResult], scheme: str) -> ScoreResult:
    rated = [_rate(name, score, scale, criteria[i]) for scale in score.scales for i in scale.criteria]
    worst = min(rated, key=lambda row: row.order)
    if score.forfeit is not None:
        for i in score.forfeit.criteria:
            limit = in_unit(score.forfeit.at, criteria[i].unit, f"score {name}, {i}")
            if _value(criteria[i]) >= limit:
                last = len(score.shares) + 1 if score.shares else None
                worst = _Rated(0.0, _value(criteria[i]), criteria[i], limit, limit, last)
                break
    earned = score.points * worst.share
    if score.point_decimals is not None:
        earned = half_up(earned, score.point_decimals)
    return ScoreResult(
        id=name,
        points=earned,
        maximum=score.points,
        criterion=worst.criterion.id,
        value=_value(worst.criterion),
        unit=worst.criterion.unit,
        full=worst.full,
        zero=worst.zero,
        scheme=scheme,
        colour=score.colours[worst.band] if score.colours and worst.band is not None else "",
        car_points=score.car_points,
        confidence=score.confidence or "estimated",
        source=score.source or "",
        note=score.note or "",
    )


def _rate(name: str, score: Score, scale: SlidingScale, criterion: CriterionResult) -> _Rated:
    where = f"score {name}, {criterion.id}"
    full, zero = (in_unit(text, criterion.unit, where) for text in (scale.full, scale.zero))
    value = _value(criterion)
    if score.decimals is not None:
        value = half_up(value, score.decimals)
    if not score.shares:
        return _Rated(points(value, full, zero, 1.0), value, criterion, full, zero)
    borders = band_borders(full, zero, len(score.shares), score.decimals)
    share, band = share_of(value, borders, score.shares)
    return _Rated(share, value, criterion, full, zero, band)


def _value(criterion: CriterionResult) -> float:
    if criterion.value is None:
        raise UsageError(
            f"criterion {criterion.id} has no value to be scored; leave the score out, or record the channel"
        )
    return criterion.value
