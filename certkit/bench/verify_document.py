"""Checks of a document's integrity: its id, its bytes, its words, the hashes of what it carries."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.bench.verification import Check, fails, holds, judged
from certkit.documents.result import Result
from certkit.exchange.channels_csv import channels_csv
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.documents.output_document import OutputDocument
    from certkit.documents.result import Provenance


def of_another_certkit(document: OutputDocument) -> bool:
    """Tell whether another version made a result: it may know other fields and words."""
    return isinstance(document, Result) and document.provenance.certkit != __version__


def document_checks(
    name: str, content: bytes, document: OutputDocument, *, bytes_matter: bool = True
) -> Iterator[Check]:
    """Check a document's own id, its bytes, its words, and the hashes of the definitions that it carries.

    Everything is under the id but what depends on clock or machine (`NOT_IN_ID`) and words that follow from
    codes; those, and the layout, are compared where this version wrote the document.

    Parameters
    ----------
    name : str
        What the document is called in the checks.
    content : bytes
        The file.
    document : OutputDocument
    bytes_matter : bool
        False in a list of several, where the layout of each is not its own.
    """
    made = document.content_id()
    same = made == document.id
    yield judged(f"{name}: certificate id", same, "id-differs", said=document.id, made=made)
    if not of_another_certkit(document):
        if bytes_matter and same:
            yield judged(f"{name}: bytes", content == document.to_json().encode(), "bytes-differ")
        yield judged(f"{name}: words", worded(document) == document, "words-differ")
    if isinstance(document, Result):
        yield from input_checks(name, document.provenance)


def input_checks(name: str, provenance: Provenance) -> Iterator[Check]:
    """Check the hashes of the texts that a document carries; a file may have begun with a byte order mark."""
    for item in provenance.inputs:
        if item.text is None:
            continue
        digests = {hashlib.sha256(mark + item.text.encode()).hexdigest() for mark in (b"", b"\xef\xbb\xbf")}
        yield judged(f"{name}: {item.role} {item.path}", item.sha256 in digests, "input-changed")


def table_check(name: str, content: bytes, result: Result) -> Check:
    """Check that a table of channels has the channels of a result."""
    what = f"{name}: channels of the result"
    table = (channels_csv(result) or "").encode()
    # Another certkit may say more or less of the test before the table.
    same = table == content or (of_another_certkit(result) and _body(table) == _body(content))
    return holds(what) if same else fails(what, "table-differs")


def _body(table: bytes) -> list[bytes]:
    return [line for line in table.splitlines() if not line.startswith(b"#")]
