"""Flesh that bends beside a bone, at one joint: an elastic skin, and foam that gives back less than it took.

Moment M = k_s·φ + M_f with the angle φ of the lower against the upper body and the skin's stiffness k_s. The
foam's moment M_f moves with the slope k_e, and stays between its loading and its unloading line:

    dM_f = k_e·dφ   within   H·k_f·φ ≤ M_f ≤ k_f·φ     (φ > 0; mirrored below)

with its stiffness k_f on the way there and the hysteresis factor H. Speed has no influence. What it gives
back from (φ, M_f) on is S = (M_f² - M*²)/(2·k_e) + H·k_f·φ*²/2, where the slope k_e meets M* = H·k_f·φ*.

Source: one-dimensional tabulated foam as explicit finite-element codes have it (elastic between the loading
curve and the unloading curve), strained in proportion to the distance from the bone's axis.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class FoamSleeve(ForceLaw, kw_only=True):
    """The sleeve at one joint.

    Parameters
    ----------
    upper, lower : Body
    skin, foam, elastic : float
        k_s, k_f and k_e, N·m/rad.
    hysteresis : float
        H.
    angle, moment, stored : State
        φ (rad), M_f (N·m) and S (J) a step ago.
    """

    upper: Body
    lower: Body
    skin: float
    foam: float
    elastic: float
    hysteresis: float
    angle: State = 0.0
    moment: State = 0.0
    stored: State = 0.0

    @staticmethod
    @compiled
    def forces(sleeves: Rows[FoamSleeve], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the sleeve's moments."""
        for i in range(len(sleeves)):
            sleeve = sleeves[i]
            upper, lower = sleeve.upper, sleeve.lower
            angle = now.pose[lower].angle - now.pose[upper].angle
            way = 1.0 if angle >= 0.0 else -1.0
            turned = way * angle
            tried = way * (sleeve.moment + sleeve.elastic * (angle - sleeve.angle))
            least = sleeve.hysteresis * sleeve.foam
            held = min(max(tried, least * turned), sleeve.foam * turned)
            met = (sleeve.elastic * turned - held) / (sleeve.elastic - least)
            stored = 0.5 * (held * held - (least * met) ** 2) / sleeve.elastic + 0.5 * least * met * met
            moment = way * held
            totals.dissipated += (
                0.5 * (moment + sleeve.moment) * (angle - sleeve.angle) - stored + sleeve.stored
            )
            sleeve.angle = angle
            sleeve.moment = moment
            sleeve.stored = stored
            moment += sleeve.skin * angle
            totals.stored += stored + 0.5 * sleeve.skin * angle * angle
            load[lower].torque -= moment
            load[upper].torque += moment
