"""`Recording`: what a test yields, simulated or measured. Everything after it is shared by both."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from msgspec import Struct, field

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelTable, Dimension
    from certkit.reasons import Reason

RecordingKind = Literal["simulated", "measured", "virtual"]


def _shipped() -> ChannelTable:
    from certkit.definitions.loading.channel_tables import default_channels  # noqa: PLC0415  # reads a file

    return default_channels()


class Channel(Struct, frozen=True):
    """One measured or simulated quantity over the recording's time axis.

    Parameters
    ----------
    name : str
        Short name: `T1`, `MCL`, `contact force`.
    title : str
        The words of the field: `tibia moment 1`.
    dimension : Dimension
        Dimension with its SI unit and its unit at the borders.
    values : ndarray, shape (n,)
        SI values.
    filtered : str
        Filter the values have already seen (`CFC 180`), empty for raw values.
    notes : tuple of Reason
        What was assumed or done on the way here (offset removed, sign turned, …).
    """

    name: str
    title: str
    dimension: Dimension
    values: NDArray[np.float64]
    filtered: str = ""
    notes: tuple[Reason, ...] = ()


class Recording(Struct, frozen=True):
    """All channels of one test on one time axis; time zero is the first contact.

    Parameters
    ----------
    kind : {'simulated', 'measured', 'virtual'}
        Simulated here, measured in a laboratory, or computed by finite elements: the title of the certificate
        depends on it.
    time : ndarray, shape (n,)
        Seconds, uniform steps. Static tests have one sample a load level; their time is the level's end.
    channels : mapping of str to Channel
        By short name.
    conditions : mapping of str to float
        Conditions the test was done under, SI, by the words of the procedure's preconditions
        (`temperature` in kelvin, `ram mass` in kg, …). A missing one is unknown, not zero.
    notes : tuple of Reason
        What a reader made or assumed of the test as a whole.
    source : str
        File or procedure it came from.
    table : ChannelTable
        The channels of the legform that was tested: what is known of them beforehand. The shipped legform's
        when missing.
    from_solver : bool
        Whether it came here straight from the solver. A simulated recording that was read from a file may
        have been through other hands, and is doubted as any other.
    """

    kind: RecordingKind
    time: NDArray[np.float64]
    channels: Mapping[str, Channel]
    conditions: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[Reason, ...] = ()
    source: str = ""
    table: ChannelTable = field(default_factory=_shipped)
    from_solver: bool = False

    def __getitem__(self, name: str) -> Channel:
        """Return the channel of that short name; KeyError when it was not recorded."""
        return self.channels[name]

    def __contains__(self, name: object) -> bool:
        """Tell whether the channel was recorded."""
        return name in self.channels

    @property
    def interval(self) -> float:
        """Sampling interval in seconds."""
        return float(self.time[1] - self.time[0])
