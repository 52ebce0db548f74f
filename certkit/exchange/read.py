"""One door for measured data: the container tells which reader it needs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.errors import DataError
from certkit.exchange.csv_read import read_csv
from certkit.exchange.mme_read import read_mme

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.definitions.channel_mapping import Mapping
    from certkit.definitions.channels import ChannelTable
    from certkit.exchange.measured import MeasuredData


def read_recording(
    path: Path,
    mapping: Mapping | None = None,
    *,
    lenient: bool = False,
    tables: Sequence[ChannelTable] = (),
) -> MeasuredData:
    """Read a measured test: an ISO-MME folder, zip archive or `.mme` file, or a CSV file.

    Parameters
    ----------
    path : Path
        What the user named.
    mapping : Mapping, optional
        A laboratory's own columns, codes, signs and conditions.
    lenient : bool
        List assumptions instead of stopping at departures from the standard.
    tables : sequence of ChannelTable
        Channels of the legform that was tested, or of all that it may be; the shipped one when empty.

    Raises
    ------
    DataError
        One line that says what is wrong, where, and what to do.
    """
    if not path.exists():
        raise DataError(f"{path}: there is no such file or folder; check the name")
    if path.is_dir() or path.suffix.lower() in {".zip", ".mme"}:
        return read_mme(path, mapping, lenient=lenient, tables=tables)
    if path.suffix.lower() in {".csv", ".txt", ".tsv"} or (mapping and mapping.csv):
        return read_csv(path, mapping, lenient=lenient, tables=tables)
    raise DataError(
        f"{path}: not an ISO-MME folder, .zip or .mme, and not a .csv file; name one of these, or use "
        "--mapping"
    )
