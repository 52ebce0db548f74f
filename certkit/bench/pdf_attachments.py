"""The files that a certificate's PDF carries, and the list of their hashes."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from certkit.documents.result import Result
from certkit.errors import DataError
from certkit.files.bounded import read_bounded
from certkit.reporting.attachments import MANIFEST, SCHEMA
from certkit.reporting.language import ENGLISH
from certkit.reporting.language_list import languages

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from certkit.reporting.report_formats import Paper

MOST = 500
"""Attachments; a suite of seven procedures has about fifty."""
A4_WIDTH = 595.3
"""Points; Letter is 612 wide."""


class Attached(Struct, frozen=True):
    """What is attached: bytes by name, the hashes of the manifest by name, and how the pages were made.

    Parameters
    ----------
    files : mapping of str to bytes
        Without the manifest.
    listed : mapping of str to str
        Hash of each by the manifest.
    paper : {'A4', 'Letter'}
    created : datetime, optional
        Date that the PDF bears.
    language : str
        Of the pages.
    title : str, optional
        Of a bound suite.
    certificates : tuple of str
        Ids by the manifest, in the order of the pages.
    """

    files: Mapping[str, bytes]
    listed: Mapping[str, str]
    paper: Paper
    created: datetime | None
    language: str = ENGLISH
    title: str | None = None
    certificates: tuple[str, ...] = ()

    @property
    def results(self) -> dict[str, bytes]:
        """Return the results among the files, by name: `result.json`, or several with a prefix before it."""
        name = Result.file_name
        return {
            each: content
            for each, content in sorted(self.files.items())
            if each == name or each.endswith(f"-{name}")
        }


def attachments_of(path: Path, content: bytes | None = None) -> Attached:
    """Read the attachments of a PDF. Nothing in it is shown or run.

    Parameters
    ----------
    path : Path
    content : bytes, optional
        The file, where it has been read already.

    Raises
    ------
    DataError
        When it is no PDF, is damaged, or carries no manifest.
    """
    paper, created, found = _opened(path, read_bounded(path) if content is None else content)
    files = dict(found)
    if len(files) != len(found):
        raise DataError(f"{path}: two attachments of one name; only certificates as made can be verified")
    if MANIFEST not in files:
        raise DataError(
            f"{path}: carries no {MANIFEST}; only certificates that certkit wrote can be verified"
        )
    manifest = files.pop(MANIFEST)
    try:
        listed: Any = json.loads(manifest)
        if listed["schema"] != SCHEMA:
            raise DataError(
                f"{path}: {MANIFEST} has the schema {listed['schema']!r}; this certkit knows {SCHEMA}"
                "; verify it with the certkit that made it"
            )
        hashes = {str(item["name"]): str(item["sha256"]) for item in listed["attachments"]}
    except (ValueError, KeyError, TypeError) as error:
        raise DataError(
            f"{path}: {MANIFEST} is damaged; the certificate was changed since it was made"
            "; ask its maker for the original"
        ) from error
    spoken = str(listed.get("language", ENGLISH))
    spoken = spoken if spoken in languages() else ENGLISH
    title = listed.get("title")
    ids = tuple(map(str, listed.get("certificates", ())))
    return Attached(files, hashes, paper, created, spoken, None if title is None else str(title), ids)


def _opened(path: Path, content: bytes) -> tuple[Paper, datetime | None, list[tuple[str, bytes]]]:
    """Open the PDF with PDFium, which is made for files that nobody vouches for."""
    import pypdfium2  # noqa: PLC0415  # only where a PDF is verified

    try:
        document: Any = pypdfium2.PdfDocument(content)
        try:
            count = document.count_attachments()
            if count > MOST:
                raise DataError(
                    f"{path}: {count} attachments; this is no certificate of certkit"
                    "; name one that certkit wrote"
                )
            width = document[0].get_size()[0]
            attached = [document.get_attachment(index) for index in range(count)]
            created = _date(document.get_metadata_dict().get("CreationDate", ""))
            found = [(each.get_name(), bytes(each.get_data())) for each in attached]
        finally:
            document.close()
    except pypdfium2.PdfiumError as error:
        raise DataError(f"{path}: not a whole PDF ({error}); take the file as it was handed over") from error
    return ("A4" if abs(width - A4_WIDTH) < 1 else "Letter"), created, found


def _date(words: str) -> datetime | None:
    """Read `D:20260305000000Z`, as WeasyPrint writes it; None for anything else."""
    try:
        return datetime.strptime(words, "D:%Y%m%d%H%M%SZ").replace(tzinfo=UTC)
    except ValueError:
        return None
