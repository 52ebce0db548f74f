"""What a laboratory's file says that does not go with the test: another item, gaps, misspelt conditions."""

from __future__ import annotations

import difflib
import re
from typing import TYPE_CHECKING

from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from certkit.definitions.channels import ChannelTable
    from certkit.documents.result import CriterionResult, PreconditionResult
    from certkit.grading.grading_terms import LaboratoryTerms

NEAR = 0.85
"""Likeness (difflib's ratio) from which on one word may be another misspelt; `added mass` and `ram mass` have
0.67."""


def laboratory_doubts(
    laboratory: LaboratoryTerms,
    criteria: Sequence[CriterionResult],
    preconditions: Sequence[PreconditionResult],
    table: ChannelTable,
) -> Iterator[Reason]:
    """Yield what speaks against a laboratory's file being the one of this test, or being whole.

    Parameters
    ----------
    laboratory : LaboratoryTerms
    criteria : sequence of CriterionResult
    preconditions : sequence of PreconditionResult
        All that the procedure asks for, and the calibrations.
    table : ChannelTable
        Channels of the legform that the test was graded as.
    """
    header = laboratory.header or {}
    named = str((header.get("item") or {}).get("legform") or "")
    if named and _letters(table.impactor) not in _letters(named):
        yield Reason.of("item-of-other-kind", said=named[:60], impactor=table.impactor)
    sensors = {str(each.get("channel")) for each in header.get("sensors") or ()}
    bare = [c.channel for c in criteria if c.graded and c.channel in table.kinds and c.channel not in sensors]
    if sensors and bare:
        yield Reason.of("calibration-not-told", channels=list(dict.fromkeys(bare)))
    open_ones = [row.quantity for row in preconditions if row.value is None]
    for word in laboratory.conditions:
        near = difflib.get_close_matches(word.casefold(), open_ones, 1, NEAR)
        if near and near[0] != word:
            yield Reason.of("condition-misspelt", said=word[:60], condition=near[0])


def _letters(text: str) -> str:
    """Return a name's letters and digits, small."""
    return re.sub(r"\W|_", "", text).casefold()
