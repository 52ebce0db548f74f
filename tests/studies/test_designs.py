"""Designs put the runs where they promise to, the same ones for the same seed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from certkit.definitions.study import StudyParameter
from certkit.errors import UsageError
from certkit.studies.designs.full_factorial import full_factorial
from certkit.studies.designs.latin_hypercube import latin_hypercube
from certkit.studies.designs.morris import morris_design
from certkit.studies.designs.one_at_a_time import one_at_a_time
from certkit.studies.designs.shares import correlation_matrix
from certkit.studies.designs.sobol_indices import sobol_design, sobol_indices
from certkit.studies.designs.sobol_sequence import sobol_sequence
from certkit.studies.factors import Factor, Levels, NormalFactor, Triangular, Uniform, factor_of

A = Factor("a", "mm", Uniform(0.0, 10.0), 4.0)
B = Factor("b", "kg", NormalFactor(5.0, 0.5))
C = Factor("c", "", Levels(("pinned", "free")), "pinned")


def test_one_at_a_time_varies_each_factor_alone_around_its_value_in_the_definitions() -> None:
    points = one_at_a_time([A, B, C], 3)
    assert points[0] == {"a": 4.0, "b": 5.0, "c": "pinned"}
    assert [p["a"] for p in points[1:4]] == [0.0, 5.0, 10.0]
    assert [p["b"] for p in points[4:6]] == [3.5, 6.5]
    assert points[6] == {**points[0], "c": "free"}
    assert len(points) == 7


def test_a_full_factorial_takes_every_combination_once() -> None:
    points = full_factorial([A, C], 4)
    assert len({tuple(p.items()) for p in points}) == len(points) == 8


MANY = [Factor(f"f{i}", "", Uniform(0.0, 1.0)) for i in range(20)]
BEYOND_REASON: dict[str, Callable[[], object]] = {
    "full factorial": lambda: full_factorial(MANY, 4),
    "one at a time": lambda: one_at_a_time(25 * MANY, 100),
    "latin hypercube": lambda: latin_hypercube(MANY, 600_000, 1),
    "sobol sequence": lambda: sobol_sequence([A], 1_000_000, 1),
    "morris screening": lambda: morris_design(MANY, 10_000_000, 1),
    "sobol indices": lambda: sobol_design(MANY, 500_000, 1),
}


@pytest.mark.parametrize("design", BEYOND_REASON)
def test_a_design_beyond_reason_is_refused_before_it_is_made(
    design: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for file in ("latin_hypercube", "sobol_sequence", "morris", "sobol_indices"):
        monkeypatch.setattr(f"certkit.studies.designs.{file}.at_shares", None)
    with pytest.raises(UsageError, match=rf"{design}.* has [\d,]+ runs; more than [\d,]+ are refused"):
        BEYOND_REASON[design]()


def test_a_latin_hypercube_has_one_run_in_every_slice() -> None:
    points = latin_hypercube([A, B], 50, seed=3)
    assert sorted(int(float(p["a"]) / 10 * 50) for p in points) == list(range(50))
    assert points == latin_hypercube([A, B], 50, seed=3)
    assert points != latin_hypercube([A, B], 50, seed=4)


def test_correlated_factors_keep_their_slices_and_get_their_correlation() -> None:
    matrix = correlation_matrix([A, B], [("a", "b", -0.7)])
    points = latin_hypercube([A, B], 200, 1, matrix)
    a, b = (np.array([p[name] for p in points], dtype=float) for name in "ab")
    assert sorted((a / 10 * 200).astype(int)) == list(range(200))
    assert np.corrcoef(a, b)[0, 1] == pytest.approx(-0.7, abs=0.04)


def test_correlations_that_contradict_each_other_are_refused() -> None:
    factors = [A, B, Factor("d", "", Uniform(0.0, 1.0))]
    with pytest.raises(UsageError, match="contradict"):
        correlation_matrix(factors, [("a", "b", 0.9), ("b", "d", 0.9), ("a", "d", -0.9)])


def test_a_sobol_sequence_is_rounded_up_to_a_power_of_two() -> None:
    assert len(sobol_sequence([A, B], 100, seed=0)) == 128


def test_quantiles_agree_with_scipy() -> None:
    stats = pytest.importorskip("scipy.stats")
    shares = [0.01, 0.2, 0.5, 0.77, 0.99]
    triangular = Triangular(1.0, 2.0, 5.0)
    expected = stats.triang(0.25, loc=1, scale=4).ppf(shares)
    assert [triangular.quantile(p) for p in shares] == pytest.approx(list(expected))
    expected = stats.truncnorm(-3, 3, loc=5, scale=0.5).ppf(shares)
    assert [B.distribution.quantile(p) for p in shares] == pytest.approx(list(expected))


def parameter(**how: object) -> StudyParameter:
    return StudyParameter.model_validate({"path": "rig.ram.speed", **how})


def test_a_share_is_taken_of_the_value_in_the_definitions() -> None:
    factor = factor_of(parameter(uniform="± 10 %"), {"rig.ram.speed": "20 m/s"})
    assert factor == Factor("rig.ram.speed", "m/s", Uniform(18.0, 22.0), 20.0)
    factor = factor_of(parameter(normal={"sd": "1 %"}), {"rig.ram.speed": "20 m/s"})
    assert factor.distribution == NormalFactor(20.0, 0.2)


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ({"uniform": ["1 m/s", "2 km/h"]}, "in m/s"),
        ({"uniform": ["2 m/s", "1 m/s"]}, "below the highest"),
        ({"uniform": "10 %"}, "nothing to take a share of"),
        ({"triangular": ["1 m/s", "3 m/s", "2 m/s"]}, "in this order"),
        ({"normal": {"mean": "1 m/s", "sd": "0 m/s"}}, "above zero"),
    ],
)
def test_what_makes_no_sense_is_said_so(how: dict[str, object], message: str) -> None:
    with pytest.raises(UsageError, match=message):
        factor_of(parameter(**how), {})


def test_one_way_of_varying_is_enough() -> None:
    with pytest.raises(ValueError, match="in one way"):
        parameter(uniform="10 %", values=[1, 2])


def test_an_output_that_changes_by_rounding_only_owes_nothing_to_any_factor() -> None:
    pd = pytest.importorskip("pandas")
    pytest.importorskip("SALib")
    points = sobol_design([A, B], 4, seed=1)
    digits = np.random.default_rng(1).normal(size=len(points))
    found = sobol_indices(pd.DataFrame({"y": 250.0 + 1e-12 * digits}), [A, B], ["y"], seed=1)
    assert found[["first", "total"]].to_numpy().tolist() == [[0.0, 0.0], [0.0, 0.0]]
