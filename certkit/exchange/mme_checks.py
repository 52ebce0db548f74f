"""What the header of an ISO-MME channel says of its samples: their state, their filter, their extremes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from certkit.exchange.codes import FILTER_OF_LETTER
from certkit.exchange.data_status import judged
from certkit.exchange.data_units import factor
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelKind
    from certkit.exchange.leniency import Leniency
    from certkit.exchange.mme_header import Header

_CLASS = re.compile(r"(?:CFC[\s_-]*)?(\d{1,6})\s*(?:Hz)?", re.IGNORECASE)
_UNFILTERED = frozenset({"none", "unfiltered", "no filter", "0"})

_SENSED = re.compile(r"transducer|sensor|gauge|potentiometer|measur|video|camera|film|hybrid|experiment")
"""What a measured channel's `Data source` says; ISO/TS 13499 has `transducer`."""
_SIMULATED = re.compile(
    r"simul|\bfem?\b|finite.?element|multi.?body|madymo|dyna|radioss|pam.?crash|abaqus|\bcae\b|\bmodel"
)
"""What that of a simulated one says; the standard has `simulation`, people write their program."""

_NEAR = 0.01
"""Deviation of a stated extreme from the samples' own, as a part of their swing, that rounding may cause."""


def data_status(header: Header, channel: str) -> tuple[Reason | None, tuple[Reason, ...]]:
    """Return why the channel is not used by its `Data status`, and what has to be told when it is."""
    stated = header.find("Data status")
    return (None, ()) if stated is None else judged(stated.value, header.at(stated), channel)


def data_status_of_test(header: Header, leniency: Leniency) -> list[Reason]:
    """Understand `Data status` of the test as a whole; a test whose data are not good is not read.

    Raises
    ------
    DataError
        When the status is another than `ok` or `questionable data`, and reading is strict.
    """
    refused, doubts = data_status(header, "")
    if refused is not None:
        status = refused.parameters["status"]
        leniency.depart(
            str(refused.parameters["place"]), f"data status of the test is `{status}`", "it is good"
        )
    return list(doubts)


def filter_state(header: Header, code: str, leniency: Leniency) -> tuple[str, tuple[Reason, ...]]:
    """Tell the filter that the samples have seen, from the code's last letter and the header's class.

    The two must not contradict each other. Read leniently, the narrower of them counts, so that nothing is
    filtered twice. A class of 1000 beside the letter of an unfiltered channel is that of the amplifier; it is
    told, and is no contradiction.

    Returns
    -------
    (str, tuple of Reason)
        Such as `CFC 180`, empty for none; and what has to be told.
    """
    stated = header.find("Channel frequency class")
    letter = code[-1]
    place = header.place if stated is None else header.at(stated)
    if letter not in FILTER_OF_LETTER:
        leniency.depart(place, f"filter letter {letter} of {code} tells no CFC", "not filtered yet")
        return "", ()
    of_letter = FILTER_OF_LETTER[letter]
    if stated is None:
        return of_letter, ()
    found = _CLASS.fullmatch(stated.value)
    if stated.value.casefold() in _UNFILTERED:
        of_header = ""
    elif found is None:
        leniency.depart(
            place,
            f"`Channel frequency class` is `{stated.value[:40]}`, which is no class such as 180",
            f"{of_letter or 'not filtered'}, as the code {code} says",
        )
        return of_letter, ()
    else:
        of_header = f"CFC {int(found.group(1))}"
    if of_header == of_letter:
        return of_letter, ()
    if not of_letter and of_header == "CFC 1000":
        return of_header, (Reason.of("prefiltered", place=place, filter=of_header),)
    narrower = min((of_letter, of_header), key=_bandwidth)
    leniency.depart(
        place,
        f"{of_header or 'not filtered'}, but the code {code} says {of_letter or 'not filtered'}",
        f"{narrower}, the narrower of the two",
    )
    return narrower, ()


def is_simulated(source: str) -> bool | None:
    """Tell by the words of `Data source` whether samples were simulated; None where they do not say it.

    A source that names both, such as a sensor model, is a simulation.
    """
    word = source.casefold()
    if _SIMULATED.search(word):
        return True
    return False if not word or _SENSED.search(word) else None


def check_extremes(
    header: Header, values: NDArray[np.float64], unit: str, kind: ChannelKind, leniency: Leniency
) -> None:
    """Hold the samples against the extremes that the header states of them.

    Parameters
    ----------
    header : Header
    values : ndarray, shape (n,)
        In `unit`, the channel's own.
    unit : str
        As the file has it.
    kind : ChannelKind
        The channel that the code means.
    leniency : Leniency
        What departures do.

    Raises
    ------
    DataError
        When they differ by more than a hundredth of the swing, and reading is strict.
    """
    swing = max(float(values.max() - values.min()), float(abs(values).max()))
    for words, own in (
        ("First global maximum value", float(values.max())),
        ("First global minimum value", float(values.min())),
    ):
        stated = header.find(words)
        if stated is None:
            continue
        value = header.quantity(stated, kind.dimension.quantity, unit) / factor(unit, kind)
        if abs(value - own) > _NEAR * swing:
            leniency.depart(
                header.at(stated),
                f"`{words}` is {stated.value[:40]}, but that of the samples is {own:.6g} {unit}",
                "the samples are right",
            )


def check_one_object(belongs: Sequence[tuple[str, str, str]], leniency: Leniency) -> None:
    """Hold the channels against each other: those of one kind of object are of one object, in one position.

    Parameters
    ----------
    belongs : sequence of (str, str, str)
        Each channel's file, the number of its test object, and the object and position of its code (`D0`).
    leniency : Leniency
        What departures do.

    Raises
    ------
    DataError
        When one names another than most of them, and reading is strict.
    """
    for letter in sorted({code[:1] for *_, code in belongs}):
        of_kind = [item for item in belongs if item[2][:1] == letter]
        for which, words in ((1, "test object"), (2, "object and position")):
            named = [item[which] for item in of_kind if item[which]]
            usual = max(named, key=named.count, default="")
            for item in of_kind:
                if item[which] not in {"", usual}:
                    leniency.depart(
                        item[0],
                        f"belongs to {words} {item[which]}, the other channels to {usual}",
                        f"it is of {words} {usual} too",
                    )


def _bandwidth(words: str) -> float:
    """Return the class's number, infinite where there is no filter."""
    return float(words.removeprefix("CFC ")) if words else float("inf")
