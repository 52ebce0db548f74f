"""Pages on paper: PDF/A-3a by WeasyPrint, the same bytes every time, with files attached.

Fonts come from the templates' folder alone: whatever else a document might ask for is refused, so nothing is
fetched.
"""

from __future__ import annotations

import gc
import warnings
import zlib
from contextlib import contextmanager, redirect_stdout
from functools import partial
from io import StringIO
from typing import TYPE_CHECKING, Any

from certkit.errors import MissingPartError
from certkit.reporting.templating import folder, text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from datetime import datetime

    from certkit.reporting.attachments import Enclosure
    from certkit.reporting.svg import Drawing


def typeset(html: str, enclosed: Sequence[Enclosure], created: datetime, *, key: str = "") -> bytes:
    """Return an HTML document as PDF/A-3a.

    Parameters
    ----------
    html : str
        With its style inside; addresses of fonts are relative to the templates' folder.
    enclosed : sequence of Enclosure
        Files to attach.
    created : datetime
        Date that the attachments bear; the document's own stands in its head.
    key : str
        Stands in the names of table heads that cells refer to, so that they stay unique in a suite.
    """
    module = weasyprint()
    attached = [
        module.Attachment(
            string=part.content,
            base_url=folder().as_uri(),
            name=part.name,
            description=f"{part.role}, SHA-256 {part.sha256}",
            created=created,
            modified=created,
            relationship=part.relationship,
        )
        for part in enclosed
    ]
    document = module.HTML(string=html, base_url=folder().as_uri() + "/", url_fetcher=_fetcher(module))
    with _rare_collection(), warnings.catch_warnings():
        # WeasyPrint leaves its colour profile's file to the garbage collector.
        warnings.simplefilter("ignore", ResourceWarning)
        pdf: bytes = document.write_pdf(
            pdf_variant="pdf/a-3a",
            attachments=attached,
            finisher=partial(_finish, key),
            custom_metadata=False,
        )
    return pdf


@contextmanager
def _rare_collection() -> Iterator[None]:
    """Look for garbage less often: the boxes of a document live until its end, and looking costs a sixth."""
    before = gc.get_threshold()
    gc.set_threshold(before[0] * 100, *before[1:])
    try:
        yield
    finally:
        gc.set_threshold(*before)


def weasyprint() -> Any:  # noqa: ANN401  # the module has no types
    """Return WeasyPrint.

    Raises
    ------
    MissingPartError
        When the Pango library that it draws text with is missing; says how to install it.
    """
    try:
        # It tells of a missing library on standard output, in six lines of its own.
        with redirect_stdout(StringIO()):
            import weasyprint as module  # noqa: PLC0415  # 1.1 s that only a PDF needs
    except OSError as error:
        raise MissingPartError(
            "the PDF needs the Pango library, which is not installed; on Debian and Ubuntu: "
            "`apt install libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz0b`, on macOS: `brew install pango`, "
            "on Windows: Pango from MSYS2 (docs/how-to/run.md); "
            "all other formats do without it"
        ) from error
    return module


def _fetcher(module: Any) -> Any:  # noqa: ANN401  # likewise
    """Return a fetcher that hands out the fonts of our own folder and embedded pictures, and nothing else."""
    fonts = (folder() / "fonts").as_uri() + "/"

    class OwnFilesOnly(module.urls.URLFetcher):  # type: ignore[misc]  # the module has no types
        def fetch(self, url: str, headers: dict[str, str] | None = None) -> Any:  # noqa: ANN401  # likewise
            if url.startswith("data:image/") or (url.startswith(fonts) and ".." not in url):
                return super().fetch(url, headers)
            raise ValueError(f"a certificate fetches nothing: {url[:80]}")

    return OwnFilesOnly(allowed_protocols=("file", "data"))


def _finish(key: str, document: Any, pdf: Any) -> None:  # noqa: ANN401  # likewise
    """Label the pages 1, 2, 3 … as printed, name and pack each attachment once, name heads of tables."""
    import pydyf  # noqa: PLC0415  # comes with WeasyPrint

    del document
    labels = pydyf.Dictionary({"Nums": pydyf.Array([0, pydyf.Dictionary({"S": "/D"})])})
    pdf.catalog["PageLabels"] = labels
    for part in pdf.objects:
        # pydyf packs a stream anew each time it is asked for its bytes, which is three times.
        if isinstance(part, pydyf.Stream) and part.extra.get("Type") == "/EmbeddedFile":
            part.stream = [zlib.compress(b"".join(part.stream), 6)]
            part.extra["Filter"] = "/FlateDecode"
            part.compress = False
        elif key and isinstance(part, pydyf.Dictionary) and isinstance(part.get("ID"), pydyf.String):
            part["ID"].string = f"{key}-{part['ID'].string}"  # cells refer to this very string
    if "AF" in pdf.catalog:
        pdf.catalog["AF"] = pydyf.Array(dict.fromkeys(pdf.catalog["AF"]))


def pdf_of_drawing(drawing: Drawing) -> bytes:
    """Return one of our SVG drawings as a page of exactly its size, set in the shipped font.

    Parameters
    ----------
    drawing : Drawing
        From `certkit.reporting.charts`; its size is in CSS pixels.
    """
    module = weasyprint()
    page = f"@page {{ size: {drawing.width:g}px {drawing.height:g}px; margin: 0 }}"
    size = f"{page} body {{ margin: 0 }} svg {{ display: block }}"
    faces = "".join(
        line for line in text("styles/certificate.css").splitlines() if line.startswith("@font-face")
    )
    html = f"<style>{faces} {size}</style>{drawing}"
    document = module.HTML(string=html, base_url=folder().as_uri() + "/", url_fetcher=_fetcher(module))
    pdf: bytes = document.write_pdf()
    return pdf
