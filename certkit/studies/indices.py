"""Morris screening and Sobol indices, by SALib (an extra)."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.errors import RunError, UsageError
from certkit.studies.designs import at_shares, check_runs

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd
    from numpy.typing import NDArray

    from certkit.studies.factors import Factor
    from certkit.studies.points import Point

LEVELS = 4  # of a Morris grid, as Morris (1991) recommends


def morris_design(factors: Sequence[Factor], trajectories: int, seed: int) -> list[Point]:
    """Return the runs of a Morris screening: trajectories × (k + 1)."""
    check_runs(trajectories * (len(factors) + 1), len(factors), "morris screening")
    sample = _salib("SALib.sample.morris").sample
    return at_shares(factors, sample(_problem(factors), trajectories, num_levels=LEVELS, seed=_seed(seed)))


def morris_indices(
    table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str], seed: int
) -> pd.DataFrame:
    """Return each factor's mean effect over its range, its strength and how far that depends on the others.

    Columns `output`, `factor`, `mean`, `strength`, `strength_interval`, `nonlinearity` (Morris' μ, μ*, σ).
    """
    import pandas as pd  # noqa: PLC0415  # slow to import

    sample = _salib("SALib.sample.morris").sample
    analyze = _salib("SALib.analyze.morris").analyze
    trajectories = len(table) // (len(factors) + 1)
    shares = sample(_problem(factors), trajectories, num_levels=LEVELS, seed=_seed(seed))
    rows = []
    for output in outputs:
        y = _complete(table, output)
        found = analyze(_problem(factors), shares, y, num_levels=LEVELS, seed=_seed(seed))
        rows += [
            {
                "output": output,
                "factor": factor.name,
                "mean": float(found["mu"][i]),
                "strength": float(found["mu_star"][i]),
                "strength_interval": float(found["mu_star_conf"][i]),
                "nonlinearity": float(found["sigma"][i]),
            }
            for i, factor in enumerate(factors)
        ]
    return pd.DataFrame(rows)


def sobol_design(factors: Sequence[Factor], samples: int, seed: int) -> list[Point]:
    """Return the runs for Sobol indices: samples × (k + 2), samples a power of two."""
    power = 1 << (samples - 1).bit_length()
    check_runs(power * (len(factors) + 2), len(factors), "study of sobol indices")
    sample = _salib("SALib.sample.sobol").sample
    return at_shares(factors, sample(_problem(factors), power, calc_second_order=False, seed=_seed(seed)))


def sobol_indices(
    table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str], seed: int
) -> pd.DataFrame:
    """Return first-order and total indices with their 95 % bootstrap intervals.

    Columns `output`, `factor`, `first`, `first_interval`, `total`, `total_interval`; intervals are
    half-widths. An output that never changes has no indices and is left out.
    """
    import pandas as pd  # noqa: PLC0415  # slow to import

    analyze = _salib("SALib.analyze.sobol").analyze
    rows = []
    for output in outputs:
        y = _complete(table, output)
        if np.ptp(y) == 0:
            continue
        found = analyze(_problem(factors), y, calc_second_order=False, seed=_seed(seed))
        rows += [
            {
                "output": output,
                "factor": factor.name,
                "first": float(found["S1"][i]),
                "first_interval": float(found["S1_conf"][i]),
                "total": float(found["ST"][i]),
                "total_interval": float(found["ST_conf"][i]),
            }
            for i, factor in enumerate(factors)
        ]
    return pd.DataFrame(rows)


def _problem(factors: Sequence[Factor]) -> dict[str, Any]:
    """Describe the factors as shares of probability: their distributions are ours."""
    names = [factor.name for factor in factors]
    return {"num_vars": len(names), "names": names, "bounds": [[0.0, 1.0]] * len(names)}


def _complete(table: pd.DataFrame, output: str) -> NDArray[np.float64]:
    y = table[output].to_numpy(dtype=np.float64)
    missing = int(np.isnan(y).sum())
    if missing:
        raise RunError(f"{missing} runs have no {output}; these indices need every run: narrow the ranges")
    return y


def _seed(seed: int) -> int:
    # SALib takes 0 for "no seed".
    return seed + 1


def _salib(module: str) -> Any:  # noqa: ANN401  # SALib is untyped
    try:
        return import_module(module)
    except ImportError:
        raise UsageError("this design needs SALib: pip install 'certkit[sensitivity]'") from None
