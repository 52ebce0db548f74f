"""A certificate signed with the laboratory's key (PAdES, by pyHanko): appended, so nothing before changes."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING, Any

from certkit.errors import InputError, RunError

if TYPE_CHECKING:
    from pathlib import Path

PASSPHRASE = "CERTKIT_PASSPHRASE"  # noqa: S105  # the variable's name
FIELD = "Signature"


def sign(pdf: bytes, key: Path) -> bytes:
    """Return the PDF with a signature appended.

    Parameters
    ----------
    pdf : bytes
        The certificate.
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
        from pyhanko.pdf_utils.incremental_writer import IncrementalPdfFileWriter  # noqa: PLC0415  # an extra
        from pyhanko.sign import signers  # noqa: PLC0415  # likewise
        from pyhanko.sign.fields import SigSeedSubFilter  # noqa: PLC0415  # likewise
    except ImportError as error:
        raise RunError("signing needs the extra `signature`: pip install 'certkit[signature]'") from error
    if not key.is_file():
        raise InputError(f"{key}: there is no such key file; name a PKCS #12 file (.p12, .pfx)")
    passphrase = os.environ.get(PASSPHRASE)
    load: Any = signers.SimpleSigner.load_pkcs12
    signer = load(str(key), passphrase=passphrase.encode() if passphrase is not None else None)
    if signer is None:
        raise InputError(f"{key}: the key cannot be opened; put its passphrase into {PASSPHRASE}")
    metadata = signers.PdfSignatureMetadata(field_name=FIELD, subfilter=SigSeedSubFilter.PADES)
    writer = IncrementalPdfFileWriter(io.BytesIO(pdf))
    signed: bytes = signers.sign_pdf(writer, metadata, signer=signer).getvalue()
    return signed
