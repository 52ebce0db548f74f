"""Check of the simulation: run again from the definitions that the certificate carries, and compared."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.bench.compare_documents import Difference, differences
from certkit.bench.regrade import embedded_setup
from certkit.bench.run_simulation import run_setup
from certkit.bench.verification import Check, fails, holds, left_out, unchecked
from certkit.bench.verify_grading import WORDED
from certkit.documents.channel_curves import simulated_here
from certkit.errors import CertkitError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.documents.result import Result

WHAT = "reproduction"

NOT_COMPARED = {"schema_", "id", "provenance", "remarks", "coded_remarks"}
"""Of the document, not of the simulation; remarks are compared with those of the grading."""

ANOTHER_VERSION = 0.01
"""By how much another version may compute a criterion otherwise, of its value or its corridor's width: twice
what the quality gate lets half a time step change. Beyond it, the certificate was not computed from what it
carries."""


def reproduction_checks(result: Result, *, quick: bool) -> Iterator[Check]:
    """Simulate a simulated certificate again, and compare it with what comes of it.

    Parameters
    ----------
    result : Result
    quick : bool
        Leave it out, and say so.
    """
    if result.kind != "virtual certification":
        return
    if not simulated_here(result):
        yield left_out(WHAT, "not-simulated-here")
        return
    if quick:
        yield left_out(WHAT, "quick")
        return
    refined = result.quality is None or result.quality.step_change_percent is not None
    try:
        again = run_setup(embedded_setup(result), refine=refined)
    except CertkitError as error:
        yield fails(WHAT, "simulation-fails", error=" ".join(str(error).split()))
        return
    yield _compared(result, again.as_written())
    if any(criterion.spread for criterion in result.criteria):
        yield left_out("reproduction: family", "family-not-run")


def _compared(result: Result, again: Result) -> Check:
    before = result.model_copy(
        update={"criteria": [c.model_copy(update={"spread": None}) for c in result.criteria]}
    )
    found = [
        each
        for name in type(result).model_fields
        if name not in NOT_COMPARED
        for each in differences(getattr(before, name), getattr(again, name), name)
        if not each.place.endswith("solver_seconds")
    ]
    if not found:
        return holds(WHAT, "reproduced")
    if result.provenance.certkit != __version__:
        found = [each for each in found if not WORDED.search(each.place)]
        if not found:
            return holds(WHAT, "reproduced")
        far = _far(result, again)
        if far is None:
            told = {"place": found[0].place, "said": found[0].said, "made": found[0].made}
            version = result.provenance.certkit
            return unchecked(WHAT, "other-version-computes", version=version, now=__version__, **told)
        found = [far]
    first = found[0]
    return fails(WHAT, "reproduction-differs", place=first.place, said=first.said, made=first.made)


def _far(result: Result, again: Result) -> Difference | None:
    """Return the first criterion that no other version explains."""
    now = {criterion.id: criterion for criterion in again.criteria}
    for before in result.criteria:
        after = now.get(before.id)
        if before.value is None or after is None or after.value is None:
            continue
        width = (before.upper or 0.0) - (before.lower or 0.0) if before.lower is not None else 0.0
        scale = max(abs(after.value), abs(width))
        if abs(before.value - after.value) > ANOTHER_VERSION * scale and before.graded:
            return Difference(f"criteria.{before.id}.value", f"{before.value:.6g}", f"{after.value:.6g}")
    return None
