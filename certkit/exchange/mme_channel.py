"""One channel file of an ISO-MME container."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.data_units import factor
from certkit.exchange.mme_checks import check_extremes, data_status, filter_state
from certkit.exchange.mme_header import Header, read_header
from certkit.exchange.samples import Lines, read_samples
from certkit.exchange.timebase import TimeBase
from certkit.files.limits import MAX_SAMPLES
from certkit.signals.clipping import beyond_class, find_clipping

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelKind
    from certkit.exchange.leniency import Leniency
    from certkit.reasons import Reason

_DEFAULT_UNIT = {
    "moment": "Nm",
    "elongation": "m",
    "displacement": "m",
    "force": "N",
    "acceleration": "m/s²",
    "angle": "rad",
}
_ALSO = {"elongation": "displacement"}
"""Another word for a dimension, by its own."""


class MmeChannel(Struct, frozen=True):
    """A channel as its file tells it, in SI units and certkit's polarity.

    Parameters
    ----------
    kind : ChannelKind
        Which channel it is.
    place : str
        Its file.
    base : TimeBase
        Its time axis.
    values : ndarray, shape (n,)
        SI.
    filtered : str
        Filter it has already seen.
    source : str
        Where its samples came from, as the file says it; empty where it does not.
    notes : tuple of Reason
        What the file says of its data.
    belongs : tuple of (str, str)
        Number of the test object, and the object and position that the code begins with.
    """

    kind: ChannelKind
    place: str
    base: TimeBase
    values: NDArray[np.float64]
    filtered: str
    source: str
    notes: tuple[Reason, ...]
    belongs: tuple[str, str] = ("", "")


def read_channel(
    text: str, place: str, code: str, kind: ChannelKind, sign: int, leniency: Leniency
) -> MmeChannel | Reason | None:
    """Read a channel file.

    Parameters
    ----------
    text : str
        Its content.
    place : str
        Its name for messages.
    code : str
        Channel code by the channel list.
    kind : ChannelKind
        The channel that code means.
    sign : int
        -1 to turn the polarity.
    leniency : Leniency
        What departures do.

    Returns
    -------
    MmeChannel, Reason or None
        The reason when the file says that its data are not to be used; None when it has gaps and reading is
        lenient.

    Raises
    ------
    DataError
        Whatever is wrong, with file and line.
    """
    lines = text.split("\n")
    header = read_header(lines, place)
    refused, doubts = data_status(header, kind.name)
    if refused is not None:
        return refused
    _check_code(header, code, leniency)
    _check_dimension(header, kind, leniency)
    _check_direction(header, code, leniency)
    base = _time_base(header, leniency)
    try:
        values = read_samples(Lines(place, header.end + 1, lines[header.end :]))[:, 0]
    except DataError as error:
        leniency.leave_out(str(error), kind.name)
        return None
    base = base.with_count(_count(header, base.count, len(values), leniency))
    if base.count < 2:
        raise DataError(f"{place}:{header.end + 1}: a single sample; a test has many: export it again")
    unit = _unit(header, kind, leniency)
    scale = factor(unit, kind)
    check_extremes(header, values, unit, kind, leniency)
    _check_clipping(header, scale * values, unit, kind)
    filtered, told = filter_state(header, code, leniency)
    source = header.find("Data source")
    return MmeChannel(
        kind=kind,
        place=place,
        base=base,
        values=sign * scale * values,
        filtered=filtered,
        source="" if source is None else source.value,
        notes=(*doubts, *told),
        belongs=(_object(header), code[:2]),
    )


def _check_code(header: Header, code: str, leniency: Leniency) -> None:
    own = header.find("Channel code")
    if own is None:
        leniency.depart(header.place, "no `Channel code`", f"{code}, from the channel list")
    elif own.value.upper() != code:
        leniency.depart(
            header.at(own),
            f"channel code {own.value}, but the channel list says {code}",
            "the channel list is right",
        )


def _time_base(header: Header, leniency: Leniency) -> TimeBase:
    """Read the axis as the header states it; the count is -1 where it states none."""
    reference = header.find("Reference channel")
    if reference and reference.value.casefold() == "explicit":
        raise DataError(
            f"{header.at(reference)}: time in a channel of its own is not read; "
            "export with an implicit reference channel"
        )
    line = header.find("Sampling interval")
    if line is None:
        raise DataError(
            f"{header.place}: no `Sampling interval`; without it there is no time axis: add the line"
        )
    interval = header.quantity(line, "time", "s")
    if not 1e-8 <= interval <= 60.0:
        raise DataError(
            f"{header.at(line)}: a sampling interval of {interval:g} s cannot be right; correct it"
        )
    first = header.find("Time of first sample")
    begin = header.quantity(first, "time", "s") if first else 0.0
    if first is None:
        leniency.depart(header.place, "no `Time of first sample`", "0 s")
    count = header.find("Number of samples")
    if count is None:
        leniency.depart(header.place, "no `Number of samples`", "the number of lines")
        return TimeBase(begin, interval, -1)
    samples = header.count(count)
    if samples > MAX_SAMPLES:
        raise DataError(
            f"{header.at(count)}: {count.value[:40]} samples; more than {MAX_SAMPLES} are refused: "
            "export a shorter record"
        )
    return TimeBase(begin, interval, samples)


def _count(header: Header, stated: int, found: int, leniency: Leniency) -> int:
    if found > MAX_SAMPLES:
        raise DataError(
            f"{header.place}: {found} samples; more than {MAX_SAMPLES} are refused: export a shorter record"
        )
    if stated not in {-1, found}:
        line = header.find("Number of samples")
        place = header.at(line) if line else header.place
        leniency.depart(
            place, f"{stated} samples announced, {found} found", "the samples found are all there are"
        )
    return found


def _check_dimension(header: Header, kind: ChannelKind, leniency: Leniency) -> None:
    """Hold the words of `Dimension` against what the code means."""
    stated = header.find("Dimension")
    if stated is None:
        return
    word = stated.value.casefold()
    if word in _DEFAULT_UNIT and word not in {kind.dimension.name, _ALSO.get(kind.dimension.name)}:
        leniency.depart(
            header.at(stated),
            f"`Dimension` is `{stated.value}`, but the code means {kind.title}, a {kind.dimension.name}",
            "the code is right",
        )


def _check_direction(header: Header, code: str, leniency: Leniency) -> None:
    """Hold `Direction` against the direction in the code, the letter before the filter's."""
    stated = header.find("Direction")
    letter = code[-2:-1]
    if stated is None or letter in {"", "0"}:
        return
    word = stated.value.strip().upper()
    if word in {"X", "Y", "Z", "R"} and word != letter:
        leniency.depart(
            header.at(stated),
            f"`Direction` is `{word}`, but the code {code} says {letter}",
            "the code is right",
        )


def _object(header: Header) -> str:
    """Return the number of the test object; empty where the file does not say it."""
    stated = header.find("Test object number")
    return "" if stated is None else stated.value.strip().lstrip("0")


def _unit(header: Header, kind: ChannelKind, leniency: Leniency) -> str:
    stated = header.find("Unit")
    if stated is None:
        default = _DEFAULT_UNIT[kind.dimension.name]
        leniency.depart(header.place, "no `Unit`", f"{default}, the default of ISO/TS 13499")
        return default
    try:
        factor(stated.value, kind)
    except ValueError as error:
        raise DataError(f"{header.at(stated)}: {error}") from error
    return stated.value


def _check_clipping(header: Header, values: NDArray[np.float64], unit: str, kind: ChannelKind) -> None:
    stated = header.find("Channel amplitude class")
    if stated is None:
        return
    limit = abs(header.quantity(stated, kind.dimension.quantity, unit))
    clipped = find_clipping(values, limit) if limit else None
    if clipped is not None:
        shown = f"{clipped.level / factor(unit, kind):g} {unit}"
        raise DataError(
            f"{header.place}:{header.end + clipped.index + 1}: clipped at {shown}, the channel's amplitude "
            f"class (line {stated.number}); the peak is lost: leave the channel out, or repeat the test"
        )
    over = beyond_class(values, limit) if limit else None
    if over is not None:
        shown = f"{over.level / factor(unit, kind):g} {unit}"
        raise DataError(
            f"{header.place}:{header.end + over.index + 1}: goes to {shown}, beyond the channel's amplitude "
            f"class (line {stated.number}); nothing vouches for it there: correct the class, or leave the "
            "channel out"
        )
