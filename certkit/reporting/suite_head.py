"""What stands above a suite of reports: its overall verdict, and what differs among what it binds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.documents.verdicts import worst

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Verdict
    from certkit.reporting.result_view import View


class SuiteHead(Struct, frozen=True):
    """The head of a suite.

    Parameters
    ----------
    verdict : str
        The worst of its reports'.
    tally : str
        How many of them passed.
    remarks : list of str
        That it binds measured and simulated tests, or tests of several legforms: nobody shall take such a
        suite for the file of one legform.
    """

    verdict: Verdict
    tally: str
    remarks: list[str]


def suite_head(views: Sequence[View]) -> SuiteHead:
    """Return the head of a suite, in the language of its reports."""
    t = views[0].spoken.word
    passed = sum(view.result.verdict == "pass" for view in views)
    remarks = []
    kinds = list(dict.fromkeys(view.subject for view in views))
    if len(kinds) > 1:
        remarks.append(t("This suite binds different kinds of tests: {kinds}.", kinds=", ".join(kinds)))
    legs = list(dict.fromkeys(view.specimen_words for view in views))
    if len(legs) > 1:
        remarks.append(t("This suite binds tests of different legforms: {legs}.", legs="; ".join(legs)))
    return SuiteHead(
        verdict=worst(view.result.verdict for view in views),
        tally=t("{passed} of {count} reports passed.", passed=passed, count=len(views)),
        remarks=remarks,
    )
