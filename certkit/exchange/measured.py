"""What a reader hands over: the recording, the files it came from, and every assumption that was made."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from certkit.errors import DataError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.exchange.conditions import Told
    from certkit.signals.recording import Recording


@dataclass(frozen=True)
class SourceFile:
    """A file that was read: its name as given and the SHA-256 of its bytes."""

    name: str
    sha256: str


@dataclass(frozen=True)
class MeasuredData:
    """A recording with where it came from.

    Parameters
    ----------
    recording : Recording
        In SI units; its notes carry the assumptions.
    files : tuple of SourceFile
        Every file the recording rests on, sorted by name.
    assumptions : tuple of Reason
        What `lenient` let pass.
    header : mapping of str to str
        What the container says of the test: laboratory, title, date. Not trusted, only shown.
    told : mapping of str to Told
        The recording's conditions with the places that tell them.
    """

    recording: Recording
    files: tuple[SourceFile, ...]
    assumptions: tuple[Reason, ...] = ()
    header: Mapping[str, str] = field(default_factory=dict)
    told: Mapping[str, Told] = field(default_factory=dict)


class Leniency:
    """Strict: the first departure from the standard is an error. Lenient: each becomes a listed assumption.

    The one object with state in this room; a reader makes one per test and hands its list over.
    """

    def __init__(self, *, lenient: bool) -> None:
        """Start with no assumptions."""
        self.lenient = lenient
        self.assumptions: list[Reason] = []

    def depart(self, place: str, what: str, assumption: str) -> None:
        """Report a departure: raise it, or note what is assumed instead.

        Raises
        ------
        DataError
            When reading strictly.
        """
        if not self.lenient:
            raise DataError(
                f"{place}: {what}; correct it, or read with --lenient, which assumes: {assumption}"
            )
        self.assumptions.append(Reason.of("assumed", place=place, fault=what, assumption=assumption))

    def leave_out(self, fault: str, channel: str) -> None:
        """Report samples that cannot be read: raise it, or note that the channel counts as not recorded.

        Raises
        ------
        DataError
            When reading strictly.
        """
        if not self.lenient:
            raise DataError(fault)
        self.assumptions.append(Reason.of("left-out", fault=fault, channel=channel))
