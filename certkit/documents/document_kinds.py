"""The kinds of document that certkit writes, and reading a file that may be any of them."""

from __future__ import annotations

import json
import re
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING

from certkit.documents.no_document import NO_DOCUMENT
from certkit.documents.output_document import OutputDocument, check_size, content_of
from certkit.documents.unverified import trusted
from certkit.errors import DataError

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.documents.result import ResultKind

DOCUMENTS = MappingProxyType(
    {
        "result": "certkit.documents.result:Result",
        "comparison": "certkit.documents.comparison:ComparisonDocument",
        "extraction": "certkit.documents.extraction:ExtractionResult",
        "study-report": "certkit.documents.study_report:StudyReport",
        "optimum-report": "certkit.documents.optimum_report:OptimumReport",
        "calibration-report": "certkit.documents.calibration_report:CalibrationReport",
        "campaign-report": "certkit.documents.campaign_report:CampaignReport",
        "legform-certificate": "certkit.documents.legform_certificate:LegformCertificate",
        "logbook-overview": "certkit.documents.logbook_overview:LegOverview",
        "uncertainty-report": "certkit.documents.uncertainty_report:UncertaintyReport",
        "twin": "certkit.documents.twin_report:TwinReport",
        "round-robin": "certkit.documents.round_robin_report:RoundRobinReport",
    }
)
"""Class of each kind by the word that `certkit schema` knows it by; imported when it is needed."""

MEASURED: ResultKind = "test evaluation"
"""Kind of the result of a measured test, the one that a laboratory answers for."""

_FIRST = re.compile(rb'\s*\{\s*"schema"\s*:\s*"([^"\\]{1,80})"')


def document_class(word: str) -> type[OutputDocument]:
    """Return the class of a kind of document.

    Raises
    ------
    KeyError
        When there is none of that word.
    """
    module, _, name = DOCUMENTS[word].partition(":")
    found: type[OutputDocument] = getattr(import_module(module), name)
    return found


def document_in(folder: Path) -> Path | None:
    """Return the file of the document that a command wrote into a folder; a result before any other."""
    files = (folder / document_class(word).file_name for word in DOCUMENTS)
    return next((file for file in files if file.is_file()), None)


def document_at(path: Path) -> Path:
    """Return the file of the document that a path names: itself, or the one in its folder, if any."""
    return (document_in(path) or path) if path.is_dir() else path


def read_documents(path: Path, *, unverified: bool = False) -> list[OutputDocument]:
    """Read a file that holds a document of any kind, or a JSON list of some.

    Parameters
    ----------
    path : Path
    unverified : bool
        Take one that was changed since certkit wrote it as well, marked as such.

    Raises
    ------
    DataError
        When it is missing, damaged, changed, or no document that certkit writes.
    """
    content = content_of(path, "document that certkit wrote, such as result.json")
    found = documents_from(content, str(path))
    return [trusted(document, str(path), unverified=unverified) for document in found]


def documents_from(content: bytes, name: str) -> list[OutputDocument]:
    """Read documents of any kind from the bytes of a file.

    Raises
    ------
    DataError
        Likewise.
    """
    first = _FIRST.match(content)  # as certkit writes it, so that a large document is not parsed twice
    if first is not None:
        return [_class_of(first[1].decode(errors="replace"), name).from_json(content, name)]
    check_size(content, name)
    try:
        tree = json.loads(content)
    except (ValueError, RecursionError) as error:
        if content.lstrip()[:1] not in {b"{", b"["}:
            raise DataError(f"{name}: {NO_DOCUMENT}") from error
        raise DataError(f"{name}: damaged: no JSON ({error}); make it again") from error
    if not isinstance(tree, list):
        return [_class_of(_word(tree), name).from_json(content, name)]
    return [
        _class_of(_word(item), f"{name}: item {number}").from_json(json.dumps(item), f"{name}: item {number}")
        for number, item in enumerate(tree, 1)
    ]


def _word(tree: object) -> str:
    return str(tree.get("schema", "")) if isinstance(tree, dict) else ""


def _class_of(schema: str, name: str) -> type[OutputDocument]:
    known = {kind.schema_word(): kind for kind in map(document_class, DOCUMENTS)}
    if schema not in known:
        said = f"its schema is `{schema[:80]}`" if schema else "it names no schema"
        raise DataError(f"{name}: no document of this certkit: {said}; it reads {', '.join(known)}")
    return known[schema]
