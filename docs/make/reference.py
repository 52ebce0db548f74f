"""The reference pages: made from the code, so that they say what the code does."""

from __future__ import annotations

from pathlib import Path

from certkit.files import write_whole
from docs.make.commands import commands
from docs.make.definitions import definitions
from docs.make.result import result

DOCS = Path(__file__).parents[1]

PAGES = {"commands.md": commands, "definitions.md": definitions, "result.md": result}


def write_reference(folder: Path = DOCS) -> list[Path]:
    """Write all reference pages into a folder, and return them."""
    written = []
    for name, make in PAGES.items():
        write_whole(folder / name, make())
        written.append(folder / name)
    return written
