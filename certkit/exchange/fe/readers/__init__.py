"""Readers of finite-element histories, one file each, named by the format's words: `ls_dyna_binout.py`.

A new format is a file here, with one function `read`, and its words in `certkit.definitions.extraction_case`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.definitions.extraction_case import HistoryFiles
    from certkit.exchange.fe.histories import PartHistories


def read_format(paths: Sequence[Path], section: HistoryFiles) -> PartHistories:
    """Read files of the format that the case names.

    Raises
    ------
    DataError
        For missing or damaged files, and for several where the format is one file.
    """
    name = section.format.replace(" ", "_").replace("-", "_")
    found: PartHistories = import_module(f"{__name__}.{name}").read(paths, section)
    return found
