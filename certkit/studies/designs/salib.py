"""SALib, an extra, in one place: its problem in shares of probability, and the outputs that it takes."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.errors import RunError, UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd
    from numpy.typing import NDArray

    from certkit.studies.factors import Factor


def problem(factors: Sequence[Factor]) -> dict[str, Any]:
    """Describe the factors as shares of probability: their distributions are ours."""
    names = [factor.name for factor in factors]
    return {"num_vars": len(names), "names": names, "bounds": [[0.0, 1.0]] * len(names)}


def complete(table: pd.DataFrame, output: str) -> NDArray[np.float64]:
    """Return an output of all runs, shape (n,), in its unit.

    Raises
    ------
    RunError
        When a run has none.
    """
    y = table[output].to_numpy(dtype=np.float64)
    missing = int(np.isnan(y).sum())
    if missing:
        raise RunError(f"{missing} runs have no {output}; these indices need every run: narrow the ranges")
    return y


def salib_seed(seed: int) -> int:
    """Return a seed as SALib takes it: 0 is none there."""
    return seed + 1


def salib(module: str) -> Any:  # noqa: ANN401  # SALib is untyped
    """Import a module of SALib.

    Raises
    ------
    UsageError
        When the extra is not installed.
    """
    try:
        return import_module(module)
    except ImportError:
        raise UsageError("this design needs SALib: pip install 'certkit[sensitivity]'") from None
