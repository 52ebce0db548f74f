"""What a criterion asks before anything is measured: channel, unit and limits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from msgspec import Struct

from certkit.definitions.channels import TIME
from certkit.definitions.corridor_set import ValueWindow
from certkit.definitions.measures import MEASURES
from certkit.grading.corridors import Corridor, find_corridor, limits
from certkit.grading.trace import ordinate

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.channels import ChannelTable, Dimension
    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.procedure import Criterion


class AskedCriterion(Struct, frozen=True):
    """A criterion of a procedure with the limits that its corridor sets.

    Parameters
    ----------
    id, title : str
    channel : str
        Short name of the channel that is measured.
    unit : str
        Of value and limits, as reports have it.
    lower, upper : float, optional
        Limits in `unit`; a whole curve's value is its distance to the border, which has to be above zero.
    graded : bool
        Whether it counts for the verdict.
    shows : {'channel', 'time', 'curve'}
        What its value is: the channel's own at some instant, an instant, a whole curve's distance.
    """

    id: str
    title: str
    channel: str
    unit: str
    lower: float | None
    upper: float | None
    graded: bool
    shows: Literal["channel", "time", "curve"] = "channel"


def asked_criterion(
    criterion: Criterion, corridors: Mapping[str, CorridorSet], channels: ChannelTable
) -> AskedCriterion:
    """Return what a criterion asks of a leg with these channels.

    Raises
    ------
    UsageError
        When criterion and corridor do not fit together (kinds, units).
    """
    found = find_corridor(criterion, corridors, channels)
    dimension = dimension_of(criterion, channels)
    lower: float | None = None
    upper: float | None = None
    if isinstance(found, Corridor) and dimension is not None:
        window = found.entry
        lower, upper = limits(found, window, dimension) if isinstance(window, ValueWindow) else (0.0, None)
    scale = 1.0 if dimension is None else dimension.scale
    return AskedCriterion(
        id=criterion.id,
        title=criterion.title,
        channel=channels.name(ordinate(criterion)),
        unit="" if dimension is None else dimension.unit,
        lower=None if lower is None else lower * scale,
        upper=None if upper is None else upper * scale,
        graded=isinstance(found, Corridor) or found.required,
        shows=_shown_by(criterion),
    )


def _shown_by(criterion: Criterion) -> Literal["channel", "time", "curve"]:
    kind = MEASURES[criterion.measure]
    if kind.quantity == "time":
        return "time"
    return "channel" if kind.corridor is ValueWindow else "curve"


def dimension_of(criterion: Criterion, channels: ChannelTable) -> Dimension | None:
    """Return the dimension of a criterion's value: time, or its channel's; None where that is unknown."""
    if MEASURES[criterion.measure].quantity == "time":
        return TIME
    kind = channels.find(ordinate(criterion))
    return None if kind is None else kind.dimension
