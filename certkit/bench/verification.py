"""What a verification found: one check after another, each with its outcome and a coded reason."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from msgspec import Struct, field

from certkit.reporting.language import ENGLISH, language

if TYPE_CHECKING:
    from collections.abc import Mapping

Outcome = Literal["holds", "does not hold", "not checked"]


class Check(Struct, frozen=True):
    """One thing that was checked, or that was not.

    Parameters
    ----------
    what : str
        What was looked at, such as `pages` or `graded again: T1`.
    outcome : {'holds', 'does not hold', 'not checked'}
    code : str
        Why, by the catalogue `verification` of each language; empty where nothing is to be said.
    parameters : mapping of str to object
        What the reason's sentence needs.
    asked : bool
        False for what was left out because nobody asked for it: it does not count against the certificate.
    """

    what: str
    outcome: Outcome
    code: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    asked: bool = True

    @property
    def said(self) -> str:
        """Return the reason in English words."""
        return self.said_in(ENGLISH)

    def said_in(self, spoken: str) -> str:
        """Return the reason in the words of a language."""
        return language(spoken).verified(self.code, self.parameters) if self.code else ""

    @property
    def holds(self) -> bool:
        """Tell whether it was checked and holds."""
        return self.outcome == "holds"


def holds(what: str, code: str = "", **parameters: object) -> Check:
    """Return a check that holds."""
    return Check(what, "holds", code, parameters)


def fails(what: str, code: str, **parameters: object) -> Check:
    """Return a check that does not hold."""
    return Check(what, "does not hold", code, parameters)


def unchecked(what: str, code: str, **parameters: object) -> Check:
    """Return what could not be checked."""
    return Check(what, "not checked", code, parameters)


def left_out(what: str, code: str, **parameters: object) -> Check:
    """Return what was not checked because nobody asked for it."""
    return Check(what, "not checked", code, parameters, asked=False)


def judged(what: str, same: object, code: str, **parameters: object) -> Check:
    """Return a check that holds when `same` is true."""
    return holds(what) if same else fails(what, code, **parameters)


class Verification(Struct, frozen=True):
    """What came of all checks.

    Parameters
    ----------
    certificate : str
        The file or folder as the user named it.
    ids : tuple of str
        Certificate ids found in it.
    checks : tuple of Check
        In the order they were made.
    verdicts : tuple of str
        Verdicts of the certificates, in the order of `ids`; none for other documents.
    """

    certificate: str
    ids: tuple[str, ...]
    checks: tuple[Check, ...]
    verdicts: tuple[str, ...] = ()

    @property
    def outcome(self) -> Outcome:
        """Return the worst outcome; what nobody asked for does not count."""
        found = {check.outcome for check in self.checks if check.asked}
        worst: tuple[Outcome, ...] = ("does not hold", "not checked")
        return next((each for each in worst if each in found), "holds")

    @property
    def holds(self) -> bool:
        """Tell whether everything that was to be checked could be checked, and holds."""
        return self.outcome == "holds"

    def of(self, outcome: Outcome) -> tuple[Check, ...]:
        """Return the checks that came out so."""
        return tuple(check for check in self.checks if check.outcome == outcome)
