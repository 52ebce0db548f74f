"""What is done where measured data depart from their standard: refused, or read with a listed assumption."""

from __future__ import annotations

from certkit.errors import DataError
from certkit.reasons import Reason


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
