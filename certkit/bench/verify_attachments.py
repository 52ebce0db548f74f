"""Checks of what a PDF carries: the manifest's hashes, and that the files are those of the document."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

from certkit.bench.verification import Check, fails, judged
from certkit.reporting.attachments import enclosures

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.bench.pdf_attachments import Attached
    from certkit.documents.result import Result


def manifest_checks(attached: Attached) -> Iterator[Check]:
    """Check every attachment against its hash, and that none is missing or foreign."""
    for name in sorted(set(attached.listed) | set(attached.files)):
        if name not in attached.listed:
            yield fails(name, "attached-not-listed")
        elif name not in attached.files:
            yield fails(name, "listed-not-attached")
        else:
            same = hashlib.sha256(attached.files[name]).hexdigest() == attached.listed[name]
            yield judged(name, same, "attachment-changed")


def attachment_checks(attached: Attached, result: Result, prefix: str) -> Iterator[Check]:
    """Check that the attached definitions are those that the attached document carries."""
    for part in enclosures(result, prefix):
        if part.role in {"result", "channels"}:
            continue  # the document itself, and the table, which has a check of its own
        same = attached.files.get(part.name) == part.content
        yield judged(f"{part.name}: of the result", same, "attachment-differs")
