"""Put two recordings beside each other: errors, ISO/TS 18571 ratings, overlaid curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.documents.comparison import ChannelRating, ComparisonDocument, Overlay, Side
from certkit.documents.result import ComparisonRow
from certkit.documents.rounding import rounded_all
from certkit.errors import DataError
from certkit.grading.reference_errors import error_percent, rms
from certkit.reasons import Reason, reason_of
from certkit.signals import Filtered, rate, resampled
from certkit.signals.iso18571 import INTERVAL, grade
from certkit.signals.rating_causes import rating_causes

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from certkit.documents.result import Result
    from certkit.signals import Channel, Recording

FILTER = "CFC 180"
MOST_POINTS = 600
SLOWEST = 1e-3
"""Sampling interval, s, above which curves are too coarse for a rating at 10 kHz."""
NOTHING = 0.01
"""Share of a unit's largest value below which a reference is nothing that an error could be relative to."""


class ComparedTest(Struct, frozen=True):
    """One test to be compared: its words, its conditioned recording, its criteria where it was graded."""

    side: Side
    recording: Recording
    result: Result | None = None


def side_by_side(
    reference: ComparedTest, other: ComparedTest, *, until: float | None = None
) -> ComparisonDocument:
    """Compare two tests from first contact on.

    Parameters
    ----------
    reference : ComparedTest
        What errors and ratings refer to.
    other : ComparedTest
        What is compared with it.
    until : float, optional
        End of the comparison, s; the end of the shorter recording when missing.

    Returns
    -------
    ComparisonDocument

    Raises
    ------
    DataError
        When the tests share no channel or no time.
    """
    shared = [name for name in reference.recording.channels if name in other.recording]
    if not shared:
        raise DataError(
            f"{reference.side.label} and {other.side.label} share no channel; map their codes or heads"
        )
    begin, end = _interval(reference.recording, other.recording, until)
    curves = {
        name: _pair(reference.recording, other.recording, name, begin, end, step=_step(reference, other))
        for name in shared
    }
    notes = [
        Reason.of("only-in", test=test.side.label, channels=left)
        for test in (reference, other)
        if (left := [name for name in test.recording.channels if name not in shared])
    ]
    rows, said = _rows(reference, other, curves)
    slow = _step(reference, other) > SLOWEST
    ratings = [_rating(reference.recording[name], *curves[name], slow=slow) for name in shared]
    overall = [rating.overall for rating in ratings if rating.overall is not None]
    mean = float(np.mean(overall)) if overall else None
    return ComparisonDocument(
        title=f"{other.side.label} compared with {reference.side.label}",
        reference=reference.side,
        other=other.side,
        rows=rows,
        rms_error_percent=rms([row.error_percent for row in rows]) if rows else None,
        interval=(begin, end),
        ratings=ratings,
        rating=mean,
        grade="" if mean is None else grade(mean),
        overlays=[
            _overlay(reference.recording[name], *curves[name], begin, _step(reference, other))
            for name in shared
        ],
        coded_notes=[*notes, *said],
    ).with_id()


def _interval(a: Recording, b: Recording, until: float | None) -> tuple[float, float]:
    begin = max(0.0, float(a.time[0]), float(b.time[0]))
    end = min(float(a.time[-1]), float(b.time[-1]), np.inf if until is None else until)
    if end <= begin:
        raise DataError(
            f"{a.source or 'the first'} and {b.source or 'the second'} share no time after contact"
            "; check their time axes"
        )
    return begin, end


def _step(a: ComparedTest, b: ComparedTest) -> float:
    """Return the step of the common axis: the method's 0.1 ms, or that of slow (static) tests."""
    slowest = max(a.recording.interval, b.recording.interval)
    return INTERVAL if slowest <= SLOWEST else slowest


def _pair(
    a: Recording, b: Recording, name: str, begin: float, end: float, *, step: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], str]:
    """Return a channel of both on the common axis, filtered alike where that is possible."""
    try:
        values = [Filtered(each).values(name, FILTER) for each in (a, b)]
        words = FILTER
    except DataError:
        values = [each[name].values for each in (a, b)]
        words = "none"
    if step == INTERVAL:
        pair = [resampled(each.time, v, begin, end) for each, v in zip((a, b), values, strict=True)]
    else:
        axis = np.arange(begin, end + 0.5 * step, step)
        pair = [np.interp(axis, each.time, v) for each, v in zip((a, b), values, strict=True)]
    return pair[0], pair[1], words


def _rows(
    reference: ComparedTest,
    other: ComparedTest,
    curves: Mapping[str, tuple[NDArray[np.float64], NDArray[np.float64], str]],
) -> tuple[list[ComparisonRow], list[Reason]]:
    """Make the error table: of criteria where both were graded by one procedure, else of peaks."""
    pairs = _criteria(reference.result, other.result)
    said = Reason.of("values-of-criteria")
    if not pairs:
        pairs = [_peaks(reference.recording[name], x, y) for name, (x, y, _) in curves.items()]
        said = Reason.of("values-of-peaks", filter=FILTER)
    largest: dict[str, float] = {}
    for _, unit, value, _ in pairs:
        largest[unit] = max(largest.get(unit, 0.0), abs(value))
    rows, without = [], []
    for name, unit, test, found in pairs:
        if abs(test) <= NOTHING * largest[unit]:
            without.append(name)
            continue
        error = error_percent(found, test)
        rows.append(ComparisonRow(channel=name, unit=unit, test=test, simulation=found, error_percent=error))
    notes = [said]
    if without:
        notes.append(Reason.of("reference-nearly-zero", channels=without))
    return rows, notes


def _criteria(a: Result | None, b: Result | None) -> list[tuple[str, str, float, float]]:
    """Return id, unit and both values of the criteria, where both tests were graded by one procedure."""
    if a is None or b is None or a.procedure != b.procedure:
        return []
    theirs = {c.id: c for c in b.criteria}
    return [
        (c.id, c.unit, c.value, other.value)
        for c in a.criteria
        if (other := theirs.get(c.id)) is not None
        and c.value is not None
        and other.value is not None
        and other.unit == c.unit
    ]


def _peaks(channel: Channel, x: NDArray[np.float64], y: NDArray[np.float64]) -> tuple[str, str, float, float]:
    """Return the reference's peak of a channel, and the other's on the same side, in the shown unit."""
    sign = 1.0 if x[int(np.argmax(np.abs(x)))] >= 0 else -1.0
    peaks = [sign * float((sign * v).max()) * channel.dimension.scale for v in (x, y)]
    return channel.name, channel.dimension.unit, peaks[0], peaks[1]


def _rating(
    of: Channel, a: NDArray[np.float64], b: NDArray[np.float64], _: str, *, slow: bool
) -> ChannelRating:
    name, title = of.name, of.title
    if slow:
        return ChannelRating(channel=name, title=title, coded_reason=Reason.of("rated-too-slow"))
    try:
        rating = rate(a, b)
    except DataError as error:
        return ChannelRating(channel=name, title=title, coded_reason=reason_of(error))
    return ChannelRating(
        channel=name,
        title=title,
        corridor=rating.corridor,
        phase=rating.phase,
        magnitude=rating.magnitude,
        slope=rating.slope,
        overall=rating.overall,
        grade=rating.grade,
        coded_causes=rating_causes(a, b, rating),
    )


def _overlay(
    of: Channel, a: NDArray[np.float64], b: NDArray[np.float64], words: str, begin: float, step: float
) -> Overlay:
    stride = max(1, -(-a.size // MOST_POINTS))
    x, y = (v[::stride] * of.dimension.scale for v in (a, b))
    return Overlay(
        channel=of.name,
        title=of.title,
        unit=of.dimension.unit,
        filter=words,
        start=begin,
        interval=stride * step,
        reference=rounded_all(x),
        other=rounded_all(y),
        difference=rounded_all(y - x),
    )
