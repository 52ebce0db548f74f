"""What `compare` and `export` take: a result document, the folder of a run, or measured data."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.bench.regrade import embedded_channels
from certkit.bench.results_at_path import result_at
from certkit.definitions.loading.channel_tables import known_channels
from certkit.documents.channel_curves import recording_of
from certkit.documents.result import Result
from certkit.documents.unverified import MARK, is_marked
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from certkit.definitions.channel_mapping import Mapping
    from certkit.definitions.loading.library import Library
    from certkit.signals import Recording


class Source(Struct, frozen=True):
    """A recording under the name the user gave it, with the result it stands in, if any."""

    label: str
    recording: Recording
    result: Result | None = None


def load_source(
    source: str | Path | Result,
    mapping: Mapping | None = None,
    *,
    lenient: bool = False,
    library: Library = (),
    unverified: bool = False,
) -> Source:
    """Load what a path means, or take a result as it is.

    Parameters
    ----------
    source : str, Path or Result
        A result, its `result.json`, a folder that holds one, or measured data.
    mapping : Mapping, optional
        For measured data.
    lenient : bool
        Of measured data, list assumptions instead of stopping at departures.
    library : sequence of Path
        Folders with own legforms: measured data may be of any of them.
    unverified : bool
        Take a result file that was changed since certkit wrote it as well, marked as such.

    Raises
    ------
    DataError
        When it is none of them, is damaged, or was changed.
    """
    if isinstance(source, Result):
        # With the digits of its file, so that both are compared alike.
        written = source.as_written()
        return Source(written.procedure, _recording(written), written)
    path = Path(source)
    result = result_at(path, unverified=unverified)
    if result is not None:
        label = f"{_label(path)} ({MARK})" if is_marked(result) else _label(path)
        return Source(label, _recording(result), result)
    read = read_recording(path, mapping, lenient=lenient, tables=known_channels(library))
    return Source(_label(path), read.recording)


def _recording(result: Result) -> Recording:
    """Return a result's recording, with the channels of the legform whose definition it carries."""
    return recording_of(result, table=embedded_channels(result))


def _label(path: Path) -> str:
    """Name a source by its folder where its own name says nothing."""
    return path.parent.name or path.name if path.name == Result.file_name else path.name
