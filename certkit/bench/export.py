"""`export`: write the recording of a result, or of measured data, in another format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.bench.result_folder import write_alone
from certkit.bench.sources import load_source
from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.loading.channel_tables import all_channels
from certkit.definitions.loading.validation import read_document
from certkit.documents.unverified import MARK, is_marked
from certkit.errors import UsageError
from certkit.exchange.channels_csv import csv_text
from certkit.exchange.mme_write import mme_archive, write_mme
from certkit.reporting.language import worded_reasons

if TYPE_CHECKING:
    from certkit.definitions.loading.library import Library
    from certkit.documents.result import Result
    from certkit.signals import Recording


def export(
    source: str | Path | Result,
    target: str | Path,
    *,
    mapping: str | Path | None = None,
    library: Library = (),
    unverified: bool = False,
    force: bool = False,
) -> Path:
    """Write a recording as ISO-MME folder, archive (`.zip`) or CSV (`.csv`), as the target's name says.

    Parameters
    ----------
    source : str, Path or Result
        A result, its `result.json`, the folder of a run, or measured data.
    target : str or Path
        What is written; a folder must be new.
    mapping : str or Path, optional
        Mapping file with a laboratory's own ISO-MME codes to write with.
    library : str, Path, or sequence of them
        Folders with own legforms.
    unverified : bool
        Export a result that was changed since certkit wrote it as well, and say so in the file.
    force : bool
        Replace a file of other content.

    Returns
    -------
    Path
        What was written.

    Raises
    ------
    DataError
        When the source cannot be read, or was changed.
    UsageError
        When the target's name ends in something else, its folder exists, or its file with other content.
    """
    target = Path(target)
    own = read_document(Path(mapping), Mapping, all_channels(library)) if mapping is not None else None
    if target.suffix.lower() not in {"", ".csv", ".zip"}:
        raise UsageError(f"{target}: name a folder (ISO-MME), a .zip (ISO-MME archive) or a .csv file")
    loaded = load_source(source, library=library, unverified=unverified)
    if target.suffix.lower() == ".csv":
        marked = MARK if is_marked(loaded.result) else ""
        write_alone(target, csv_text(loaded.recording, result_id=marked), force=force)
        return target
    header = {"Title": loaded.result.title} if loaded.result else {}
    recording = _worded(loaded.recording)
    if target.suffix.lower() == ".zip":
        write_alone(target, mme_archive(recording, target.stem, header, own), force=force)
    else:
        write_mme(recording, target, header=header, mapping=own)
    return target


def _worded(recording: Recording) -> Recording:
    """Return the recording with the notes on its channels in words, as they stand in a channel file."""
    channels = {
        name: replace(channel, notes=tuple(worded_reasons(channel.notes)))
        for name, channel in recording.channels.items()
    }
    return replace(recording, channels=channels)
