"""A laboratory's key with a certificate that it signed itself, as PKCS #12 and as PEM."""

from __future__ import annotations

import datetime as dt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

PASSPHRASE = "open sesame"  # noqa: S105  # of a key that tests make


def write_key(folder: Path, name: str = "Laboratory of Examples") -> tuple[Path, Path]:
    """Write the key (`.p12`) and its certificate (`.pem`); return both."""
    from cryptography import x509  # noqa: PLC0415  # comes with pyHanko
    from cryptography.hazmat.primitives import hashes, serialization  # noqa: PLC0415  # likewise
    from cryptography.hazmat.primitives.asymmetric import rsa  # noqa: PLC0415  # likewise
    from cryptography.hazmat.primitives.serialization import pkcs12  # noqa: PLC0415  # likewise

    private = rsa.generate_private_key(65537, 2048)
    subject = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, name)])
    day = dt.datetime(2026, 1, 1, tzinfo=dt.UTC)
    made = (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(subject)
        .public_key(private.public_key())
        .serial_number(1)
        .not_valid_before(day)
        .not_valid_after(day + dt.timedelta(days=36500))
        .add_extension(x509.BasicConstraints(ca=True, path_length=None), critical=True)
        .sign(private, hashes.SHA256())
    )
    secret = serialization.BestAvailableEncryption(PASSPHRASE.encode())
    key, root = folder / f"{name}.p12", folder / f"{name}.pem"
    key.write_bytes(pkcs12.serialize_key_and_certificates(b"key", private, made, None, secret))
    root.write_bytes(made.public_bytes(serialization.Encoding.PEM))
    return key, root
