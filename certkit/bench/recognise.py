"""certkit's own `channels.csv`, known by the `result.json` it was written beside.

The table alone does not say whether its test was simulated, nor what the conditions were; the document does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.channel_curves import recording_of
from certkit.documents.result import Result
from certkit.errors import DataError

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.signals import Recording


def recognised(path: Path) -> Recording | None:
    """Return the recording of the result beside a `channels.csv`, when the table is that result's own.

    Returns
    -------
    Recording or None
        None for any other file, and for a table that was changed since.
    """
    document = path.parent / "result.json"
    if path.name != "channels.csv" or not document.is_file():
        return None
    from certkit.exchange.channels_csv import channels_csv  # noqa: PLC0415  # only for this one comparison

    try:
        result = Result.read(document)
        table = channels_csv(result)
    except DataError:
        return None
    if table is None or table.encode() != path.read_bytes():
        return None
    return recording_of(result, path.name)
