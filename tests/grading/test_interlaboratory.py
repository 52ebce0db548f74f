"""Repeatability, reproducibility and the tests for outliers, against published figures."""

from __future__ import annotations

import math

import numpy as np
import pytest
from support.several_laboratories import PRINTED, level

from certkit.grading.interlaboratory import (
    cochran_critical,
    grubbs_critical,
    precision,
    robust_mean,
    statistics_by_laboratory,
)


@pytest.mark.parametrize("number", range(4))
def test_the_standard_example_comes_out_to_the_printed_digit(number: int) -> None:
    found = precision(level(number))
    assert (round(found.mean, 3), round(found.within or 0, 3), round(found.total or 0, 3)) == PRINTED[number]


def test_critical_values_are_those_of_the_printed_tables() -> None:
    # The tables cut the last digit off where they do not round.
    assert cochran_critical(0.05, 8, 2, 14) == pytest.approx(0.516, abs=1e-3)
    assert cochran_critical(0.01, 8, 2, 14) == pytest.approx(0.615, abs=1e-3)
    assert grubbs_critical(0.05, 8) == pytest.approx(2.126, abs=1e-3)
    assert grubbs_critical(0.01, 8) == pytest.approx(2.274, abs=1e-3)


def test_a_laboratory_that_scatters_is_cochrans_and_one_that_lies_apart_is_grubbs() -> None:
    calm = {f"lab {i}": (10.0 + 0.1 * i, 10.02 + 0.1 * i, 9.98 + 0.1 * i) for i in range(7)}
    scattered = statistics_by_laboratory({**calm, "odd": (9.0, 10.0, 11.0)})
    apart = statistics_by_laboratory({**calm, "odd": (14.0, 14.02, 13.98)})
    assert scattered["odd"].found == (("cochran", "outlier"),)
    assert apart["odd"].found == (("grubbs", "outlier"),)
    assert [name for name, row in apart.items() if row.found] == ["odd"]
    assert apart["odd"].z is not None
    assert apart["odd"].z > 3


@pytest.mark.parametrize("number", range(4))
def test_mandels_k_counts_every_laboratory_alike(number: int) -> None:
    """By the standard k² is one in the mean, whatever numbers of tests the laboratories made."""
    found = statistics_by_laboratory(level(number))
    assert sum((row.k or 0.0) ** 2 for row in found.values()) == pytest.approx(len(found))


def test_single_tests_give_no_repeatability_but_a_spread() -> None:
    found = precision({"a": [1.0], "b": [2.0], "c": [3.0]})
    assert (found.within, found.between, found.total) == (None, None, pytest.approx(1.0))


def test_equal_means_leave_nothing_to_the_laboratories() -> None:
    found = precision({"a": [1.0, 3.0], "b": [3.0, 1.0]})
    assert found.between == 0
    assert found.total == found.within == pytest.approx(math.sqrt(2))


def test_equal_values_are_no_scatter_whatever_their_last_bits() -> None:
    found = statistics_by_laboratory({str(count): [22.1] * count for count in (3, 1, 2, 5, 7)})
    assert {(row.h, row.k, row.found) for row in found.values()} == {(None, None, ())}


@pytest.mark.parametrize("counts", [(3,) * 8, (5, 5, 5, 5, 2, 2, 2), (10, 2)], ids=str)
def test_laboratories_that_scatter_alike_are_stragglers_in_one_round_of_twenty(
    counts: tuple[int, ...],
) -> None:
    """However unequal their numbers of tests: with the usual number for all it was up to every other one."""
    chance, rounds = np.random.default_rng(7), 1000
    called = sum(
        any(
            test == "cochran"
            for row in statistics_by_laboratory(
                {str(number): chance.normal(size=count).tolist() for number, count in enumerate(counts)}
            ).values()
            for test, _ in row.found
        )
        for _ in range(rounds)
    )
    # Within four standard deviations of the count.
    assert called / rounds == pytest.approx(0.05, abs=4 * (0.05 * 0.95 / rounds) ** 0.5)


def test_a_wild_value_moves_the_robust_mean_little() -> None:
    calm, _ = robust_mean([9.8, 9.9, 10.0, 10.1, 10.2])
    wild, _ = robust_mean([9.8, 9.9, 10.0, 10.1, 1000.0])
    assert calm == pytest.approx(10.0, abs=0.01)
    assert wild == pytest.approx(10.0, abs=0.15)
