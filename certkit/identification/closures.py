"""Whether impulse closes: on every path that carries something, by two independent sides."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.identification.first_steps import FirstSteps


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
