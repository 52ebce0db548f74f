"""`export`: write the recording of a result, or of measured data, in another format."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.sources import load_source
from certkit.errors import UsageError
from certkit.exchange.csv_write import write_csv
from certkit.exchange.mme_write import write_mme

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.definitions.channel_mapping import Mapping


def export(source: Path, target: Path, *, mapping: Mapping | None = None) -> None:
    """Write a recording as ISO-MME folder, archive (`.zip`) or CSV (`.csv`), as the target's name says.

    Parameters
    ----------
    source : Path
        `result.json`, the folder of a run, or measured data.
    target : Path
        What is written; a folder must be new.
    mapping : Mapping, optional
        A laboratory's own ISO-MME codes to write with.

    Raises
    ------
    DataError
        When the source cannot be read.
    UsageError
        When the target's name ends in something else, or its folder exists.
    """
    if target.suffix.lower() not in {"", ".csv", ".zip"}:
        raise UsageError(f"{target}: name a folder (ISO-MME), a .zip (ISO-MME archive) or a .csv file")
    loaded = load_source(source)
    if target.suffix.lower() == ".csv":
        write_csv(loaded.recording, target)
        return
    title = loaded.result.title if loaded.result else ""
    write_mme(loaded.recording, target, header={"Title": title} if title else {}, mapping=mapping)
