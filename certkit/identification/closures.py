"""Whether impulse closes: on every path that carries something, by two independent sides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.exchange.fe.histories import match_one

if TYPE_CHECKING:
    from certkit.identification.first_steps import FirstSteps

MISSED = 0.1
"""Share of what is missing below which a record that no path names is not the reason."""
MOST_NAMED = 4

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
    """Return a warning for each balance that misses the limit, and what was recorded and is in no path."""
    limit = steps.case.settings.closure_limit
    seen: dict[str, str] = {}
    largest = 0.0
    for flow in steps.flows:
        for closure in flow.closures:
            if closure.percent > limit:
                largest = max(largest, closure.residual)
                seen[closure.title] = (
                    f"impulse does not close: {closure.title}: {closure.residual:.3g} N·s of "
                    f"{closure.impulse:.3g} N·s "
                    f"({closure.percent:.1f} %); is a path, a part or a contact missing, or a path's "
                    "direction reversed?"
                )
    unused = _unused(steps, largest) if seen else []
    hint = [f"recorded, but in no path: {', '.join(unused)}; does one of them close the impulse?"]
    return [*seen.values(), *(hint if unused else [])]


def _unused(steps: FirstSteps, residual: float) -> list[str]:
    """Return contacts and ground springs that no path names, the likeliest to leave that residual first."""
    histories, links = steps.data.histories, steps.graph.links
    used = {match_one(name, histories.contacts, "contact", "") for link in links for name in link.contacts}
    held = {match_one(name, histories.springs, "spring", "") for link in links for name in link.springs}
    passed = {
        **{f"contact {n}": np.ptp(c.impulse) for n, c in histories.contacts.items() if n not in used},
        **{
            f"spring {n}": abs(float(np.trapezoid(s.force, histories.time)))
            for n, s in histories.springs.items()
            if n not in held
        },
    }
    near = sorted(
        (n for n, j in passed.items() if j > MISSED * residual), key=lambda n: abs(passed[n] - residual)
    )
    return [f"{name} ({passed[name]:.3g} N·s)" for name in near[:MOST_NAMED]]
