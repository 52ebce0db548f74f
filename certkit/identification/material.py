"""From a path's stiffness to engineering stress–strain, beside the material's own curve.

The conversion holds only where the block is crushed uniformly. It is refused where nodes spread over its
front do not move alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.extraction import MaterialResult
from certkit.errors import DataError
from certkit.exchange.fe.numeric_table import read_table

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import Material
    from certkit.exchange.fe import PartHistories
    from certkit.identification.sampling import Grid
    from certkit.identification.spring_law import SpringLaw

    Values = NDArray[np.float64]

MOST_SPREAD = 10.0
"""Per cent of the largest crush by which the front's nodes may differ.

Uniform crush stays below 3 %, local crush lies above 50 %.
"""


def front_spread(material: Material, histories: PartHistories, grid: Grid) -> float | None:
    """Return by how many per cent of their mean the front's nodes differ at the largest crush.

    None when no nodes are named.
    """
    if len(material.faces) < 2:
        return None
    moved = np.array([grid.resample(histories.node(node)) for node in material.faces])
    mean = moved.mean(axis=0)
    k = int(np.argmax(mean))
    return float(100 * np.ptp(moved[:, k]) / max(abs(float(mean[k])), 1e-9))


def convert(
    material: Material,
    area: float,
    law: SpringLaw,
    spread: float | None,
    folder: Path,
    history: tuple[Values, Values],
) -> tuple[MaterialResult, dict[str, str]]:
    """Convert a path's law to engineering stress–strain and compare it with the material's curve.

    The comparison is the rms of the stress difference over the crushed range from `strain from` on, in per
    cent of the material's largest stress there. `history` is shortening (m) and force (N) of the path,
    shape (n,) each; `area` is in m². `mean` is the mean relative difference, signed.

    Returns
    -------
    MaterialResult
    digests : dict of str to str
        SHA-256 of the curve's file.
    """
    length = float(material.length)
    x, force = history
    k = int(np.argmax(x))
    # The law goes on beyond the history; the comparison must not.
    reached = np.array([s for s in law.shortening if 0 <= s < x[k]] + [float(x[k])])
    strain, stress = reached / length, law.loading(reached) / area
    rms = mean = None
    reference_strain: Values = np.zeros(0)
    reference_stress: Values = np.zeros(0)
    digests: dict[str, str] = {}
    if material.curve is not None:
        reference_strain, reference_stress, digests = _curve(folder, material.curve)
        top = min(float(strain[-1]), float(reference_strain[-1]))
        if top <= material.strain_from:
            raise DataError(
                f"the block is crushed to a strain of {top:.2f} only; the comparison starts at "
                f"{material.strain_from:.2f}"
                "; lower `strain from`"
            )
        at = np.linspace(material.strain_from, top, 201)
        wanted = np.interp(at, reference_strain, reference_stress)
        found = np.interp(at, strain, stress)
        rms = float(100 * np.sqrt(np.mean((found - wanted) ** 2)) / np.max(wanted))
        mean = float(100 * np.mean((found - wanted) / wanted))
    result = MaterialResult(
        path=f"{material.path[0]} – {material.path[1]}",
        length=length,
        area=area,
        strain=tuple(map(float, strain)),
        stress=tuple(map(float, stress)),
        unloading_strain=tuple(map(float, x[k:] / length)),
        unloading_stress=tuple(map(float, force[k:] / area)),
        reference_strain=tuple(map(float, reference_strain)),
        reference_stress=tuple(map(float, reference_stress)),
        strain_from=material.strain_from,
        rms_percent=rms,
        mean_percent=mean,
        uniform=spread is None or spread <= MOST_SPREAD,
        spread_percent=spread,
    )
    return result, digests


def _curve(folder: Path, name: str) -> tuple[Values, Values, dict[str, str]]:
    path = folder / name
    if not path.resolve().is_relative_to(folder.resolve()):
        raise DataError(f"{name}: leads out of the case's folder; copy the file into {folder}")
    table = read_table(path)
    for column in ("eng_strain", "eng_stress_MPa"):
        if column not in table.columns:
            raise DataError(
                f"{path}: there is no column `{column}`; a material curve has eng_strain and eng_stress_MPa"
            )
    strain = table.columns["eng_strain"]
    if np.any(np.diff(strain) <= 0):
        raise DataError(f"{path}: eng_strain must rise from row to row; put its rows in their order")
    return strain, table.columns["eng_stress_MPa"] * 1e6, {name: table.digest}


def parse_area(text: str) -> float:
    """Read `40000 mm²` in m².

    Raises
    ------
    DataError
        For anything but a positive number of mm², cm² or m².
    """
    words = text.replace("^2", "²").split()
    factors = {"mm²": 1e-6, "cm²": 1e-4, "m²": 1.0, "mm2": 1e-6, "cm2": 1e-4, "m2": 1.0}
    try:
        area = float(words[0]) * factors[words[1]]
    except (IndexError, KeyError, ValueError):
        raise DataError(f"`{text}` is no area; write a number and mm², cm² or m²") from None
    if not (np.isfinite(area) and area > 0):
        raise DataError(f"`{text}` is no area above zero; write it like `40000 mm²`")
    return area
