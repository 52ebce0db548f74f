"""A chain of masses and hysteretic springs with known laws, integrated by scipy: each law comes back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from certkit.definitions.extraction_case import Case
from certkit.identification.five_steps import extract

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.identification import ExtractionResult

MASSES = (6.0, 1.2, 2.0)  # impactor, fascia, beam
SPEED = 8.0


@dataclass(frozen=True)
class Known:
    """A law as the textbook would write it: points, unloading stiffness, residual share, permanent set."""

    points: tuple[tuple[float, float], ...]
    unloading: float
    residual: float
    rest: float

    def loading(self, x: float) -> float:
        xs, fs = zip(*self.points, strict=True)
        return float(np.interp(x, xs, fs))

    def force(self, x: float, top: float) -> float:
        if x <= 0:
            return 0.0
        if x >= top:
            return self.loading(x)
        peak = self.loading(top)
        steep = peak - self.unloading * (top - x)
        span = top * (1 - self.rest)
        flat = self.residual * peak * max(x - self.rest * top, 0.0) / span
        return max(steep, flat, 0.0)


LAWS = (
    Known(((0, 0), (0.010, 6000), (0.030, 9000), (0.3, 40000)), 1.5e6, 0.15, 0.1),
    Known(((0, 0), (0.008, 7000), (0.020, 8000), (0.3, 60000)), 2.5e6, 0.25, 0.3),
    Known(((0, 0), (0.006, 6500), (0.012, 8500), (0.3, 80000)), 3.0e6, 0.0, 0.0),
)


def _shortenings(x: np.ndarray) -> np.ndarray:
    return np.array([x[0] - x[1], x[1] - x[2], x[2]])


@pytest.fixture(scope="module")
def chain() -> dict[str, np.ndarray]:
    def rate(_: float, y: np.ndarray) -> np.ndarray:
        x, v, tops = y[:3], y[3:6], y[6:9]
        s, w = _shortenings(x), _shortenings(v)
        f = np.array([law.force(s[i], max(tops[i], s[i])) for i, law in enumerate(LAWS)])
        a = np.array([-f[0] / MASSES[0], (f[0] - f[1]) / MASSES[1], (f[1] - f[2]) / MASSES[2]])
        grow = np.where((s >= tops) & (w > 0), w, 0.0)
        return np.concatenate([v, a, grow])

    time = np.arange(0, 0.025, 5e-5)
    start = np.array([0, 0, 0, SPEED, 0, 0, 0, 0, 0], dtype=float)
    run = solve_ivp(rate, (0, time[-1]), start, t_eval=time, max_step=1e-5, rtol=1e-7, atol=1e-9)
    x, v = run.y[:3], run.y[3:6]
    s = _shortenings(x)
    tops = np.maximum.accumulate(np.maximum(s, 0), axis=1)
    force = np.array(
        [[law.force(s[i, k], tops[i, k]) for k in range(time.size)] for i, law in enumerate(LAWS)]
    )
    return {"time": time, "x": x, "v": v, "s": s, "force": force}


@pytest.fixture(scope="module")
def found(chain: dict[str, np.ndarray], tmp_path_factory: pytest.TempPathFactory) -> ExtractionResult:
    folder = tmp_path_factory.mktemp("chain")
    names = ("impactor", "fascia", "beam")
    columns = {"time_ms": 1e3 * chain["time"]}
    for i, name in enumerate(names):
        columns[f"P_{name}_Ns"] = MASSES[i] * chain["v"][i]
        columns[f"x_{name}_mm"] = 1e3 * chain["x"][i]
    _write(folder / "chain.csv", columns)
    return extract(_case(), folder)


def _with_contact(chain: dict[str, np.ndarray], folder: Path, factor: float) -> ExtractionResult:
    """Extract the chain with a recorded contact between impactor and fascia that shows a share of it."""
    columns = {"time_ms": 1e3 * chain["time"]}
    for i, name in enumerate(("impactor", "fascia", "beam")):
        columns[f"P_{name}_Ns"] = MASSES[i] * chain["v"][i]
        columns[f"x_{name}_mm"] = 1e3 * chain["x"][i]
    columns["J_Ns"] = factor * MASSES[0] * (SPEED - chain["v"][0])
    _write(folder / "chain.csv", columns)
    fields = _case().model_dump(by_alias=True, mode="json", exclude_unset=True)
    fields["histories"]["contacts"] = {"front": {"impulse": "J_Ns"}}
    fields["paths"][0]["contact"] = "front"
    for path in fields["paths"][1:]:
        path["law"] = False
    return extract(Case.model_validate(fields), folder)


def test_impulse_closes_against_a_contact_that_was_recorded(
    chain: dict[str, np.ndarray], tmp_path: Path
) -> None:
    assert _with_contact(chain, tmp_path, 1.0).closed is True


@pytest.mark.parametrize("factor", [0.0, 0.97, 1.03])
def test_a_contact_that_is_dead_or_shows_another_impulse_does_not_close(
    chain: dict[str, np.ndarray], tmp_path: Path, factor: float
) -> None:
    result = _with_contact(chain, tmp_path, factor)
    assert result.closed is False
    assert "impulse does not close: impactor – fascia" in " ".join(result.warnings)
    assert max(c.percent for c in result.paths[0].closures) > 2.0


def test_an_impulse_known_from_one_side_only_is_neither_closed_nor_open(found: ExtractionResult) -> None:
    assert found.closed is None
    assert sum("nothing tells whether its impulse closes" in warning for warning in found.warnings) == 3


def _write(path: Path, columns: dict[str, np.ndarray]) -> None:
    rows = [",".join(columns)]
    rows += [",".join(f"{v:.9g}" for v in row) for row in zip(*columns.values(), strict=True)]
    path.write_text("\n".join(rows) + "\n")


def _case() -> Case:
    group = {"kind": "engine room"}
    return Case.model_validate(
        {
            "case": "chain",
            "title": "Chain with known laws",
            "origin": {"source": "test", "confidence": "verified"},
            "histories": {
                "format": "tidy csv",
                "files": ["chain.csv"],
                "parts": {
                    name: {"mass": f"{m} kg", "momentum": f"P_{name}_Ns", "displacement": f"x_{name}_mm"}
                    for name, m in zip(("impactor", "fascia", "beam"), MASSES, strict=True)
                },
            },
            "groups": {name: {**group, "parts": [name]} for name in ("impactor", "fascia", "beam")},
            "paths": [
                {"between": ["impactor", "fascia"]},
                {"between": ["fascia", "beam"]},
                {"between": ["beam", "ground"]},
            ],
        }
    )


@pytest.mark.parametrize("path", range(3))
def test_the_force_in_each_path_is_what_all_momentum_upstream_has_lost(
    chain: dict[str, np.ndarray], found: ExtractionResult, path: int
) -> None:
    wanted = chain["force"][path]
    error = np.abs(np.array(found.paths[path].force) - wanted)[10:-10]
    assert np.sqrt(np.mean(error**2)) < 0.01 * wanted.max()


@pytest.mark.parametrize("path", range(3))
def test_each_loading_curve_comes_back_within_one_per_cent_of_its_peak(
    chain: dict[str, np.ndarray], found: ExtractionResult, path: int
) -> None:
    law = found.paths[path].law
    assert law is not None
    top = float(chain["s"][path].max())
    x = np.linspace(0.02 * top, top, 100)
    wanted = np.array([LAWS[path].loading(v) for v in x])
    assert np.abs(np.interp(x, law.shortening, law.force) - wanted).max() < 0.01 * wanted.max()


@pytest.mark.parametrize("path", range(3))
def test_each_unloading_branch_comes_back_within_one_per_cent_of_the_peak_force(
    chain: dict[str, np.ndarray], found: ExtractionResult, path: int
) -> None:
    law = found.paths[path].law
    assert law is not None
    assert law.unloaded
    top = float(chain["s"][path].max())
    known = Known(
        tuple(zip(law.shortening, law.force, strict=True)), law.unloading, law.residual, law.permanent_set
    )
    x = np.linspace(0, top, 400)
    wanted = np.array([LAWS[path].force(v, top) for v in x])
    got = np.array([known.force(v, top) for v in x])
    # In the steep part a hundredth of a millimetre is a per cent of force, so compare along the curve's
    # normal.
    slack = 0.002 * top
    near = [np.abs(np.interp(x + d, x, got) - wanted) for d in np.linspace(-slack, slack, 21)]
    assert np.min(near, axis=0).max() < 0.01 * wanted.max()


def test_a_chain_without_dampers_gets_none(found: ExtractionResult) -> None:
    for path in found.paths:
        assert path.law is not None
        assert path.law.damping * SPEED < 0.01 * path.peak_force
