"""Reports signed with a laboratory's key (PAdES, by pyHanko): appended, so nothing before changes."""

from __future__ import annotations

import io
import logging
import os
from typing import TYPE_CHECKING, Any

from certkit.errors import InputError, RunError

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

PASSPHRASE = "CERTKIT_PASSPHRASE"  # noqa: S105  # the variable's name
TIMESTAMP = "CERTKIT_TIMESTAMP"
"""Variable with the address of a timestamp authority (RFC 3161); without it the signer's clock is written."""

FIELD = "Signature"


def signer_of(key: Path) -> Callable[[bytes], bytes]:
    """Open a key, and return what signs a PDF with it.

    Parameters
    ----------
    key : Path
        PKCS #12 file with the key and its certificate; its passphrase is taken from `CERTKIT_PASSPHRASE`.

    Raises
    ------
    RunError
        When the extra `signature` is not installed.
    InputError
        When the key cannot be read or opened.
    """
    try:
        from pyhanko.sign import signers, timestamps  # noqa: PLC0415  # an extra
    except ImportError as error:
        raise RunError("signing needs the extra `signature`: pip install 'certkit[signature]'") from error
    if not key.is_file():
        raise InputError(f"{key}: there is no such key file; name a PKCS #12 file (.p12, .pfx)")
    logging.getLogger("pyhanko").setLevel(logging.CRITICAL + 1)  # it would log what is told as an error here
    passphrase = os.environ.get(PASSPHRASE)
    load: Any = signers.SimpleSigner.load_pkcs12
    signer = load(str(key), passphrase=passphrase.encode() if passphrase is not None else None)
    if signer is None:
        why = "its passphrase is another one" if passphrase else "it needs its passphrase"
        raise InputError(f"{key}: the key cannot be opened: {why}, or it is no PKCS #12; set {PASSPHRASE}")
    address = os.environ.get(TIMESTAMP)
    authority = timestamps.HTTPTimeStamper(address) if address else None
    return lambda pdf: _signed(pdf, signer, authority)


def sign(pdf: bytes, key: Path) -> bytes:
    """Return the PDF with a signature appended; see `signer_of`."""
    return signer_of(key)(pdf)


def _signed(pdf: bytes, signer: Any, authority: Any) -> bytes:  # noqa: ANN401  # the module has no types
    from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter  # noqa: PLC0415  # an extra
    from pyhanko.sign import signers  # noqa: PLC0415  # likewise
    from pyhanko.sign.fields import SigSeedSubFilter  # noqa: PLC0415  # likewise

    from certkit.reporting.own_thread import in_own_thread  # noqa: PLC0415  # needed to sign alone

    metadata = signers.PdfSignatureMetadata(field_name=FIELD, subfilter=SigSeedSubFilter.PADES)
    writer = IncrementalPdfFileWriter(io.BytesIO(pdf))
    try:
        made = in_own_thread(signers.sign_pdf, writer, metadata, signer=signer, timestamper=authority)
    except OSError as error:
        said = " ".join(str(error).split())[:200]
        raise RunError(
            f"the timestamp authority of {TIMESTAMP} does not answer: {said}"
            "; try again later, or sign without a timestamp"
        ) from error
    signed: bytes = made.getvalue()
    return signed
