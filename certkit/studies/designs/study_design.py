"""What a design of a study is: where its runs are, and what is read off them."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    import pandas as pd
    from numpy.typing import NDArray

    from certkit.definitions.study import Design
    from certkit.studies.factors import Factor
    from certkit.studies.points import Point


class StudyDesign:
    """Base of the designs; each overrides what concerns it, and at least `points`."""

    fits_models: ClassVar[bool] = True
    """Whether its runs are spread enough for the quick models."""

    def points(
        self, design: Design, factors: Sequence[Factor], correlation: NDArray[np.float64] | None
    ) -> list[Point]:
        """Return its runs.

        Parameters
        ----------
        design : Design
            The study's own numbers: `runs`, `levels`, `seed` …
        factors : sequence of Factor, length k
        correlation : ndarray, shape (k, k), optional
            Of the factors' normal scores; only where `certkit.definitions.study.DESIGNS` lets them correlate.
        """
        raise NotImplementedError

    def effects(self, table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str]) -> pd.DataFrame:
        """Return the main effects; see `certkit.studies.effects.main_effects`."""
        from certkit.studies.effects import main_effects  # noqa: PLC0415  # scipy is slow to import

        return main_effects(table, factors, outputs)

    def indices(
        self, table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str], seed: int
    ) -> pd.DataFrame | None:
        """Return sensitivity indices with the columns of `SensitivityIndex`; None where it has none."""
        del table, factors, outputs, seed
        return None
