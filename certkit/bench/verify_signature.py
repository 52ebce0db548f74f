"""Check of a PDF's signatures: whole, over everything, by whom, and trusted by which root (pyHanko)."""

from __future__ import annotations

import io
import logging
from typing import TYPE_CHECKING, Any

from certkit.bench.verification import Check, fails, holds, left_out, unchecked

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

WHAT = "signature"


def signature_count(content: bytes) -> int:
    """Return how many signatures a PDF has, by PDFium, so that it is known without the extra."""
    import pypdfium2  # noqa: PLC0415  # only where a PDF is verified
    import pypdfium2.raw as pdfium  # noqa: PLC0415  # likewise

    document: Any = pypdfium2.PdfDocument(content)
    try:
        return max(0, int(pdfium.FPDF_GetSignatureCount(document)))
    finally:
        document.close()


def signature_checks(content: bytes, trust: Path | None = None) -> Iterator[Check]:
    """Check each signature of a PDF.

    Parameters
    ----------
    content : bytes
        The file.
    trust : Path, optional
        Certificates (PEM or DER) of the roots that a signer has to be vouched for by. Without it, the signer
        is named, and that nobody vouches for the name.
    """
    if not signature_count(content):
        yield (left_out(WHAT, "unsigned") if trust is None else fails(WHAT, "unsigned-though-trust"))
        return
    try:
        from pyhanko.pdf_utils.reader import PdfFileReader  # noqa: PLC0415  # an extra
    except ImportError:
        yield unchecked(WHAT, "signature-extra-missing")
        return
    try:
        roots = _roots(trust)
    except Exception as error:  # noqa: BLE001  # a file of any content; its readers raise many kinds
        yield fails(WHAT, "trust-unreadable", error=f"{trust}: holds no certificate ({error})")
        return
    try:
        _be_quiet()
        embedded = list(PdfFileReader(io.BytesIO(content), strict=False).embedded_signatures)
        for number, each in enumerate(embedded, 1):
            yield from _checked(each, roots, last=number == len(embedded))
        if not embedded:
            yield fails(WHAT, "signature-unreadable", error="no signature can be found in it")
    except Exception as error:  # noqa: BLE001  # a changed file makes pyHanko raise many kinds
        yield fails(WHAT, "signature-unreadable", error=" ".join(str(error).split())[:200])


def _be_quiet() -> None:
    """Keep pyHanko from logging what is told as a check."""
    for name in ("pyhanko", "pyhanko_certvalidator"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _roots(trust: Path | None) -> list[Any]:
    if trust is None:
        return []
    from pyhanko import keys  # noqa: PLC0415  # an extra

    load: Any = keys.load_certs_from_pemder
    found = list(load([str(trust)]))
    if not found:
        raise ValueError("it is empty")
    return found


def _checked(embedded: Any, roots: list[Any], *, last: bool) -> Iterator[Check]:  # noqa: ANN401  # no types
    """Check one signature; the last one has to cover the file as it is."""
    from pyhanko.sign.validation import validate_pdf_signature  # noqa: PLC0415  # an extra
    from pyhanko.sign.validation.settings import KeyUsageConstraints  # noqa: PLC0415  # likewise
    from pyhanko.sign.validation.status import SignatureCoverageLevel  # noqa: PLC0415  # likewise
    from pyhanko_certvalidator import ValidationContext  # noqa: PLC0415  # likewise

    from certkit.reporting.own_thread import in_own_thread  # noqa: PLC0415  # needed for signatures alone

    context = ValidationContext(trust_roots=roots, allow_fetching=False)
    any_use = KeyUsageConstraints(key_usage=set())
    status = in_own_thread(validate_pdf_signature, embedded, context, key_usage_settings=any_use)
    signer = str(embedded.signer_cert.subject.human_friendly).removeprefix("Common Name: ")
    if not status.intact:
        yield fails(WHAT, "signature-broken", signer=signer)
        return
    if not status.valid:
        yield fails(WHAT, "signature-invalid", signer=signer)
        return
    if last and status.coverage is not SignatureCoverageLevel.ENTIRE_FILE:
        yield fails(WHAT, "signature-partial", signer=signer)
    if not last and status.modification_level not in _harmless():
        yield fails(WHAT, "signature-modified", signer=signer)
    if not roots:
        yield holds(WHAT, "signature-by", signer=signer)
    elif status.trusted:
        yield holds(WHAT, "signature-trusted", signer=signer, root=_root(status))
    else:
        yield fails(WHAT, "signature-not-trusted", signer=signer)


def _harmless() -> set[Any]:
    """Return what may be appended to a signed file: further signatures, and what keeps them for long."""
    from pyhanko.sign.diff_analysis import ModificationLevel as Level  # noqa: PLC0415  # an extra

    return {Level.NONE, Level.LTA_UPDATES, Level.FORM_FILLING}


def _root(status: Any) -> str:  # noqa: ANN401  # likewise
    path = status.validation_path
    return (
        str(path.trust_anchor.authority.name.human_friendly).removeprefix("Common Name: ")
        if path is not None
        else "a root of --trust"
    )
