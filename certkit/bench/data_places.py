"""Places in data as a document names them: without the folders above, wherever the data lie."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.reasons import Reason

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.reasons import Value
    from certkit.signals import Recording


def without_folders(recording: Recording, data: Path) -> Recording:
    """Return a recording whose notes, and those of its channels, name files from the test's own name on.

    Parameters
    ----------
    recording : Recording
        As read; messages of the readers name files as the user did, with folders.
    data : Path
        What the user named.
    """
    above = str(data.parent)
    if above == ".":
        return recording
    prefix = above if above.endswith(("/", "\\")) else f"{above}{'/' if '/' in str(data) else chr(92)}"

    def shorter(value: Value) -> object:
        if isinstance(value, list):
            return [note(each) if isinstance(each, Reason) else shorter(each) for each in value]
        return value.replace(prefix, "") if isinstance(value, str) else value

    def note(reason: Reason) -> Reason:
        return reason.model_copy(
            update={"parameters": {name: shorter(each) for name, each in reason.parameters.items()}}
        )

    channels = {
        name: replace(each, notes=tuple(map(note, each.notes))) for name, each in recording.channels.items()
    }
    return replace(recording, notes=tuple(map(note, recording.notes)), channels=channels)
