"""What a time-history file of OpenRadioss holds, in the file's own units, whichever reader took it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct, field

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.exchange.fe.histories import Values


class Channels(Struct, frozen=True):
    """Everything an OpenRadioss time-history file holds, in the file's units.

    Parameters
    ----------
    time : ndarray, shape (n,)
    energies : mapping of str to ndarray
        Global energies by their solver name.
    parts, contacts, nodes : mapping of str to mapping of str to ndarray
        Variables (`XMOM`, `MASS`, `XCG`; `FNX`, `FTX`; `DX`, `VX`) by object name.
    impulses : bool
        Whether contact channels are impulses (native file) or forces (converted CSV).
    unread : tuple of str
        Heads of columns that nothing is known of.
    part_ids : mapping of str to int
        Where the file has them.
    notes : tuple of str
        What the reader has to say.
    """

    time: Values
    energies: Mapping[str, Values]
    parts: Mapping[str, Mapping[str, Values]]
    contacts: Mapping[str, Mapping[str, Values]]
    nodes: Mapping[str, Mapping[str, Values]]
    impulses: bool
    source: str
    digest: str
    unread: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    part_ids: Mapping[str, int] = field(default_factory=dict)
