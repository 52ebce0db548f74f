"""A damaged input and what certkit made of it."""

from __future__ import annotations

import traceback
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING

from certkit.errors import CertkitError, InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path


class Outcome(Enum):
    """What came of a damaged input, the best first."""

    REFUSED = "refused"
    """An input error (exit code 2), or a verdict that is no pass."""
    REMARKED = "remarked"
    """A pass with a graded value that the damage changed, and a remark or note that tells something new."""
    HARMLESS = "unchanged"
    """A pass whose graded values are those of the intact input."""
    SILENT = "silently passed"
    """A pass with a graded value that the damage changed, and not a word of it."""
    TRACEBACK = "traceback"
    """An exception that is none of certkit's."""
    WRONG_CODE = "wrong exit code"
    """An error of certkit's that does not end with 2, though the input is what is wrong."""


BAD = (Outcome.SILENT, Outcome.TRACEBACK, Outcome.WRONG_CODE)


@dataclass(frozen=True)
class Finding:
    """What certkit says of an input: whether it passes, what decides, and everything it was told beside that.

    Parameters
    ----------
    passed : bool
    values : mapping of str to float
        Graded values by name; None where there is none.
    told : frozenset of str
        Codes of remarks and notes.
    said : str
        In words, for the report.
    """

    passed: bool
    values: Mapping[str, float | None] = field(default_factory=dict)
    told: frozenset[str] = frozenset()
    said: str = ""


@dataclass(frozen=True)
class Variant:
    """One damaged input.

    Parameters
    ----------
    format : str
        `ISO-MME`, `CSV`, `YAML`, …
    kind : str
        What was done to it: `truncated`, `frozen`, …
    name : str
        The exact damage; with the seed it can be made again.
    intact : Finding
        Of the same input without the damage.
    attempt : callable
        Writes the input into an empty folder, has certkit work on it, and returns what it says.
    """

    format: str
    kind: str
    name: str
    intact: Finding
    attempt: Callable[[Path], Finding]


@dataclass(frozen=True)
class Judged:
    """A variant with its outcome and the words that go with it."""

    variant: Variant
    outcome: Outcome
    said: str


NEAR = 0.01
"""Part of a graded value that counts as no change: sampling and rounding, not damage."""


def judged(variant: Variant, folder: Path) -> Judged:
    """Try one variant in an empty folder."""
    try:
        found = variant.attempt(folder)
    except InputError as error:
        wrong = error.exit_code != 2 or ("\n" in str(error) and type(error).__name__ == "DataError")
        return Judged(variant, Outcome.WRONG_CODE if wrong else Outcome.REFUSED, str(error))
    except CertkitError as error:
        return Judged(variant, Outcome.WRONG_CODE, f"{type(error).__name__}: {error}")
    except Exception:  # noqa: BLE001  # that is what is looked for
        return Judged(variant, Outcome.TRACEBACK, traceback.format_exc())
    return _compared(variant, found)


def _compared(variant: Variant, found: Finding) -> Judged:
    """Hold what certkit says of the damaged input against what it says of the intact one."""
    if not found.passed:
        return Judged(variant, Outcome.REFUSED, found.said)
    changed = [
        name for name, value in variant.intact.values.items() if _changed(value, found.values.get(name))
    ]
    if not changed:
        return Judged(variant, Outcome.HARMLESS, found.said)
    new = sorted(found.told - variant.intact.told)
    if new:
        return Judged(variant, Outcome.REMARKED, ", ".join(new))
    return Judged(variant, Outcome.SILENT, f"changed: {', '.join(changed)}; {found.said}")


def _changed(before: float | None, after: float | None) -> bool:
    if before is None or after is None:
        return before is not after
    return abs(after - before) > NEAR * abs(before)
