"""What a reader hands over: the recording, the files it came from, and every assumption that was made."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct, field

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from certkit.exchange.conditions import Told
    from certkit.reasons import Reason
    from certkit.signals.recording import Recording


class SourceFile(Struct, frozen=True):
    """A file that was read: its name as given and the SHA-256 of its bytes."""

    name: str
    sha256: str


class MeasuredData(Struct, frozen=True):
    """A recording with where it came from.

    Parameters
    ----------
    recording : Recording
        In SI units; its notes carry the assumptions.
    files : tuple of SourceFile
        Every file the recording rests on, sorted by name.
    assumptions : tuple of Reason
        What `lenient` let pass.
    header : mapping of str to str
        What the container says of the test: laboratory, title, date. Not trusted, only shown.
    told : mapping of str to Told
        The recording's conditions with the places that tell them.
    energies : mapping of str to ndarray
        Of a finite-element run: its energies on the recording's time axis, J.
    """

    recording: Recording
    files: tuple[SourceFile, ...]
    assumptions: tuple[Reason, ...] = ()
    header: Mapping[str, str] = field(default_factory=dict)
    told: Mapping[str, Told] = field(default_factory=dict)
    energies: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
