"""One door for measured data: the container tells which reader it needs."""

from __future__ import annotations

from fnmatch import fnmatch
from typing import TYPE_CHECKING

from certkit.definitions.loading.channel_tables import default_channels
from certkit.errors import DataError
from certkit.exchange.csv_read import read_csv
from certkit.exchange.mme_read import read_mme

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
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
    """Read a measured test (ISO-MME folder, zip archive or `.mme` file, CSV file) or a finite-element run.

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
    if mapping is not None and mapping.finite_elements is not None:
        from certkit.exchange.fe.read_run import read_run  # noqa: PLC0415  # few read finite elements

        table = _legform(mapping.finite_elements.channels, tables or (default_channels(),))
        return read_run(path, mapping, mapping.finite_elements, table)
    if path.is_dir() or path.suffix.lower() in {".zip", ".mme"}:
        return read_mme(path, mapping, lenient=lenient, tables=tables)
    if path.suffix.lower() in {".csv", ".txt", ".tsv"} or (mapping and mapping.csv):
        return read_csv(path, mapping, lenient=lenient, tables=tables)
    from certkit.exchange.fe.readers import usual_files  # noqa: PLC0415  # only where nothing else fits

    if any(fnmatch(path.name, pattern) for usual in usual_files() for pattern in usual):
        raise DataError(
            f"{path}: a finite-element run; say with --mapping which of its histories are channels (`finite "
            "elements`)"
        )
    raise DataError(
        f"{path}: not an ISO-MME folder, .zip or .mme, and not a .csv file; name one of these, or use "
        "--mapping"
    )


def _legform(names: Collection[str], tables: Sequence[ChannelTable]) -> ChannelTable:
    """Return the legform that most of the names are channels of; the first of equals."""
    return max(tables, key=lambda known: sum(name in known.kinds for name in names))
