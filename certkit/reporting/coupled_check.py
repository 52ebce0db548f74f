"""The self-checks of an extraction by their names, and the group that is worst in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import GroupCheck, SelfCheck


CONTACT = "contact alone"
CONTACT_LEFT_OUT = "The contact alone was not checked: the run does not tell how the leg's axis moved."


def check_of(result: ExtractionResult, key: str) -> SelfCheck | None:
    """Return a check by its id, see `SelfCheck`; None where it was not made."""
    return next((check for check in result.checks if check.id == key), None)


def group_of(check: SelfCheck | None, name: str) -> GroupCheck | None:
    """Return a group in a check."""
    return next((group for group in check.groups if group.name == name), None) if check else None


def worst_group(result: ExtractionResult) -> str | None:
    """Return the group whose movement in the coupled run, else in that of the front alone, errs most."""
    for key in ("coupled", "front alone"):
        check = check_of(result, key)
        if check and check.groups:
            return check.groups[0].name
    return None


def check_times(check: SelfCheck, count: int) -> list[float]:
    """Return the instants of a check's series, ms."""
    return [1e3 * (check.start + k * check.interval) for k in range(count)]
