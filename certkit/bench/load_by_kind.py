"""`load`: a definition or a document, by its kind and its name or path."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

from certkit.definitions.loading.library import load as load_definition
from certkit.documents.document_kinds import DOCUMENTS, document_class
from certkit.errors import UsageError

if TYPE_CHECKING:
    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.overrides import Overrides
    from certkit.documents.comparison import ComparisonDocument
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.result import Result


@overload
def load(kind: Literal["result"], name: str | Path) -> Result: ...
@overload
def load(kind: Literal["comparison"], name: str | Path) -> ComparisonDocument: ...
@overload
def load(kind: Literal["extraction"], name: str | Path) -> ExtractionResult: ...
@overload
def load(
    kind: str, name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Any: ...  # noqa: ANN401  # what it is goes by the kind's word


def load(
    kind: str, name: str | Path, *, library: Library = (), overrides: Overrides | None = None
) -> Any:  # see the overloads
    """Load a definition (a `procedure`, `legform`, …) or a document (a `result`, `comparison`, `extraction`).

    Parameters
    ----------
    kind : str
        As in `certkit list` and `certkit schema`.
    name : str or Path
        Of a definition: a name that the library knows, or a file. Of a document: its JSON, or the folder it
        was written to.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.
    overrides : mapping, optional
        Values of the definition to change, by their paths.

    Returns
    -------
    Loaded or OutputDocument
        A definition comes with its file, hash and changes; the typed definition is its `document`.

    Raises
    ------
    DefinitionError, UsageError
        When a definition cannot be used.
    DataError
        When a document cannot.
    """
    if kind not in DOCUMENTS:
        return load_definition(kind, name, library=library, overrides=overrides)
    if overrides:
        raise UsageError(
            f"a {kind} is a document that was written; its values cannot be changed"
            "; leave the changed values out"
        )
    model, path = document_class(kind), Path(name)
    return model.read(path / model.file_name if path.is_dir() else path)
