"""The PDF of a suite: a page of contents, and the certificates as they were set, bound into one PDF/A-3a.

Nothing is set twice: pages, structure, bookmarks and attachments of each certificate are taken over. Only the
names of what they carry change, so that two certificates do not collide.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from datetime import datetime

LINK_SCHEME = "page"
"""Of the addresses in the page of contents: `page:12` becomes a link to the twelfth page of the file."""


def attached_files(pdf: bytes) -> tuple[int, dict[str, tuple[str, bytes]]]:
    """Return how many pages one of our certificates has, and role and content of each attached file."""
    import pikepdf  # noqa: PLC0415  # only where there is a suite

    with pikepdf.open(io.BytesIO(pdf)) as document:
        files = {
            name: (specification.description.partition(",")[0], specification.get_file().read_bytes())
            for name, specification in document.attachments.items()
        }
        return len(document.pages), files


def bind(contents: bytes, certificates: Mapping[str, bytes], created: datetime) -> bytes:
    """Bind certificates behind the pages of contents.

    Parameters
    ----------
    contents : bytes
        The first pages, with the suite's own title, dates and manifest.
    certificates : mapping of str to bytes
        By their keys, in their order; key and dash are put before the names of what is attached.
    created : datetime
        Date that the attachments bear.

    Returns
    -------
    bytes
        The same for the same input.
    """
    import pikepdf  # noqa: PLC0415  # likewise

    with pikepdf.open(io.BytesIO(contents)) as suite:
        files = [specification.obj for specification in suite.attachments.values()]
        labels: list[Any] = [0, pikepdf.Dictionary(S=pikepdf.Name.D)]
        for key, certificate in certificates.items():
            first = len(suite.pages)
            labels += [first, pikepdf.Dictionary(S=pikepdf.Name.D, P=pikepdf.String(f"{key} "))]
            with pikepdf.open(io.BytesIO(certificate)) as document:
                suite.pages.extend(document.pages)
                # After its pages: what refers to them finds those that were copied.
                _join_structure(suite, suite.copy_foreign(document.Root.StructTreeRoot), first)
                _join_bookmarks(suite, document, first)
                files += _renamed(suite, document, key, created)
        files.sort(key=lambda specification: str(specification.F).encode())
        names = [each for specification in files for each in (specification.F, specification)]
        suite.Root.Names.EmbeddedFiles.Names = pikepdf.Array(names)
        suite.Root.AF = pikepdf.Array(files)
        suite.Root.PageLabels = pikepdf.Dictionary(Nums=pikepdf.Array(labels))
        _lead_to_pages(suite)
        written = io.BytesIO()
        suite.save(
            written,
            deterministic_id=True,
            object_stream_mode=pikepdf.ObjectStreamMode.generate,
            stream_decode_level=pikepdf.StreamDecodeLevel.none,
        )
    return written.getvalue()


def _join_structure(suite: Any, taken: Any, first: int) -> None:  # noqa: ANN401  # pikepdf objects have no types
    """Make the structure of a certificate a part of the suite's, which has its pages from `first` on.

    The numbers by which pages and links find their elements are moved behind those that there are.
    """
    import pikepdf  # noqa: PLC0415  # likewise

    root = suite.Root.StructTreeRoot
    whole, part = root.K[0], taken.K[0]
    part.S, part.P = pikepdf.Name.Part, whole
    whole.K.append(part)
    numbers = root.ParentTree.Nums
    start = int(numbers[-2]) + 1
    found = list(taken.ParentTree.Nums)
    for number, elements in zip(found[::2], found[1::2], strict=True):
        numbers.extend([int(number) + start, elements])
    for page in suite.pages[first:]:
        page.obj.StructParents = int(page.obj.StructParents) + start
        for annotation in page.obj.get("/Annots", []):
            if "/StructParent" in annotation:
                annotation.StructParent = int(annotation.StructParent) + start


def _join_bookmarks(suite: Any, document: Any, first: int) -> None:  # noqa: ANN401  # likewise
    """Append the bookmarks of a certificate, whose first page is this one of the suite's."""
    import pikepdf  # noqa: PLC0415  # likewise

    places = {page.objgen: number for number, page in enumerate(document.pages)}

    def moved(item: Any) -> Any:  # noqa: ANN401  # likewise
        page, *place = item.destination
        there = suite.pages[first + places[page.objgen]].obj
        copy = pikepdf.OutlineItem(item.title, pikepdf.Array([there, *place]))
        copy.children.extend(moved(child) for child in item.children)
        copy.is_closed = True
        return copy

    with document.open_outline() as inner, suite.open_outline() as outer:
        outer.root.extend(moved(item) for item in inner.root)


def _renamed(suite: Any, document: Any, key: str, created: datetime) -> Iterator[Any]:  # noqa: ANN401  # likewise
    """Yield the attachments of a certificate under the names that they have in the suite."""
    import pikepdf  # noqa: PLC0415  # likewise

    day = pikepdf.String(created.strftime("D:%Y%m%d%H%M%SZ"))
    for specification in document.Root.AF:
        taken = suite.copy_foreign(specification)
        taken.F = taken.UF = pikepdf.String(f"{key}-{specification.F}")
        taken.EF.F.Params.CreationDate = taken.EF.F.Params.ModDate = day
        yield taken


def _lead_to_pages(suite: Any) -> None:  # noqa: ANN401  # likewise
    """Turn the addresses of the contents, `page:12`, into links to pages of the file."""
    import pikepdf  # noqa: PLC0415  # likewise

    for page in suite.pages:
        for annotation in page.obj.get("/Annots", []):
            scheme, _, number = str(annotation.get("/A", {}).get("/URI", "")).partition(":")
            if scheme == LINK_SCHEME:
                del annotation.A
                there = suite.pages[int(number) - 1]
                annotation.Dest = pikepdf.Array([there.obj, pikepdf.Name.Fit])
                annotation.Contents = pikepdf.String(f"{int(number)}")
