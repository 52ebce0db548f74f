"""Formats of finite-element histories, one file each, named by the format's words: `ls_dyna_binout.py`.

A new format is a file here and its words in `Format` of `certkit.definitions.history_formats`. The file has a
function `read(paths, section)`, which yields the `PartHistories` of an extraction. Where runs of the format
are graded as virtual tests too, it also has

- `open_run(paths, layout)`, which yields a `RunFiles`,
- `USUAL_FILES`, patterns of a run's files in its folder,
- `holds(content)`, which tells the format from the first file's bytes; the tidy table, which takes any, is
  asked last.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, get_args

from certkit.definitions.history_formats import TABLE, Format
from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes
from certkit.named_class import file_name

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.definitions.extraction_case import HistoryFiles
    from certkit.definitions.virtual_test import FiniteElements
    from certkit.exchange.fe.histories import PartHistories
    from certkit.exchange.fe.run_histories import RunFiles


def read_format(paths: Sequence[Path], section: HistoryFiles) -> PartHistories:
    """Read files of the format that the case names.

    Raises
    ------
    DataError
        For missing or damaged files, and for several where the format is one file.
    """
    found: PartHistories = _reader(section.format).read(paths, section)
    return found


def open_run(paths: Sequence[Path], layout: FiniteElements) -> RunFiles:
    """Open a run of the format that the mapping names, or that its first file is in.

    Raises
    ------
    DataError
        For missing or damaged files, and a format whose runs are not graded.
    """
    name = layout.format or _told(paths[0])
    reader = _reader(name)
    if not hasattr(reader, "open_run"):
        raise DataError(f"{paths[0]}: runs in the format `{name}` are not graded; convert it to a tidy table")
    run: RunFiles = reader.open_run(paths, layout)
    return run


def usual_files(format_: str | None = None) -> list[tuple[str, ...]]:
    """Return the patterns of a run's files, format by format, or of one format."""
    names = _names() if format_ is None else [format_]
    return [getattr(_reader(name), "USUAL_FILES", ()) for name in names]


def _told(path: Path) -> str:
    content, _ = read_bytes(path)
    for name in _names():
        reader = _reader(name)
        if hasattr(reader, "holds") and reader.holds(content):
            return name
    raise DataError(f"{path}: what kind of file this is cannot be told; name the `format` in the mapping")


def _names() -> list[str]:
    """Return the formats in the order in which they are asked."""
    return sorted(get_args(Format), key=lambda name: name == TABLE)


def _reader(name: str) -> Any:  # noqa: ANN401  # a module
    return import_module(f"{__name__}.{file_name(name)}")
