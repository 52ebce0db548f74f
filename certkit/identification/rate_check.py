"""Whether what a law leaves unexplained follows the rate, and whether a material lies above its slow curve.

A spring's law is a curve over shortening. In one impact the rate falls while the shortening grows, so that
the loading curve takes up whatever the rate adds; what it cannot take up is in the residual r = F − F_law,
without a damper, over loading, unloading and ringing together. Where r goes with dx/dt, force depends on
the rate. A foam whose stiffening the curve took up shows only beside its own quasi-static curve.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.identification.displacement import shortening

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import Material
    from certkit.documents.extraction import MaterialResult
    from certkit.identification.balance import Flow
    from certkit.identification.first_steps import FirstSteps
    from certkit.identification.stiffness import SpringFit

    Values = NDArray[np.float64]

FOLLOWS = 0.5
"""Correlation of residual and rate from which on the residual follows the rate."""

WORTH = 1.0
"""Per cent of the peak force (rms) below which a residual is not worth a word."""

ACTS = 0.01
"""Share of the peak force above which a path acts."""

ABOVE = 10.0
"""Per cent by which stress may lie above the material's curve in the mean; the method itself reads 6 % low to
3 % high on foams without rate."""


def rate_correlation(fit: SpringFit, flow: Flow, steps: FirstSteps) -> tuple[float, float]:
    """Return how the residual without a damper goes with the rate, −1 to 1, and its rms in % of the peak."""
    x = shortening(flow.link, steps.displacements)
    rate = steps.grid.derivative(x)
    residual = flow.force - fit.law.spring_force(x)
    peak = float(np.max(np.abs(flow.force)))
    acting = np.abs(flow.force) > ACTS * peak
    left, speed = residual[acting], rate[acting]
    if left.size < 3 or not np.ptp(left) > 0 or not np.ptp(speed) > 0:
        return 0.0, 0.0
    return float(np.corrcoef(left, speed)[0, 1]), float(100 * np.sqrt(np.mean(left**2)) / peak)


def rate_remarks(
    fits: Mapping[str, SpringFit], steps: FirstSteps, warnings: list[str], notes: list[str]
) -> None:
    """Remark on the laws whose residual follows the rate."""
    for flow in steps.flows:
        fit = fits.get(flow.link.name)
        if fit is None:
            continue
        correlation, size = rate_correlation(fit, flow, steps)
        if correlation < FOLLOWS or size < WORTH:
            continue
        said = f"{flow.link.name}: its residual, {size:.1f} % rms, follows the rate (r = {correlation:.2f})"
        if fit.law.damping > 0:
            notes.append(f"{said}; a damper of {fit.law.damping:.3g} N·s/m takes it up to {fit.misfit:.1f} %")
        else:
            warnings.append(f"{said}, and no damper explains it: the law holds near the run's speed only")


def material_remark(material: Material, result: MaterialResult, flow: Flow, steps: FirstSteps) -> str | None:
    """Say by how much stress lies above the material's own curve, at which rates; None where it does not."""
    if result.mean_percent is None or result.mean_percent <= ABOVE:
        return None
    length = float(material.length)
    x = shortening(flow.link, steps.displacements)
    k = int(np.argmax(x))
    loading = x[: k + 1] / length >= material.strain_from
    rates = steps.grid.derivative(x)[: k + 1][loading] / length
    low, high = (float(np.quantile(rates, share)) for share in (0.1, 0.9))
    return (
        f"{flow.link.name}: its stress lies {result.mean_percent:.0f} % above the material's own curve, at "
        f"strain rates of mostly {low:.0f} to {high:.0f} /s; the material stiffens with the rate, or is "
        "another: one impact cannot tell them apart, and the law holds near the run's speed only"
    )
