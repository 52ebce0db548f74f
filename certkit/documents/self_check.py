"""`SelfCheck`: an extraction held to its run; the front, the leg, the contact alone, and all together."""

from __future__ import annotations

from typing import Self

from pydantic import model_validator

from certkit.documents.consistent_lists import check_lengths
from certkit.documents.output_document import Part
from certkit.documents.rounding import Figure, FigureTuple


class GroupCheck(Part):
    """A group in a self-check: largest movement (m), rms error of its movement over that of the run (%).

    In the coupled run and in the contact alone also the contact: its force over time and its largest (N), its
    rms error over the run's largest (%), its impulse (N·s) and its work on the group (J).
    """

    name: str
    peak: Figure
    run_peak: Figure
    rms_percent: Figure
    displacement: FigureTuple
    impulse: Figure | None = None
    run_impulse: Figure | None = None
    work: Figure | None = None
    run_work: Figure | None = None
    force: FigureTuple = ()
    force_peak: Figure | None = None
    run_force_peak: Figure | None = None
    force_rms_percent: Figure | None = None


class ChannelCheck(Part):
    """A channel of the leg in a self-check, CFC 180: peaks (N·m or m), their times (s), rms error (%).

    `start` and `interval` are the time axis of its values, s from the run's start.
    """

    name: str
    peak: Figure
    run_peak: Figure
    time: Figure
    run_time: Figure
    error_percent: Figure
    rms_percent: Figure
    values: FigureTuple
    run_values: FigureTuple
    start: Figure | None = None
    interval: Figure | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse curves of run and model that are not on one axis."""
        check_lengths(len(self.values), {f"{self.name}: run_values": self.run_values}, "values")
        return self


class PathCheck(Part):
    """A load path in the coupled run, on the check's axis: shortening (m) and force (N), their largest.

    `run_peak` and `run_largest` are those that the law was read from, `impulse` ∫F dt (N·s) and
    `absorbed` ∫F dx (J) up to the check's end, each beside that of the run.
    """

    name: str
    peak: Figure
    run_peak: Figure
    largest: Figure
    run_largest: Figure
    impulse: Figure
    run_impulse: Figure
    absorbed: Figure
    run_absorbed: Figure
    shortening: FigureTuple
    force: FigureTuple

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse forces that do not belong to the shortenings."""
        check_lengths(len(self.shortening), {f"{self.name}: force": self.force}, "shortenings")
        return self


class SelfCheck(Part):
    """The extraction held to the run that it came from.

    Parameters
    ----------
    id : str
        `front alone` (driven by the run's contact forces), `leg alone` (likewise), `contact alone` (leg and
        front led along the run's motion) or `coupled`.
    title : str
    start, interval, until : float
        Time axis of the series, from the run's start; the end of the comparison, s.
    groups : tuple of GroupCheck
        Faces that move first, the worst of them at the head; in the contact alone those whose contact force
        is worst.
    channels : tuple of ChannelCheck
        The worst first.
    mean_percent, worst_percent : float or None
        Mean and largest rms error of the faces' movement.
    force_percent, impulse_percent, rebound_percent : float or None
        Errors of the largest contact force, of its impulse and of the leg's speed at the end.
    wrong_group_percent : float or None
        Impulse that acts on another group than in the run, over the whole impulse.
    within : bool or None
        Whether the movement stays within the case's limits; None where nothing moves.
    paths : tuple of PathCheck
        Springs and sheets in the coupled run, in the order of the extraction's paths.
    failed : str or None
        Why the run did not come to its end; nothing else is known of it then.
    """

    id: str
    title: str
    start: Figure
    interval: Figure
    until: Figure
    groups: tuple[GroupCheck, ...] = ()
    channels: tuple[ChannelCheck, ...] = ()
    mean_percent: Figure | None = None
    worst_percent: Figure | None = None
    force_percent: Figure | None = None
    impulse_percent: Figure | None = None
    rebound_percent: Figure | None = None
    wrong_group_percent: Figure | None = None
    within: bool | None = None
    paths: tuple[PathCheck, ...] = ()
    failed: str | None = None
