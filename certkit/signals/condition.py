"""Conditioning: what a laboratory does to a measured test before anything is measured on it.

It is a pipeline of plain functions: each step takes a recording and returns one, with a note of what it
did. Filtering is not among them: every criterion names its own filter (`certkit.signals.filtered`).
Simulated recordings need none of this and pass through unchanged, except for the noise window; of a
finite-element run only time axis, time zero and signs are looked at.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.definitions.channels import ELONGATION, MOMENT
from certkit.errors import DataError
from certkit.reasons import Reason
from certkit.signals.clipping import beyond_class, find_clipping
from certkit.signals.noise import ALLOWED, FREE_FLIGHT_NOISE, WINDOW, free_flight
from certkit.signals.offset import MARGIN, SHORTEST, quiet_interval, remove_offset
from certkit.signals.plausibility_steps import drop_out
from certkit.signals.polarity import LOUD, is_swapped
from certkit.signals.time_zero import LATE, TOLERANCE, first_contact, shifted

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.definitions.procedure import Procedure
    from certkit.signals.recording import Channel, Recording, RecordingKind

SETTLED = 0.005
"""Seconds after the end of what is evaluated from which on the filters carry nothing back into it."""
UNIFORM = 0.01
"""Largest deviation of a sample from the uniform time axis, in sampling intervals."""


class Situation(Struct, frozen=True):
    """What conditioning has to know about a test.

    Parameters
    ----------
    dynamic : bool
        There is a first contact.
    free_flight : bool
        The legform flies before it, so there is a noise window and the record's last 30 ms before contact
        are not at rest.
    signs_known : bool
        The legform knows the signs of some of its channels beforehand.
    lenient : bool
        Turn swapped channels and keep clipped ones, with a note, instead of refusing them.
    until : float or None
        Seconds after contact up to which the test is evaluated; None where the data say so themselves.
    """

    dynamic: bool
    free_flight: bool
    signs_known: bool
    lenient: bool = False
    until: float | None = None


def condition(recording: Recording, procedure: Procedure, *, lenient: bool = False) -> Recording:
    """Condition a recording for a procedure.

    Parameters
    ----------
    recording : Recording
        As read or as simulated.
    procedure : Procedure
        Its rig's fixtures say which steps apply.
    lenient : bool
        See `Situation`.

    Returns
    -------
    Recording
        With `notes` on the whole test and on each channel of what was done.

    Raises
    ------
    DataError
        When the time axis is not uniform, a channel is clipped or its polarity is swapped.
    """
    situation = Situation(
        dynamic=procedure.test_kind != "static",
        free_flight=procedure.test_kind == "flight",
        signs_known=any(fixture.signs_known for fixture in procedure.rig.fixtures()),
        lenient=lenient,
        until=None if procedure.run.until is None else float(procedure.run.until),
    )
    for step in STEPS[recording.kind]:
        recording = step(recording, situation)
    return noise_noted(recording, situation)


def uniform(recording: Recording, situation: Situation) -> Recording:
    """Refuse a time axis that does not go forward in equal steps; static tests have load levels instead."""
    time = recording.time
    if any(c.values.shape != time.shape for c in recording.channels.values()):
        raise DataError(
            f"{recording.source or 'recording'}: channels and time axis have different lengths; "
            "export the test again"
        )
    if not situation.dynamic:
        return recording
    if time.size < 2:
        raise DataError(
            f"{recording.source or 'recording'}: {time.size} sample(s) are no test; export it again"
        )
    if not np.isfinite(time).all():
        raise DataError(
            f"{recording.source or 'recording'}: the time axis has values that are not numbers; "
            "export the test again"
        )
    interval = float(time[-1] - time[0]) / (time.size - 1)
    axis = time[0] + interval * np.arange(time.size)
    if interval <= 0 or float(np.abs(time - axis).max()) > UNIFORM * interval:
        at = int(np.argmax(np.abs(time - axis)))
        raise DataError(
            f"{recording.source or 'recording'}: the time steps are not equal "
            f"(sample {at + 1}, {time[at]:.6g} s); export the test with one sampling rate"
        )
    return recording


def unclipped(recording: Recording, situation: Situation) -> Recording:
    """Refuse channels that ran into their amplitude class or into an amplifier while they were evaluated.

    In free flight the end of the assessment interval is not known yet; there the plausibility gate looks.
    """
    if not situation.dynamic or situation.free_flight:
        return recording
    end = recording.time.size
    if situation.until is not None:
        end = int(np.searchsorted(recording.time, situation.until + SETTLED))

    def check(channel: Channel) -> Channel:
        kind = recording.table.kinds.get(channel.name)
        limit = kind.amplitude_class if kind else None
        values = channel.values[:end]
        found = clipped = find_clipping(values, limit)
        if found is None and limit is not None and recording.kind == "measured":
            found = beyond_class(values, limit)
        if found is None:
            return channel
        said = "is clipped at {} from {:.3f} ms on; its peak is lost"
        if clipped is None:
            said = "goes beyond its amplitude class, to {}, from {:.3f} ms on; nothing vouches for it there"
        level, unit = found.level * channel.dimension.scale, channel.dimension.unit
        time = float(recording.time[found.index]) * 1e3
        if not situation.lenient:
            raise DataError(
                f"{recording.source or 'recording'}: channel `{channel.name}` "
                f"{said.format(f'{level:.6g} {unit}', time)}. "
                "Leave the channel out, or accept it as it is with --lenient"
            )
        note = (
            Reason.of("clipped-kept", level=level, unit=unit, time=time)
            if clipped is not None
            else Reason.of("beyond-class-kept", level=level, unit=unit, time=time)
        )
        return replace(channel, notes=(*channel.notes, note))

    return _each_finite(recording, check)


def timed(recording: Recording, situation: Situation) -> Recording:
    """Move time zero to the first contact where the trigger is more than 5 ms before it, or 2 ms behind."""
    if not situation.dynamic:
        return recording
    contact = first_contact(recording, flight=ALLOWED if situation.free_flight else 0.0)
    if contact is None or -LATE <= contact.time <= TOLERANCE:
        return recording
    if not contact.quiet and contact.time <= 0.0 <= contact.risen:
        return (
            recording  # a leg swings in flight: where its rise begins is not known better than by the trigger
        )
    note = Reason.of("time-zero-moved", by=contact.time * 1e3, channel=contact.channel)
    return _noted(shifted(recording, contact.time), note)


def offset_free(recording: Recording, situation: Situation) -> Recording:
    """Take off what bone and ligament sensors show at rest before contact."""
    if not situation.dynamic:
        return recording
    # A legform in free flight is not at rest: its last 30 ms are the noise window and must not be flattered.
    until = -WINDOW - MARGIN if situation.free_flight else -MARGIN
    quiet = quiet_interval(recording.time, until)
    if quiet is None:
        return _noted(recording, Reason.of("no-offset-removed", needed=SHORTEST * 1e3))

    def correct(channel: Channel) -> Channel:
        if channel.dimension not in {MOMENT, ELONGATION}:
            return channel
        values, offset = remove_offset(channel.values, quiet)
        note = Reason.of(
            "offset-removed", offset=offset * channel.dimension.scale, unit=channel.dimension.unit
        )
        return replace(channel, values=values, notes=(*channel.notes, note))

    first, last = recording.time[0] * 1e3, recording.time[quiet.stop - 1] * 1e3
    note = Reason.of("offsets-removed", start=float(first), end=float(last))
    return _noted(_each_finite(recording, correct), note)


def right_way_round(recording: Recording, situation: Situation) -> Recording:
    """Refuse (or turn, when lenient) channels whose sign is known and that point the other way.

    A spike has no sign; where a channel drops out the plausibility gate says so.
    """
    if not situation.signs_known:
        return recording
    begin = int(np.searchsorted(recording.time, 0.0))
    interval = float(recording.time[1] - recording.time[0])

    def check(channel: Channel) -> Channel:
        kind = recording.table.kinds.get(channel.name)
        sign = kind.sign if kind else 0
        least = LOUD * (kind.amplitude_class or 0.0) if kind else 0.0
        values = channel.values[begin:]
        if not is_swapped(values, sign, least=least) or drop_out(values, interval, float(np.ptp(values))):
            return channel
        if not situation.lenient:
            raise DataError(
                f"{recording.source or 'recording'}: channel `{channel.name}` has its polarity swapped "
                f"(it should be {'positive' if sign > 0 else 'negative'} here); turn its sign in the "
                "mapping, or let --lenient turn it"
            )
        return replace(channel, values=-channel.values, notes=(*channel.notes, Reason.of("sign-turned")))

    return _each_finite(recording, check)


def noise_noted(recording: Recording, situation: Situation) -> Recording:
    """Write the largest bone moment of the free flight down as a condition of the test."""
    if not situation.free_flight or FREE_FLIGHT_NOISE in recording.conditions:
        return recording
    noise = free_flight(recording)
    if noise is None:
        return recording
    return replace(recording, conditions={**recording.conditions, FREE_FLIGHT_NOISE: noise.largest})


MEASURED_STEPS: tuple[Callable[[Recording, Situation], Recording], ...] = (
    uniform,
    unclipped,
    timed,
    offset_free,
    right_way_round,
)


STEPS: dict[RecordingKind, tuple[Callable[[Recording, Situation], Recording], ...]] = {
    "measured": MEASURED_STEPS,
    "virtual": (uniform, timed, right_way_round),
    "simulated": (),
}


def _each_finite(recording: Recording, change: Callable[[Channel], Channel]) -> Recording:
    """Apply `change` to every channel without NaN; the others are found out when they are measured on."""
    channels = {
        name: change(channel) if np.isfinite(channel.values).all() else channel
        for name, channel in recording.channels.items()
    }
    return replace(recording, channels=channels)


def _noted(recording: Recording, note: Reason) -> Recording:
    return replace(recording, notes=(*recording.notes, note))
