"""Reports of documents that are no results: which format becomes which file, made by which function."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from certkit.errors import MissingPartError
from certkit.files import write_whole
from certkit.reporting.left_out import leave_out

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping
    from pathlib import Path

    from certkit.documents.output_document import OutputDocument

TRANSLATED = ("html", "pdf")
"""Formats that are made in each language."""


def write_named(
    document: OutputDocument,
    out: Path,
    formats: Collection[str],
    files: Mapping[str, tuple[str, str]],
    spoken: str,
    on_paper: Mapping[str, str],
) -> list[Path]:
    """Write the wanted reports into a folder, and return what was written.

    Those that people work on, and those that programs read, are English. One that needs something that is not
    installed is left out, with a `LeftOutWarning`.

    Parameters
    ----------
    document : OutputDocument
    out : Path
        Folder.
    formats : collection of str
    files : mapping of str to (str, str)
        By format: the file's name, and `module:function` that makes its content of the document.
    spoken : str
        Language of those that people read.
    on_paper : mapping of str to str
        What the PDF's function is told beside.
    """
    written = []
    for name, (file, home) in files.items():
        if name not in formats:
            continue
        module, _, function = home.partition(":")
        try:
            make = getattr(import_module(module), function)
            content = (
                make(document, spoken=spoken, **(on_paper if name == "pdf" else {}))
                if name in TRANSLATED
                else make(document)
            )
        except MissingPartError as error:
            leave_out(file, error)
            continue
        write_whole(out / file, content)
        written.append(out / file)
    return written
