"""Pages on paper: PDF/A-3a by WeasyPrint, the same bytes every time, with files attached.

Fonts come from the templates' folder alone: whatever else a document might ask for is refused, so nothing is
fetched.
"""

from __future__ import annotations

import atexit
import gc
import re
import shutil
import sys
import warnings
import zlib
from contextlib import contextmanager, redirect_stdout
from functools import cache, partial
from html import escape
from io import StringIO
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from certkit.errors import MissingPartError
from certkit.reporting.pdf_drawing import SVG, PdfDrawing, is_known, split_drawings
from certkit.reporting.pdf_labels import Labels, engine
from certkit.reporting.svg import FONT
from certkit.reporting.templating import folder, text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from datetime import datetime

    from certkit.reporting.attachments import Enclosure
    from certkit.reporting.svg import Drawing

_STYLE = re.compile(r"(?<=<style>).*?(?=</style>)", re.DOTALL)


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
    page, style = _STYLE.sub("", html), "".join(_STYLE.findall(html))
    fonts, sheet = _sheet(style)
    page, drawings = _with_drawings(page, fonts)
    document = _read(module, page)
    with _rare_collection(), warnings.catch_warnings():
        # WeasyPrint leaves its colour profile's file to the garbage collector.
        warnings.simplefilter("ignore", ResourceWarning)
        pdf: bytes = document.write_pdf(
            pdf_variant="pdf/a-3a",
            attachments=attached,
            finisher=partial(_finish, key),
            custom_metadata=False,
            font_config=fonts,
            stylesheets=[sheet],
            cache=drawings,
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


@cache
def _sheet(style: str) -> tuple[Any, Any]:
    """Return a style sheet and the fonts that it names, read once for all documents of a process."""
    module = weasyprint()
    fonts = module.text.fonts.FontConfiguration()
    atexit.register(_remove_copies, fonts)
    base = folder().as_uri() + "/"
    return fonts, module.CSS(string=style, base_url=base, url_fetcher=_fetcher(module), font_config=fonts)


def _remove_copies(fonts: Any) -> None:  # noqa: ANN401  # likewise
    """Remove WeasyPrint's copies of fonts, which it leaves to the garbage collector: too late at the end."""
    kept, fonts._folder = getattr(fonts, "_folder", None), None  # noqa: SLF001  # there is no other way to it
    if kept:
        shutil.rmtree(kept, ignore_errors=True)


def _read(module: Any, page: str) -> Any:  # noqa: ANN401  # likewise
    """Return a page for WeasyPrint: read as XML, in a tenth of the time that HTML takes, where it is that."""
    base = folder().as_uri() + "/"
    try:
        root = ET.fromstring(page)  # noqa: S314  # filled by us: it declares no entities
    except ET.ParseError:
        return module.HTML(string=page, base_url=base, url_fetcher=_fetcher(module))
    document = module.HTML(string="<html></html>", base_url=base, url_fetcher=_fetcher(module))
    wrapped = type(document.wrapper_element).from_html_root(root, content_language=None)
    document.wrapper_element, document.etree_element = wrapped, wrapped.etree_element
    return document


@cache
def own_drawings() -> bool:
    """Tell whether this WeasyPrint has the parts that our drawings are set with; say so once if not."""
    try:
        engine()
    except ImportError as error:
        sys.stderr.write(f"drawings are set by WeasyPrint alone, which takes longer: {error}\n")
        return False
    return True


def _with_drawings(html: str, fonts: Any) -> tuple[str, dict[str, PdfDrawing]]:  # noqa: ANN401  # likewise
    """Return a page with our drawings as images, and the images by their addresses."""
    images: dict[str, PdfDrawing] = {}
    labels = Labels(fonts, FONT)
    parts = []
    for part, is_drawing in split_drawings(html):
        root = ET.fromstring(part) if is_drawing else None  # noqa: S314  # likewise
        if root is None or not own_drawings() or not is_known(root):
            parts.append(part)
            continue
        address = f"drawing:{len(images)}"
        images[address] = PdfDrawing(root, labels)
        title = root.findtext(f"{SVG}title") or root.findtext("title") or ""
        css_class = root.get("class", "")
        if css_class == "rows":  # text, and no figure with an alternative
            parts.append(f'<embed src="{address}" class="{escape(css_class)}"/>')
            continue
        parts.append(f'<img src="{address}" class="{escape(css_class)}" alt="{escape(title)}"/>')
    return "".join(parts), images


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
    """Label the pages 1, 2, 3 … as printed, pack each stream once, name heads of tables."""
    import pydyf  # noqa: PLC0415  # comes with WeasyPrint

    del document
    labels = pydyf.Dictionary({"Nums": pydyf.Array([0, pydyf.Dictionary({"S": "/D"})])})
    pdf.catalog["PageLabels"] = labels
    for part in pdf.objects:
        # pydyf packs a stream anew each time it is asked for its bytes, which is three times. Level 4 takes a
        # third of the time of the usual 6, for 2 % more bytes.
        if isinstance(part, pydyf.Stream) and part.compress:
            part.stream = [zlib.compress(b"\n".join(map(_bytes, part.stream)), 4)]
            part.extra["Filter"] = "/FlateDecode"
            part.compress = False
        elif key and isinstance(part, pydyf.Dictionary) and isinstance(part.get("ID"), pydyf.String):
            part["ID"].string = f"{key}-{part['ID'].string}"  # cells refer to this very string
    if "AF" in pdf.catalog:
        pdf.catalog["AF"] = pydyf.Array(dict.fromkeys(pdf.catalog["AF"]))


def _bytes(item: Any) -> bytes:  # noqa: ANN401  # likewise
    """Return the bytes of a part of a stream: as they are, as text, or of an object."""
    if isinstance(item, bytes):
        return item
    return item.encode("ascii") if isinstance(item, str) else item.data


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
