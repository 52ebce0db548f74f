"""Certificates on paper hold whoever signed them, in each language, alone and bound; and not when changed."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from support.signing_key import PASSPHRASE, write_key
from typer.testing import CliRunner

import certkit
from certkit.bench.verification import Verification
from certkit.bench.verify import verify
from certkit.cli.commands import whole_app
from certkit.documents.result import Result
from certkit.errors import CertkitError
from certkit.reporting.language import languages
from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import unique_views
from certkit.reporting.signing import sign

DATA = Path(__file__).parents[2] / "examples" / "measured"


@pytest.fixture(scope="module")
def measured() -> Result:
    return certkit.grade(
        "pendulum", DATA / "FLX-0007-pendulum.zip", laboratory=DATA / "lab.yaml"
    ).as_written()


@pytest.fixture(scope="module")
def bending() -> Result:
    return certkit.run("static-femur", refine=False).as_written()


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Path, Path]]:
    """Keys and roots of a laboratory and of somebody else."""
    pytest.importorskip("pyhanko", reason="the extra `signature` is not installed")
    folder = tmp_path_factory.mktemp("keys")
    return {name: write_key(folder, name) for name in ("Laboratory of Examples", "Mallory")}


@pytest.fixture
def signed(
    measured: Result, keys: dict[str, tuple[Path, Path]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Path:
    monkeypatch.setenv("CERTKIT_PASSPHRASE", PASSPHRASE)
    path = tmp_path / "signed.pdf"
    path.write_bytes(sign(certificate(unique_views([measured])), keys["Laboratory of Examples"][0]))
    return path


def told(found: Verification) -> list[str]:
    return [f"{check.what}: {check.code}" for check in found.checks if check.asked and not check.holds]


@pytest.mark.parametrize("spoken", languages())
def test_a_certificate_in_any_language_holds(bending: Result, spoken: str, tmp_path: Path):
    path = tmp_path / "report.pdf"
    try:
        path.write_bytes(certificate(unique_views([bending], spoken), paper="Letter"))
    except CertkitError as error:
        pytest.skip(str(error))
    assert told(verify(path)) == []


def test_a_suite_holds_with_its_own_title(measured: Result, bending: Result, tmp_path: Path):
    path = tmp_path / "suite.pdf"
    path.write_bytes(certificate(unique_views([measured, bending]), title="Legform 7, spring"))
    found = verify(path)
    assert told(found) == []
    assert found.ids == (measured.id, bending.id)


def test_a_signed_certificate_holds_and_names_its_signer(signed: Path, keys: dict[str, tuple[Path, Path]]):
    found = verify(signed)
    assert told(found) == []
    assert any("Laboratory of Examples" in check.said for check in found.checks if check.what == "signature")
    found = verify(signed, trust=keys["Laboratory of Examples"][1])
    assert told(found) == []
    assert any(check.code == "signature-trusted" for check in found.checks)


def test_the_root_of_somebody_else_does_not_vouch(signed: Path, keys: dict[str, tuple[Path, Path]]):
    assert told(verify(signed, trust=keys["Mallory"][1])) == ["signature: signature-not-trusted"]


def test_without_a_signature_nothing_that_trust_is_asked_for_holds(
    measured: Result, keys: dict[str, tuple[Path, Path]], tmp_path: Path
):
    path = tmp_path / "report.pdf"
    path.write_bytes(certificate(unique_views([measured])))
    found = verify(path, trust=keys["Mallory"][1])
    assert told(found) == ["signature: unsigned-though-trust"]


def test_what_is_changed_after_signing_is_named(signed: Path):
    pikepdf = pytest.importorskip("pikepdf")
    content = signed.read_bytes()
    target = io.BytesIO()
    with pikepdf.open(io.BytesIO(content)) as pdf:
        pdf.pages[0].contents_add(pdf.make_stream(b"1 g 60 660 200 60 re f"), prepend=False)
        pdf.save(target)
    signed.write_bytes(target.getvalue())
    assert any(each.startswith("signature: ") for each in told(verify(signed)))
    place = content.index(b"/ByteRange")
    changed = bytearray(content)
    changed[place - 5000] ^= 1
    signed.write_bytes(bytes(changed))
    assert not verify(signed).holds


def test_a_recording_beside_a_certificate_is_compared(measured: Result, tmp_path: Path):
    path = tmp_path / "result.json"
    measured.write(path)
    found = verify(path, [DATA / "FLX-0007-pendulum.zip"])
    assert told(found) == []
    assert any(check.code == "source-same" for check in found.checks)
    other = certkit.export(measured, tmp_path / "other.zip")
    assert "recording other.zip: source-differs" in told(verify(path, [other]))


def test_a_hash_copied_from_another_recording_does_not_help(measured: Result, tmp_path: Path):
    channels = measured.channels
    assert channels is not None
    series = channels.series["F1"]
    halved = series.model_copy(update={"values": [value / 2 for value in series.values]})
    changed = channels.model_copy(update={"series": {**channels.series, "F1": halved}})
    path = tmp_path / "result.json"
    measured.model_copy(update={"channels": changed}).with_id().write(path)
    found = verify(path, [DATA / "FLX-0007-pendulum.zip"])
    assert "recording FLX-0007-pendulum.zip: channels-of-source-differ" in told(found)


def test_pages_of_another_version_are_not_called_checked(measured: Result, tmp_path: Path):
    older = measured.provenance.model_copy(update={"certkit": "0.0.9"})
    path = tmp_path / "report.pdf"
    path.write_bytes(certificate(unique_views([measured.model_copy(update={"provenance": older}).with_id()])))
    found = verify(path)
    assert found.outcome == "not checked"
    assert "pages: pages-of-another-version" in told(found)
    done = CliRunner().invoke(whole_app(), ["verify", str(path)])
    assert done.exit_code == 4
    assert "stays invented" in done.stdout.splitlines()[-1]


def test_quick_leaves_the_simulation_out_and_says_so(bending: Result, tmp_path: Path):
    path = tmp_path / "result.json"
    bending.write(path)
    done = CliRunner().invoke(whole_app(), ["verify", "--quick", str(path)])
    assert done.exit_code == 0
    assert "– reproduction: left out by --quick" in done.stdout
    assert f"verdict {bending.verdict}" in done.stdout
