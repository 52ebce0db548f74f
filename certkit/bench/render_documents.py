"""`render`: write a document and its reports into a folder, each file whole or not at all."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.bench.result_folder import AnotherResultError, result_switch, suite_switch
from certkit.files import write_whole

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    from certkit.documents.output_document import OutputDocument
    from certkit.documents.result import Result
    from certkit.reporting.report_formats import Paper
    from certkit.reporting.result_view import View


def render(  # noqa: PLR0913  # as many as the command has options
    document: OutputDocument,
    out: str | Path,
    formats: str | Collection[str] | None = None,
    *,
    paper: Paper = "A4",
    language: str = "en",
    sign: str | Path | None = None,
    force: bool = False,
    numbered: bool = False,
    tell: Callable[[str], None] = lambda _: None,
    beside: Callable[[Path], Sequence[Path]] = lambda _: (),
    shown: dict[str, list[View]] | None = None,
) -> list[Path]:
    """Write a document as JSON, and the wanted reports of it.

    All appear in the folder at once, after they have been brought to the disk; an old result is replaced as a
    whole, with all its pages, or not at all. Files that certkit did not write there stay.

    Parameters
    ----------
    document : OutputDocument
        Any that certkit makes. An extraction is written with its vehicle file.
    out : str or Path
        Folder; made when missing.
    formats : str or collection of str, optional
        Such as `html`, `pdf`, `junit`, `csv`, `md`, `xlsx`, `pptx`, `dcc`, as far as this kind of document
        has them. In one string they are separated by commas; `none` writes the JSON alone. What people look
        at (`html`, and `pdf` where there is one) when not given.
    paper : {'A4', 'Letter'}
        Page size of the PDF, where there is a choice.
    language : str
        Of page and PDF: `en`, `de`, `ja`. The document's id is the same in each.
    sign : str or Path, optional
        PKCS #12 key that PDFs are signed with; its passphrase is taken from `CERTKIT_PASSPHRASE`.
    force : bool
        Replace another result that the folder holds. The same result again is replaced without.
    numbered : bool
        Where the folder holds another result, take the first of `out-2`, `out-3` … that does not.
    tell : callable
        Told of a folder that was passed over, and of waiting for another process.
    beside : callable
        Given a folder, writes further files of this document into it and returns them.
    shown : dict, optional
        Of a result: gets what its reports show, by language, for `render_suite`.

    Returns
    -------
    list of Path
        What was written, the JSON first. Where a library or a font that the PDF needs is missing, it is left
        out with a `LeftOutWarning`.

    Raises
    ------
    UsageError
        When there is no such report of the document, or the folder holds another result; nothing is written
        then.
    """
    folder = wanted = Path(out)
    asked = reports_of(document, formats)
    signer = _signer(sign)
    number = 1
    while True:
        try:
            written = _render(
                document,
                folder,
                asked,
                paper,
                language,
                signer,
                force=force,
                tell=tell,
                beside=beside,
                shown=shown,
            )
        except AnotherResultError:
            if not numbered:
                raise
            number += 1
            folder = wanted.with_name(f"{wanted.name}-{number}")
            continue
        if folder != wanted:
            tell(f"{wanted} holds another result and stays; this one is in {folder} (`--force` overwrites)")
        return written


def _render(  # noqa: PLR0913  # what `render` is asked for
    document: OutputDocument,
    folder: Path,
    asked: list[str],
    paper: Paper,
    language: str,
    sign: Callable[[bytes], bytes] | None,
    *,
    force: bool,
    tell: Callable[[str], None],
    beside: Callable[[Path], Sequence[Path]],
    shown: dict[str, list[View]] | None,
) -> list[Path]:
    with result_switch(folder, document, force=force, tell=tell) as stage:
        text = document.readable_json()
        write_whole(stage / document.file_name, text)
        written = [stage / document.file_name, *_vehicle(document, stage), *beside(stage)]
        if asked:
            from certkit.reporting.document_reports import render_document  # noqa: PLC0415  # likewise

            # From the text, whose numbers are rounded: reports are the ones that the document alone makes.
            again = document.model_validate_json(text)
            written += render_document(again, stage, asked, paper=paper, spoken=language, shown=shown)
            _sign(written, sign)
    return [folder / path.relative_to(stage) for path in written]


def render_pages(
    document: OutputDocument,
    out: Path,
    formats: Collection[str] | None,
    *,
    paper: Paper = "A4",
    language: str = "en",
    sign: Path | None = None,
    force: bool = False,
) -> list[Path]:
    """Write the reports of a document without the document itself; PDFs signed with a key where one is given.

    Returns
    -------
    list of Path

    Raises
    ------
    UsageError
        When there is no such report, or the folder holds another result.
    """
    from certkit.reporting.document_reports import render_document  # noqa: PLC0415  # as above

    asked, signer = reports_of(document, formats), _signer(sign)
    with result_switch(out, document, force=force, pages_only=True) as stage:
        written = render_document(document, stage, asked, paper=paper, spoken=language)
        _sign(written, signer)
    return [out / path.relative_to(stage) for path in written]


def render_suite(  # noqa: PLR0913  # as many as the command has options
    results: Sequence[Result],
    out: str | Path,
    formats: str | Collection[str],
    *,
    title: str = "Certification suite",
    paper: Paper = "A4",
    language: str = "en",
    sign: Path | None = None,
    force: bool = False,
    folders: Sequence[Path] = (),
    shown: Mapping[str, list[View]] | None = None,
) -> list[Path]:
    """Write the index page and the bound certificate of several results.

    `folders` hold the reports of the results, where they have just been written on this paper and in this
    language: their certificates are bound, and not set again. `shown` is what `render` got of them.

    Raises
    ------
    UsageError
        When there are such files of other results, and `force` is not given.
    """
    from certkit.reporting.writing import render_suite as write  # noqa: PLC0415  # likewise

    signer = _signer(sign)
    pdfs = [_unsigned(folder / "report.pdf") for folder in folders] if "pdf" in split(formats) else []
    with suite_switch(Path(out), results, force=force) as stage:
        written = write(
            results, stage, split(formats), title=title, paper=paper, spoken=language, pdfs=pdfs, shown=shown
        )
        _sign(written, signer)
    return [Path(out) / path.relative_to(stage) for path in written]


def _unsigned(path: Path) -> bytes | None:
    """Return a certificate as it was before it was signed; None where there is none."""
    from certkit.bench.verify_pdf_file import first_revision  # noqa: PLC0415  # only for a suite

    return first_revision(path.read_bytes()) if path.is_file() else None


def check_key(sign: str | Path | None) -> None:
    """Refuse a key that cannot be opened, before anything is computed.

    Raises
    ------
    InputError
        When it cannot be read, or its passphrase is another one.
    RunError
        When the extra `signature` is not installed.
    """
    _signer(sign)


def _signer(key: str | Path | None) -> Callable[[bytes], bytes] | None:
    """Open a key before anything is written; None where nothing is to be signed."""
    if key is None:
        return None
    from certkit.reporting.signing import signer_of  # noqa: PLC0415  # an extra

    return signer_of(Path(key))


def _sign(written: Sequence[Path], sign: Callable[[bytes], bytes] | None) -> None:
    """Sign the PDFs among the files."""
    if sign is None:
        return
    for path in written:
        if path.suffix == ".pdf":
            write_whole(path, sign(path.read_bytes()))


def reports_of(
    document: OutputDocument | type[OutputDocument], formats: str | Collection[str] | None
) -> list[str]:
    """Return the wanted reports of a document, or of a kind of them before there is one; see `render`.

    Raises
    ------
    UsageError
        When this kind has no such report.
    """
    from certkit.reporting.document_reports import REPORTS, checked  # noqa: PLC0415  # waits until it is needed

    usual = REPORTS[document.schema_word()].usual
    return checked(document, usual if formats is None else split(formats))


def split(formats: str | Collection[str]) -> list[str]:
    """Return formats as a list; `none` and `json` ask for no report."""
    words = formats.split(",") if isinstance(formats, str) else formats
    return [word.strip() for word in words if word.strip() not in {"", "none", "json"}]


def _vehicle(document: OutputDocument, folder: Path) -> list[Path]:
    """Write the vehicle that an extraction found."""
    if document.noun != "extraction":
        return []
    from certkit.documents.extraction import ExtractionResult  # noqa: PLC0415  # only where there is one

    if not isinstance(document, ExtractionResult) or not document.vehicle:
        return []
    from certkit.identification.vehicle_file import vehicle_text  # noqa: PLC0415  # likewise

    write_whole(folder / "vehicle.yaml", vehicle_text(document))
    return [folder / "vehicle.yaml"]
