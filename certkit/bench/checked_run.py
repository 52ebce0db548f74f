"""The finite-element run that an extraction is held to: its contacts, its first contact, its leg's flight."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.bench.channel_checks import POINTS
from certkit.bench.contact_places import axis_nodes
from certkit.definitions.fixtures.free_flight import FreeFlight

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import Settings
    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure
    from certkit.documents.extraction import ExtractionResult, GroupResult
    from certkit.exchange.fe import FrontData

    Values = NDArray[np.float64]

LASTS = 0.044
"""s from first contact: later a leg hardly touches a front."""

FIRST = 1e-6
"""Share of the whole impulse that tells the first contact."""

BEGUN = 1e-2
"""Share of the whole impulse by which contact has begun beyond doubt."""

NOISE = 4.0
"""An impulse below this many standard deviations of its noise is none."""

SAME = 0.005
"""Share by which two weights of a leg, or two speeds, are one."""


class CheckedRun(Struct, frozen=True, dict=True):
    """What the run says, on the uniform axis of the extraction up to the checks' end."""

    result: ExtractionResult
    data: FrontData
    settings: Settings

    @cached_property
    def until(self) -> float:
        """Return the checks' end, s on the run's axis: the case's, else `LASTS` after first contact."""
        given = self.settings.check_until
        until = self.start + LASTS if given is None else float(given)
        return min(until, self.result.times[-1])

    @cached_property
    def time(self) -> Values:
        """Return the axis, shape (n,), s."""
        times = np.array(self.result.times)
        return times[times <= self.until + 1e-9]

    @cached_property
    def impactor(self) -> GroupResult | None:
        """Return the impactor, None where the case has none."""
        return next((group for group in self.result.groups if group.kind == "impactor"), None)

    @cached_property
    def contacts(self) -> dict[str, tuple[Values, Values]]:
        """Return impulse (N·s) and force (N) of the impactor on each group, shape (n,) each."""
        n = self.time.size
        return {name: (impulse[:n], force[:n]) for name, (impulse, force) in self._whole_contacts.items()}

    @cached_property
    def _whole_contacts(self) -> dict[str, tuple[Values, Values]]:
        impactors = {group.name for group in self.result.groups if group.kind == "impactor"}
        return {
            path.target: (np.array(path.impulse), np.array(path.force))
            for path in self.result.paths
            if path.source in impactors
        }

    @cached_property
    def start(self) -> float:
        """Return the instant of first contact, s on the run's axis.

        Histories may hold noise, which second differences in the first half of the time before contact tell:
        those of a contact that merely begins are all alike.
        """
        times = np.array(self.result.times)
        total = np.abs(sum((i for i, _ in self._whole_contacts.values()), np.zeros_like(times)))
        most = float(np.max(total))
        if most <= 0:
            return float(times[0])
        begun = int(np.argmax(total > BEGUN * most))
        bends = np.diff(total[: begun // 2], n=2)
        noise = float(np.std(bends)) / np.sqrt(6.0) if bends.size > 1 else 0.0
        before = np.flatnonzero(total[: begun + 1] <= max(FIRST * most, NOISE * noise))
        return float(times[before[-1]]) if before.size else float(times[0])

    @property
    def axis(self) -> tuple[float, float, int]:
        """Return start and interval of the series that are kept, and of how many instants one is."""
        every = max(1, self.time.size // POINTS)
        return float(self.time[0]), float(self.time[1] - self.time[0]) * every, every

    def flight(self, procedure: Procedure) -> dict[str, object]:
        """Return how the run's leg flew, as changes of a procedure that throws one: speed, height, duration.

        Speed is the impactor's momentum over its mass, height that of the lowest node of the leg's axis. What
        the run does not tell stays the procedure's.
        """
        changes: dict[str, object] = {"run.until": f"{1e3 * (self.until - self.start):.4f} ms"}
        if procedure.rig.fixture(FreeFlight) is None or self.impactor is None:
            return changes
        speed = self.impactor.momentum[0] / self.impactor.mass
        if speed > 0:
            changes["rig.free flight.speed"] = f"{speed:.4g} m/s"
        axis = None if self.data.motion is None else axis_nodes(self.data.motion)
        if axis is not None:
            changes["rig.free flight.end above ground"] = f"{1e3 * axis[0, 0, 1]:.1f} mm"
        return changes

    def flight_remarks(self, procedure: Procedure, legform: Legform) -> tuple[list[str], list[str]]:
        """Return warnings and notes on how the run's leg differs from the one that the checks throw."""
        warnings: list[str] = []
        flight = procedure.rig.fixture(FreeFlight)
        if flight is None or self.impactor is None:
            return warnings, []
        own = legform.whole_mass(flesh=True)
        if abs(self.impactor.mass / own - 1.0) > SAME:
            warnings.append(
                f"the run's impactor weighs {self.impactor.mass:.4g} kg, the leg `{legform.legform}` of the "
                f"self-checks {own:.4g} kg; correct its mass in the case, or name its leg with `--procedure`"
            )
        said = (
            f"{float(flight.speed):.4g} m/s, {1e3 * float(flight.end_above_ground):.4g} mm above the ground"
        )
        return warnings, [f"self-checks throw the leg as the run did: {said}"]
