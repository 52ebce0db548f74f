"""One channel file of an ISO-MME container."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.errors import DataError
from certkit.exchange.codes import FILTER_OF_LETTER
from certkit.exchange.container import MAX_SAMPLES
from certkit.exchange.data_units import factor
from certkit.exchange.mme_header import Header, read_header
from certkit.exchange.samples import Lines, read_samples
from certkit.exchange.timebase import TimeBase
from certkit.reasons import Reason
from certkit.signals.clipping import find_clipping

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelKind
    from certkit.exchange.measured import Leniency

_UNUSABLE = frozenset({"channel failed", "no data", "meaningless data", "system failed"})
_DOUBTFUL = frozenset({"questionable data"})
_DEFAULT_UNIT = {
    "moment": "Nm",
    "elongation": "m",
    "displacement": "m",
    "force": "N",
    "acceleration": "m/s²",
    "angle": "rad",
}


@dataclass(frozen=True)
class MmeChannel:
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
    simulated : bool
        Whether its data source is a simulation.
    notes : tuple of Reason
        What the file says of its data.
    """

    kind: ChannelKind
    place: str
    base: TimeBase
    values: NDArray[np.float64]
    filtered: str
    simulated: bool
    notes: tuple[Reason, ...]


def read_channel(
    text: str, place: str, code: str, kind: ChannelKind, sign: int, leniency: Leniency
) -> MmeChannel | None:
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
    MmeChannel or None
        None when its data are not to be used: the file says so, or has gaps and reading is lenient.

    Raises
    ------
    DataError
        Whatever is wrong, with file and line.
    """
    lines = text.split("\n")
    header = read_header(lines, place)
    status = header.find("Data status")
    if status and status.value.casefold() in _UNUSABLE:
        return None
    _check_code(header, code, leniency)
    base = _time_base(header, leniency)
    try:
        values = read_samples(Lines(place, header.end + 1, lines[header.end :]))[:, 0]
    except DataError as error:
        leniency.leave_out(str(error), kind.name)
        return None
    base = base.with_count(_count(header, base.count, len(values), leniency))
    if base.count < 2:
        raise DataError(f"{place}:{header.end + 1}: a single sample; a test has many")
    scale = _scale(header, kind, leniency)
    values = sign * scale * values
    _check_clipping(header, values, scale)
    source = header.find("Data source")
    doubtful = status is not None and status.value.casefold() in _DOUBTFUL
    return MmeChannel(
        kind=kind,
        place=place,
        base=base,
        values=values,
        filtered=_filter(header, code, leniency),
        simulated=source is not None and source.value.casefold() == "simulation",
        notes=(Reason.of("questionable-data", place=place),) if doubtful else (),
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
        raise DataError(f"{header.place}: no `Sampling interval`; without it there is no time axis")
    interval = header.number(line)
    if not 1e-8 <= interval <= 60.0:
        raise DataError(f"{header.at(line)}: a sampling interval of {line.value} s cannot be right")
    first = header.find("Time of first sample")
    if first is None:
        leniency.depart(header.place, "no `Time of first sample`", "0 s")
    count = header.find("Number of samples")
    if count is None:
        leniency.depart(header.place, "no `Number of samples`", "the number of lines")
        return TimeBase(header.number(first) if first else 0.0, interval, -1)
    if not re.fullmatch(r"\d+", count.value):
        raise DataError(
            f"{header.at(count)}: `Number of samples` is `{count.value[:40]}`; a whole number is needed"
        )
    if int(count.value) > MAX_SAMPLES:
        raise DataError(
            f"{header.at(count)}: {count.value[:40]} samples; more than {MAX_SAMPLES} are refused"
        )
    return TimeBase(header.number(first) if first else 0.0, interval, int(count.value))


def _count(header: Header, stated: int, found: int, leniency: Leniency) -> int:
    if found > MAX_SAMPLES:
        raise DataError(f"{header.place}: {found} samples; more than {MAX_SAMPLES} are refused")
    if stated not in {-1, found}:
        line = header.find("Number of samples")
        place = header.at(line) if line else header.place
        leniency.depart(
            place, f"{stated} samples announced, {found} found", "the samples found are all there are"
        )
    return found


def _scale(header: Header, kind: ChannelKind, leniency: Leniency) -> float:
    unit = header.find("Unit")
    if unit is None:
        default = _DEFAULT_UNIT[kind.dimension.name]
        leniency.depart(header.place, "no `Unit`", f"{default}, the default of ISO/TS 13499")
        return factor(default, kind)
    try:
        return factor(unit.value, kind)
    except ValueError as error:
        raise DataError(f"{header.at(unit)}: {error}") from error


def _filter(header: Header, code: str, leniency: Leniency) -> str:
    """Tell the filter state from the code's last letter, which the header must not contradict."""
    stated = header.find("Channel frequency class")
    letter = code[-1]
    if letter not in FILTER_OF_LETTER:
        place = header.at(stated) if stated else header.place
        leniency.depart(place, f"filter letter {letter} of {code} tells no CFC", "not filtered yet")
        return ""
    filtered = FILTER_OF_LETTER[letter]
    if stated and filtered and re.fullmatch(r"(CFC\s*)?\d+", stated.value):
        cfc = "CFC " + stated.value.removeprefix("CFC").strip()
        if cfc != filtered:
            leniency.depart(
                header.at(stated),
                f"{cfc}, but the code {code} says {filtered}",
                f"{filtered}, as the code says",
            )
    return filtered


def _check_clipping(header: Header, values: NDArray[np.float64], scale: float) -> None:
    stated = header.find("Channel amplitude class")
    if stated is None:
        return
    clipped = find_clipping(values, abs(header.number(stated) * scale))
    if clipped is not None:
        raise DataError(
            f"{header.place}:{header.end + clipped.index + 1}: clipped at {clipped.level / scale:g}, the "
            f"channel's amplitude class (line {stated.number}); the peak is lost"
        )
