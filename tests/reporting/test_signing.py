from __future__ import annotations

import asyncio
import datetime as dt
import io
from typing import TYPE_CHECKING

import pytest
from support import synthetic_result

from certkit.bench.verify_signature import signature_checks
from certkit.errors import InputError, RunError
from certkit.reporting.own_thread import in_own_thread
from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import unique_views
from certkit.reporting.signing import sign

if TYPE_CHECKING:
    from pathlib import Path

pytest.importorskip("pyhanko", reason="the extra `signature` is not installed")


@pytest.fixture(scope="module")
def key(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Make a key with a certificate that it signed itself."""
    from cryptography import x509  # noqa: PLC0415  # comes with pyHanko
    from cryptography.hazmat.primitives import hashes, serialization  # noqa: PLC0415  # likewise
    from cryptography.hazmat.primitives.asymmetric import rsa  # noqa: PLC0415  # likewise
    from cryptography.hazmat.primitives.serialization import pkcs12  # noqa: PLC0415  # likewise

    private = rsa.generate_private_key(65537, 2048)
    name = x509.Name([x509.NameAttribute(x509.NameOID.COMMON_NAME, "Laboratory of Examples")])
    day = dt.datetime(2026, 1, 1, tzinfo=dt.UTC)
    made = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(private.public_key())
        .serial_number(1)
        .not_valid_before(day)
        .not_valid_after(day + dt.timedelta(days=36500))
        .sign(private, hashes.SHA256())
    )
    secret = serialization.BestAvailableEncryption(b"open sesame")
    path = tmp_path_factory.mktemp("key") / "laboratory.p12"
    path.write_bytes(pkcs12.serialize_key_and_certificates(b"key", private, made, None, secret))
    return path


def test_a_signature_is_valid_and_leaves_what_it_signs_as_it_was(
    key: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from pyhanko.pdf_utils.reader import PdfFileReader  # noqa: PLC0415  # an extra
    from pyhanko.sign.validation import validate_pdf_signature  # noqa: PLC0415  # likewise
    from pyhanko_certvalidator import ValidationContext  # noqa: PLC0415  # likewise

    monkeypatch.setenv("CERTKIT_PASSPHRASE", "open sesame")
    pdf = certificate(unique_views([synthetic_result.static_result()]))
    signed = sign(pdf, key)
    assert signed.startswith(pdf)
    (embedded,) = PdfFileReader(io.BytesIO(signed)).embedded_signatures
    trusted = ValidationContext(trust_roots=[embedded.signer_cert])
    status = in_own_thread(validate_pdf_signature, embedded, trusted)
    assert status.intact
    assert status.valid


def test_a_notebook_can_sign_and_verify_whose_thread_runs_an_event_loop(
    key: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("CERTKIT_PASSPHRASE", "open sesame")

    async def cell() -> list[str]:
        signed = sign(certificate(unique_views([synthetic_result.static_result()])), key)
        return [check.outcome for check in signature_checks(signed)]

    assert set(in_own_thread(asyncio.run, cell())) == {"holds"}  # apart from the loop of other tests


def test_a_wrong_passphrase_is_said(key: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CERTKIT_PASSPHRASE", "guess")
    with pytest.raises(InputError, match="set CERTKIT_PASSPHRASE"):
        sign(b"", key)


def test_a_missing_key_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.p12: there is no such key file"):
        sign(b"", tmp_path / "none.p12")


def test_a_timestamp_is_fetched_from_the_authority_that_is_named(
    key: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from pyhanko.pdf_utils.reader import PdfFileReader  # noqa: PLC0415  # an extra
    from pyhanko.sign import signers, timestamps  # noqa: PLC0415  # likewise

    monkeypatch.setenv("CERTKIT_PASSPHRASE", "open sesame")
    monkeypatch.setenv("CERTKIT_TIMESTAMP", "https://authority.example")
    own = signers.SimpleSigner.load_pkcs12(str(key), passphrase=b"open sesame")
    asked = []

    def authority(address: str) -> timestamps.DummyTimeStamper:
        asked.append(address)
        return timestamps.DummyTimeStamper(own.signing_cert, own.signing_key)

    monkeypatch.setattr(timestamps, "HTTPTimeStamper", authority)
    signed = sign(certificate(unique_views([synthetic_result.static_result()])), key)
    assert asked == ["https://authority.example"]
    (embedded,) = PdfFileReader(io.BytesIO(signed)).embedded_signatures
    told = [each["type"].native for each in embedded.signer_info["unsigned_attrs"]]
    assert told == ["signature_time_stamp_token"]


def test_an_authority_that_does_not_answer_is_said(key: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CERTKIT_PASSPHRASE", "open sesame")
    monkeypatch.setenv("CERTKIT_TIMESTAMP", "http://127.0.0.1:9/")
    with pytest.raises(RunError, match="timestamp authority of CERTKIT_TIMESTAMP does not answer"):
        sign(certificate(unique_views([synthetic_result.static_result()])), key)
