"""Whether impulse closes: on every path that carries something, by two independent sides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from certkit.identification.first_steps import FirstSteps

STILL_PUSHING = 0.1
"""Share of the largest force of the impactor above which histories end in the middle of the impact."""


def closes(steps: FirstSteps, warnings: list[str]) -> bool | None:
    """Tell whether the impulse of every path that carries something closes; say where nothing tells.

    A path without a law of its own (`law: false`) may have no second side.

    Returns
    -------
    bool or None
        None when no balance misses the limit, but a path has none: its impulse is known from one side only.
    """
    limit = steps.case.settings.closure_limit
    if not steps.carrying or any(c.percent > limit for flow in steps.flows for c in flow.closures):
        return False
    one_sided = [flow.link.name for flow in steps.carrying if not flow.closures and flow.link.law]
    warnings += [
        f"{name}: nothing tells whether its impulse closes; record a contact or a ground spring"
        for name in one_sided
    ]
    return None if one_sided else True


def end_warnings(steps: FirstSteps) -> list[str]:
    """Warn of histories that end while the impactor still pushes: cut, or not run to the end."""
    impactors = {name for name, group in steps.case.groups.items() if group.kind == "impactor"}
    force = sum((f.force for f in steps.flows if f.link.source in impactors), np.zeros_like(steps.grid.time))
    largest = float(np.max(np.abs(force)))
    last = float(np.mean(np.abs(force[-max(1, force.size // 50) :])))
    if not impactors or largest <= 0 or last <= STILL_PUSHING * largest:
        return []
    end = 1e3 * float(steps.grid.time[-1])
    said = f"the histories end at {end:.4g} ms, while the impactor still pushes with {last:.0f} N of"
    return [f"{said} {largest:.0f} N: are they cut? Rebound and unloading lack"]


def closure_warnings(steps: FirstSteps) -> list[str]:
    """Return a warning for each balance that misses the limit."""
    limit = steps.case.settings.closure_limit
    seen: dict[str, str] = {}
    for flow in steps.flows:
        for closure in flow.closures:
            if closure.percent > limit:
                seen[closure.title] = (
                    f"impulse does not close: {closure.title}: {closure.residual:.3g} N·s of "
                    f"{closure.impulse:.3g} N·s "
                    f"({closure.percent:.1f} %); is a path, a part or a contact missing, or a path's "
                    "direction reversed?"
                )
    return list(seen.values())
