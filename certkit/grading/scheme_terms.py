"""What a scheme holds an impact point against: its limits, a maker's share of them, or its scores."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from msgspec import Struct, field

from certkit.errors import UsageError
from certkit.grading.half_up import half_up
from certkit.grading.quantities import in_unit

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from certkit.definitions.corridor_set import CorridorSet, ValueWindow
    from certkit.definitions.provenance import Confidence
    from certkit.definitions.scheme import Scheme


class SchemeTerms(Struct, frozen=True):
    """A scheme with its corridor set, and what a campaign asks of it.

    Parameters
    ----------
    scheme : Scheme
    corridors : CorridorSet
        The set that the scheme names.
    share : float
        Of the limits that may be used up: below 1 for a maker's own targets.
    shares : mapping of str to float
        Other shares, by criterion id.
    at_least : float, optional
        Points that the car has to reach.
    own_targets : bool
        Whether these are the maker's targets rather than the scheme itself.
    """

    scheme: Scheme
    corridors: CorridorSet
    share: float = 1.0
    shares: Mapping[str, float] = field(default_factory=dict)
    at_least: float | None = None
    own_targets: bool = False

    @property
    def kind(self) -> Literal["limits", "targets", "points"]:
        """How it judges."""
        if self.scheme.limits is None:
            return "points"
        return "targets" if self.own_targets else "limits"

    @property
    def title(self) -> str:
        """What it is called on a page."""
        if not self.own_targets:
            return self.scheme.title
        return f"Own targets, {self.share:.0%} of the limits: {self.scheme.title}".replace("%", " %")

    @property
    def criteria(self) -> list[str]:
        """Ids of all criteria that it looks at, in its order."""
        if self.scheme.limits is not None:
            return list(self.scheme.limits)
        return list(dict.fromkeys(name for score in self.corridors.scores.values() for name in score.needs))

    @property
    def car_points(self) -> dict[str, float]:
        """Points of the whole car for each score: times the mean share; empty without a rule."""
        scores = self.corridors.scores
        if self.scheme.total is not None:
            shared = self.scheme.total.points / sum(score.points for score in scores.values())
            return {name: shared * score.points for name, score in scores.items()}
        known = {name: score.car_points for name, score in scores.items() if score.car_points is not None}
        return known if len(known) == len(scores) else {}

    def keeps(self, criterion: str, value: float, unit: str, *, relaxed: bool) -> bool:
        """Tell whether a value keeps its limit, rounded and with the limit itself as its window says."""
        window = self._window(criterion, relaxed=relaxed)
        limit = self.limit(criterion, unit, relaxed=relaxed)
        rounded = value if window.decimals is None else half_up(value, window.decimals)
        return rounded < limit or (rounded == limit and not window.exclusive)

    def limit(self, criterion: str, unit: str, *, relaxed: bool) -> float:
        """Return the upper limit of a criterion in a unit; the relaxed one where there is one.

        Raises
        ------
        UsageError
            When the corridor set has no such window, or the unit does not fit.
        """
        window = self._window(criterion, relaxed=relaxed)
        if window.upper is None:
            raise UsageError(
                f"scheme {self.scheme.scheme}: the window of {criterion} has no upper limit"
                "; give its corridor one"
            )
        limit = in_unit(window.upper, unit, f"scheme {self.scheme.scheme}, {criterion}")
        return limit * self.shares.get(criterion, self.share)

    def _window(self, criterion: str, *, relaxed: bool) -> ValueWindow:
        names = dict(self.scheme.limits or {})
        if relaxed and self.scheme.relaxation is not None:
            names |= self.scheme.relaxation.limits
        found = self.corridors.windows.get(names[criterion])
        if found is None:
            raise UsageError(
                f"scheme {self.scheme.scheme}: the set `{self.corridors.corridors}` has no window "
                f"`{names[criterion]}` for {criterion}"
            )
        return found

    def origins(self) -> list[tuple[str, Confidence]]:
        """Return every source with its confidence, once each, in the order of their use."""
        scheme = self.scheme
        parts: Iterable[object] = (
            *(self._window(name, relaxed=False) for name in scheme.limits or ()),
            *(self.corridors.scores.values() if scheme.limits is None else ()),
            scheme.relaxation,
            scheme.total,
            scheme.untested,
        )
        found = {
            (source, confidence): None
            for part in parts
            if (source := getattr(part, "source", None)) and (confidence := getattr(part, "confidence", None))
        }
        return list(found)
