"""What stands above a suite of reports: its overall verdict, and what differs among what it binds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.documents.verdicts import WORST_FIRST, worst

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Verdict
    from certkit.reporting.result_view import View


MOST = 8
"""Reports of one verdict that are named."""


class SuiteHead(Struct, frozen=True):
    """The head of a suite.

    Parameters
    ----------
    verdict : str
        The worst of its reports'.
    tally : str
        How many of them passed.
    others : list of str
        Which of them did not, by verdict, the worst first; what failed with its worst criterion.
    remarks : list of str
        That it binds measured and simulated tests, or tests of several legforms: nobody shall take such a
        suite for the file of one legform.
    """

    verdict: Verdict
    tally: str
    others: list[str]
    remarks: list[str]


def suite_head(views: Sequence[View]) -> SuiteHead:
    """Return the head of a suite, in the language of its reports."""
    t = views[0].spoken.word
    given = {view.result.verdict for view in views}
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
        others=[_of(verdict, views) for verdict in WORST_FIRST if verdict in given and verdict != "pass"],
        remarks=remarks,
    )


def _of(verdict: Verdict, views: Sequence[View]) -> str:
    """Name the reports of a verdict: `fail: vehicle – MCL: 1.75 mm outside ≤ 22`."""
    named = [
        f"{view.result.procedure} – {view.nearest}"
        if view.nearest_criterion is not None and view.nearest_criterion.verdict == verdict == "fail"
        else view.result.procedure
        for view in views
        if view.result.verdict == verdict
    ]
    spoken = views[0].spoken
    more = [spoken.word("{count} more", count=len(named) - MOST)] if len(named) > MOST else []
    between = "; " if verdict == "fail" else spoken.word(", ")
    return f"{spoken.verdict(verdict)}: {between.join([*named[:MOST], *more])}"
