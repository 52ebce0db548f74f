"""`run_family`: the same procedure over every leg of a certified family."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.run_simulation import run, run_setup
from certkit.bench.setup import prepare
from certkit.definitions.loading.library import load
from certkit.grading import with_spread
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.overrides import Overrides
    from certkit.documents.result import Result


def run_family(
    procedure: str | Path,
    *,
    library: Library = (),
    overrides: Overrides | None = None,
) -> Result:
    """Run a procedure with the nominal leg and with every member of its family.

    Parameters
    ----------
    procedure, library, overrides
        As for `run`.

    Returns
    -------
    Result
        The nominal leg's, each criterion with its spread over the certified legs.
    """
    setup = prepare(procedure, library=library, overrides=overrides)
    nominal = run_setup(setup, library=library)
    legs = load("family", setup.legform.legform, library=library).document
    results = [nominal]
    for member in legs.members:
        changed = {**member.overrides(nominal.procedure), **(overrides or {})}
        results.append(_trusted_run(procedure, library, changed))
    return worded(with_spread(results))


def _trusted_run(procedure: str | Path, library: Library, overrides: Overrides) -> Result:
    """Run a member; where the run cannot be trusted, again with half the time step."""
    result = run(procedure, library=library, overrides=overrides, refine=False)
    if result.verdict != "error" or result.quality is None:
        return result
    half = {"run.time step": f"{result.quality.time_step / 2 * 1e6:g} µs"}
    return run(procedure, library=library, overrides={**overrides, **half}, refine=False)
