"""What a result folder holds, and whether a new result may take its place.

Nothing is overwritten in silence. The same result again may replace what is there: the same id, or the same
inputs with the same verdict, as after an update of certkit, or one test again from another file, with the
same values under the same conditions. A study or a fit of the same name may too: all of
its runs stay in its journal. Anything else is another result, and stays unless the user says `--force`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from certkit.definitions.loading.search_path import is_name
from certkit.errors import DataError, UsageError
from certkit.files.folder_switch import FolderSwitch
from certkit.files.limits import MAX_DOCUMENT_BYTES
from certkit.files.whole_file import write_whole

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from certkit.documents.output_document import OutputDocument
    from certkit.documents.result import Result

FORCE = "name another folder with `--out`, or overwrite it with `--force`"


class AnotherResultError(UsageError):
    """A folder or file holds another result than the one that should be written there."""


@contextmanager
def result_switch(
    folder: Path,
    document: OutputDocument,
    *,
    force: bool,
    pages_only: bool = False,
    tell: Callable[[str], None] = lambda _: None,
) -> Iterator[Path]:
    """Open a folder for a new result; a context that yields the folder to write into.

    At the end of the context the old result is replaced as a whole, see `FolderSwitch`: also its pages in
    formats that were not asked for this time, unless they are pages of the same id.

    Parameters
    ----------
    folder : Path
    document : OutputDocument
        The new one.
    force : bool
        Replace another result.
    pages_only : bool
        The document itself is not written: where it is there, it stays.
    tell : callable
        Told when another process is at work in the folder, which is waited for.

    Raises
    ------
    AnotherResultError
        When the folder holds another result of this kind, or pages of one.
    """
    with FolderSwitch(folder, lambda: tell(f"waiting for another certkit at work in {folder}")) as switch:
        old = _document_fields(switch.folder / document.file_name)
        same = old is not None and _is_same(document, old)
        if not (force or same):
            _refuse_another(folder, switch.folder, document, old)
        if force or (old is not None and old.get("id") != document.id):
            stays = {document.file_name} if same and pages_only else set()
            switch.stale = set(_files_of(document, old or {}, switch.folder)) - stays
        yield switch.stage


@contextmanager
def suite_switch(folder: Path, results: Sequence[Result], *, force: bool) -> Iterator[Path]:
    """Open a folder for what binds several results: a context as `result_switch`.

    Raises
    ------
    AnotherResultError
        When it holds the report of a single result, or a suite of other results.
    """
    from certkit.reporting.report_formats import FORMATS, report_format  # noqa: PLC0415  # waits until there is a suite

    names = {file for name in FORMATS if (file := report_format(name).SUITE_FILE)}
    with FolderSwitch(folder) as switch:
        there = [switch.folder / name for name in sorted(names) if (switch.folder / name).is_file()]
        single = (switch.folder / "result.json").exists()
        texts = [page.read_text("utf-8", errors="replace") for page in there if page.suffix != ".pdf"]
        same = not single and any(all(result.id in text for result in results) for text in texts)
        if there and not same and not force:
            raise AnotherResultError(f"{folder}: holds {there[0].name} of other results; {FORCE}")
        switch.stale = [] if single else [page.name for page in there]
        yield switch.stage


def refuse_other_name(folder: Path, key: str, name: str, files: Sequence[str], *, force: bool) -> None:
    """Refuse a folder that holds a study or fit of another name, before anything is run.

    Raises
    ------
    AnotherResultError
        When it does, and `force` is not given.
    """
    for file in files:
        old = _document_fields(folder / file)
        if old is not None and old.get(key) != name and not force:
            raise AnotherResultError(f"{folder}: holds another {key} ({old.get(key) or file}); {FORCE}")


def write_alone(path: Path, content: bytes | str, *, force: bool) -> None:
    """Write a single file; refuse to replace one of other content.

    Raises
    ------
    AnotherResultError
        When there is such a file, and `force` is not given.
    """
    data = content.encode() if isinstance(content, str) else content
    if path.is_file() and not force and (path.stat().st_size != len(data) or path.read_bytes() != data):
        raise AnotherResultError(
            f"{path}: exists with other content; name another, or overwrite with `--force`"
        )
    write_whole(path, data, durable=True)


def folder_name(document: OutputDocument, path: Path) -> str:
    """Return what the folder of a document's reports is called: the procedure of a result, else the file.

    Raises
    ------
    DataError
        When the procedure's name would lead elsewhere.
    """
    name = getattr(document, "procedure", None)
    if name is None:
        return path.stem
    if not is_name(name):
        raise DataError(
            f"{path}: its procedure is called `{name[:80]}`, which is no name of a folder; refused"
        )
    return str(name)


def distinct_names(names: list[tuple[str, str]]) -> list[str]:
    """Return a folder name for each of several results that go into one folder.

    Parameters
    ----------
    names : list of (str, str)
        Name of each, and what may be put before it where several have the same: the folder it came from.

    Returns
    -------
    list of str
        Different even where upper and lower case are the same.
    """
    found: list[str] = []
    taken: set[str] = set()
    plain = [name.casefold() for name, _ in names]
    for name, before in names:
        shown = f"{before}-{name}" if before and plain.count(name.casefold()) > 1 else name
        number, free = 1, shown
        while free.casefold() in taken:
            number += 1
            free = f"{shown}-{number}"
        taken.add(free.casefold())
        found.append(free)
    return found


def _refuse_another(
    named: Path, folder: Path, document: OutputDocument, old: Mapping[str, Any] | None
) -> None:
    if old is None:
        pages = [folder / name for name in _files_of(document, {}, folder)]
        if pages and not all(_is_page_of(page, document) for page in pages):
            raise AnotherResultError(f"{named}: holds {pages[0].name} of another result; {FORCE}")
        return
    said = ", ".join(
        str(old[key])
        for key in ("procedure", "study", "fit", "case", "campaign", "verdict", "id")
        if old.get(key)
    )
    raise AnotherResultError(f"{named}: holds another {document.noun} ({said[:200]}); {FORCE}")


_COMPARED = ("kind", "procedure", "verdict", "study", "fit", "case", "inputs", "provenance")

_TEST = (
    "kind",
    "procedure",
    "verdict",
    "criteria",
    "conditions",
    "preconditions",
    "specimen",
    "coded_remarks",
)


def _is_same(document: OutputDocument, old: Mapping[str, Any]) -> bool:
    """Tell whether a document is of the same id as an old one, of the same inputs, or of one study or fit."""
    if old.get("id") == document.id:
        return True
    new: Mapping[str, Any] = document.model_dump(mode="json", include=set(_COMPARED), by_alias=True)
    for name in ("study", "fit"):
        if new.get(name) is not None:
            return bool(old.get(name) == new[name])
    keys = (_key(old), _key(new))
    return (keys[0] is not None and keys[0] == keys[1]) or _is_same_test(document, old)


def _is_same_test(document: OutputDocument, old: Mapping[str, Any]) -> bool:
    """Tell whether a test evaluation says just what an old one does: exported again, in another form."""
    told = set(_TEST)
    new: Mapping[str, Any] = document.model_dump(mode="json", include=told, by_alias=True)
    measured = new.get("kind") == "test evaluation" and bool(new.get("criteria"))
    return measured and all(old.get(key) == new.get(key) for key in told)


def _key(fields: Mapping[str, Any]) -> str | None:
    """Return what a result rests on, and its verdict; None where the document does not say."""
    inputs, provenance = fields.get("inputs"), fields.get("provenance")
    if isinstance(provenance, Mapping):
        inputs = [
            sorted([i.get("role"), i.get("sha256")] for i in provenance.get("inputs") or ()),
            [[o.get("path"), o.get("value")] for o in provenance.get("overrides") or ()],
        ]
    if not inputs:
        return None
    words = [fields.get(key) for key in ("kind", "procedure", "verdict", "case")]
    return json.dumps([words, inputs], sort_keys=True, default=str)


def _document_fields(path: Path) -> Mapping[str, Any] | None:
    """Return the fields of a document that is there; empty ones when it cannot be read."""
    if not path.exists():
        return None
    try:
        if path.stat().st_size > MAX_DOCUMENT_BYTES:
            return {}
        found = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return {}
    return found if isinstance(found, Mapping) else {}


def _files_of(document: OutputDocument, old: Mapping[str, Any], folder: Path) -> list[str]:
    """Return the names in a folder that belong to a document of this kind: itself, its pages, its figures."""
    if not folder.is_dir() or not any(folder.iterdir()):
        return []
    stem = Path(document.file_name).stem
    from certkit.reporting.document_reports import report_files  # noqa: PLC0415  # only where a folder is there

    names = {document.file_name, *report_files(document)}
    if stem == "extraction":
        names.add("vehicle.yaml")
    if stem in {"study", "optimum"}:
        names |= {f"{each}.{ending}" for each in ("study", "optimum") for ending in ("json", "html")}
        names |= {"table.csv", "table.json", "table.parquet"}
    figures = f"{old.get('procedure') or old.get('case') or ''}-"
    return sorted(
        path.name
        for path in folder.iterdir()
        if path.name in names
        or (figures != "-" and path.name.startswith(figures) and path.suffix in {".svg", ".png"})
        or (stem == "fit" and path.suffix == ".yaml" and _is_fitted(path))
    )


def _is_fitted(path: Path) -> bool:
    """Tell whether a file is one that a fit wrote."""
    with path.open("rb") as stream:
        return stream.read(80).startswith(b"# Written by `certkit calibrate`")


def _is_page_of(page: Path, document: OutputDocument) -> bool:
    """Tell whether a page without its document is one of this very document: it says the id."""
    if page.suffix in {".pdf", ".xlsx", ".pptx"}:
        return page.with_suffix(".html").is_file()  # which is looked at in its turn
    return page.is_file() and document.id.encode() in page.read_bytes()
