"""Verdicts: which of several is the worst, and the exit code of a command."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from certkit.documents.result import Result, Verdict

# From the worst to the best; a criterion out of its corridor outweighs one that could not be measured.
WORST_FIRST: tuple[Verdict, ...] = ("error", "fail", "conditional", "not evaluated", "pass")

EXIT_CODES: dict[Verdict, int] = {"error": 3, "fail": 1, "conditional": 1, "not evaluated": 4, "pass": 0}


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the worst of several verdicts; of none at all, `not evaluated`."""
    given = set(verdicts)
    return next((verdict for verdict in WORST_FIRST if verdict in given), "not evaluated")


def exit_code(results: Iterable[Result], allow: Collection[Verdict] = ()) -> int:
    """Return the exit code of a command that ends with these results.

    Parameters
    ----------
    results : iterable of Result
        The worst decides, in the order 3, 1, 4, 0 (2 belongs to errors of input, which are no results).
    allow : collection of Verdict
        Verdicts that count as 0: `not evaluated` for those who gate on what can be graded.
    """
    codes = {0 if result.verdict in allow else EXIT_CODES[result.verdict] for result in results}
    return next((code for code in (3, 1, 4, 0) if code in codes), 4)
