"""For formats that put a whole run into one file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.definitions.extraction_case import HistoryFiles


def one_file(paths: Sequence[Path], section: HistoryFiles) -> Path:
    """Return the file.

    Raises
    ------
    DataError
        When the case names several.
    """
    if len(paths) != 1:
        raise DataError(
            f"{paths[1]}: the format `{section.format}` is read from one file; leave the others out"
        )
    return paths[0]
