"""The model of one test with one part changed: its curves at the places where recordings are compared."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.channels import ELONGATION, MOMENT
from certkit.definitions.units import parse_quantity, split_quantity
from certkit.errors import UsageError
from certkit.signals import Filtered
from certkit.studies.quantity import share
from certkit.studies.trial import Trial

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.diagnosis import Diagnosis, SuspectPart
    from certkit.signals import Recording


class PartModel:
    """A procedure's simulation whose parts can be changed.

    Parameters
    ----------
    procedure : str
        Its name.
    overrides : mapping of str to str
        Values of the rig as the recording tells them.
    sheet : Diagnosis
    library : sequence of Path
        Folders with own definitions.

    Raises
    ------
    UsageError
        When the diagnosis names a path that the procedure does not have, or another unit than it has.
    """

    def __init__(
        self, procedure: str, overrides: Mapping[str, str], sheet: Diagnosis, library: Sequence[Path]
    ) -> None:
        """Find the values of all parts."""
        self.procedure = procedure
        # Which reads the definitions once for all changes.
        self._trial = Trial((procedure,), fixed=dict(overrides), library=tuple(map(str, library)))
        self.filter = sheet.filter
        end, step = parse_quantity(sheet.window, "time"), parse_quantity(sheet.step, "time")
        self.places: NDArray[np.float64] = np.arange(step, end + step / 2, step)
        self.parts = [part for part in sheet.parts if part.procedures is None or procedure in part.procedures]
        nominals = self._trial.nominals()
        self._values = {
            part.part: [_value(path, part, nominals) for path in part.paths] for part in self.parts
        }

    def usual(self, part: SuspectPart) -> float:
        """Return by how much a part usually differs: a share, or a shift in the unit of its values."""
        if part.usual_share is not None:
            found = share(part.usual_share)
            if found is None:
                raise UsageError(f"{part.part}: `{part.usual_share}` is no share such as `10 %`")
            return found
        number, unit = split_quantity(part.usual_shift or "") or (0.0, "")
        wanted = self._values[part.part][0][1]
        if unit != wanted or number <= 0:
            raise UsageError(f"{part.part}: `{part.usual_shift}` should be above zero and in {wanted}")
        return number

    def shown(self, part: SuspectPart) -> tuple[str, float]:
        """Return the unit that a change is shown in, and what it is multiplied with for it."""
        return ("%", 100.0) if part.usual_share is not None else (self._values[part.part][0][1], 1.0)

    def changed(self, part: SuspectPart, change: float) -> dict[str, NDArray[np.float64]]:
        """Return the curves, shape (places,) each, with one part changed; see `curves`."""
        shares = part.usual_share is not None
        values = self._values[part.part]
        return self.curves(
            {
                path: f"{number * (1 + change) if shares else number + change!r} {unit}".rstrip()
                for path, (number, unit) in zip(part.paths, values, strict=True)
            }
        )

    def curves(self, changes: Mapping[str, str]) -> dict[str, NDArray[np.float64]]:
        """Simulate, and return bone moments (N·m) and elongations (m) by channel, shape (places,) each."""
        from certkit.mechanics import simulate  # noqa: PLC0415  # the solver waits until something is run

        setup = self._trial.prepared(self.procedure, changes)
        recording = simulate(setup.procedure, setup.legform, vehicle=setup.vehicle).recording
        return self.at_places(Filtered(recording, [(name, self.filter) for name in gauges_of(recording)]))

    def at_places(self, filtered: Filtered) -> dict[str, NDArray[np.float64]]:
        """Return gauges of a recording, filtered, SI, shape (places,) each."""
        time = filtered.recording.time
        return {
            name: np.interp(self.places, time, filtered.values(name, self.filter))
            for name in gauges_of(filtered.recording)
        }


def gauges_of(recording: Recording) -> list[str]:
    """Return the bone moments and elongations of a recording."""
    return [name for name, c in recording.channels.items() if c.dimension in {MOMENT, ELONGATION}]


def _value(path: str, part: SuspectPart, nominals: Mapping[str, str]) -> tuple[float, str]:
    found = split_quantity(nominals[path]) if path in nominals else None
    if found is None:
        raise UsageError(f"{part.part}: the procedure has no number `{path}`; correct the diagnosis")
    return found
