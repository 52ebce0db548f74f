"""From a laboratory's ISO-MME files to a signed certificate, and what is refused or named on the way.

The set is made up: five tests of one legform, one report amended, one load cell out of its calibration.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from support.command import Command
from support.signing_key import write_key

import certkit
from certkit.bench.render_documents import render
from certkit.bench.verify import verify
from certkit.documents.legform_certificate import LegformCertificate
from certkit.documents.result import Result

EXAMPLES = Path(__file__).parents[2] / "examples"
TESTS = ("static-femur", "static-tibia", "static-knee", "pendulum", "inverse")


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the laboratory's files, and the graded tests in `runs`."""
    folder = tmp_path_factory.mktemp("laboratory")
    for path in (*(EXAMPLES / "certification").glob("*.*"), EXAMPLES / "measured" / "FLX-0007-pendulum.zip"):
        shutil.copy(path, folder)
    for name, file in (*((each, each) for each in TESTS), ("inverse", "inverse-amended")):
        result = certkit.grade(name, folder / f"FLX-0007-{name}.zip", laboratory=folder / f"{file}.yaml")
        render(result, folder / "runs" / file, "none")
    return folder


@pytest.fixture(scope="module")
def made(laboratory: Path) -> LegformCertificate:
    """Return the certificate by UN R127."""
    runs = [laboratory / "runs" / name for name in (*TESTS, "inverse-amended")]
    folder = laboratory / "logbook"
    return certkit.certify(
        "FLX-0007", runs, folder=folder, laboratory=laboratory / "lab.yaml", day="2026-03-10"
    )


def test_numbers_are_given_out_in_turn_and_an_amended_report_keeps_its_own(made: LegformCertificate):
    numbers = {test.procedure: (test.number, test.revision) for test in made.tests}
    assert numbers == {
        "static-femur": ("ECL-2026-0001", 0),
        "static-tibia": ("ECL-2026-0002", 0),
        "static-knee": ("ECL-2026-0003", 0),
        "pendulum": ("ECL-2026-0004", 0),
        "inverse": ("ECL-2026-0005", 1),
    }
    assert made.number == "ECL-2026-0006"


def test_static_tests_without_limits_are_not_evaluated_and_the_certificate_says_so(made: LegformCertificate):
    verdicts = {test.procedure: test.verdict for test in made.tests}
    assert (verdicts["pendulum"], verdicts["inverse"], made.verdict) == ("pass", "pass", "not evaluated")
    for name in ("static-femur", "static-tibia"):
        assert f"{name} is not evaluated: no limits are known to grade it by." in made.remarks


def test_an_expired_load_cell_is_named(made: LegformCertificate):
    said = next(remark for remark in made.remarks if remark.startswith("static-knee"))
    assert "the calibration of load cell LC-32 expired on 2026-02-20" in said


def test_a_certificate_holds_and_its_pages_do(made: LegformCertificate, tmp_path: Path):
    render(made, tmp_path, "html,pdf")
    for path in (tmp_path / "certificate.json", tmp_path / "certificate.pdf"):
        found = verify(path)
        assert [check for check in found.checks if check.asked and not check.holds] == []
        assert found.verdicts == ("not evaluated",)
    page = tmp_path / "certificate.html"
    page.write_text(page.read_text().replace("not evaluated", "pass"))
    failed = [check.what for check in verify(tmp_path).of("does not hold")]
    assert failed == ["certificate.html"]


def other_serial(result: Result) -> Result:
    laboratory = {**(result.laboratory or {}), "item": {"serial": "FLX-0008"}}
    return result.model_copy(update={"laboratory": laboratory, "id": ""}).with_id()


def simulated(result: Result) -> Result:
    return result.model_copy(update={"kind": "virtual certification", "id": ""}).with_id()


def forged(made: LegformCertificate, place: int, result: Result) -> LegformCertificate:
    """Put another result into a certificate, and make all ids fit."""
    old = made.results[place].id
    results = [result if number == place else each for number, each in enumerate(made.results)]
    tests = [t.model_copy(update={"id": result.id if t.id == old else t.id}) for t in made.tests]
    lines = [t.model_copy(update={"id": result.id if t.id == old else t.id}) for t in made.logbook.tests]
    logbook = made.logbook.model_copy(update={"tests": lines, "id": ""}).with_id()
    changes = {"results": results, "tests": tests, "logbook": logbook, "id": ""}
    return made.model_copy(update=changes).with_id()


@pytest.mark.parametrize(
    ("forge", "says"),
    [
        (other_serial, "is a test of the legform FLX-0008; serial numbers are not mixed"),
        (simulated, "is a virtual certification, not a measured test"),
    ],
)
def test_a_swapped_or_simulated_test_is_named_by_verify(
    made: LegformCertificate, tmp_path: Path, forge: Callable[[Result], Result], says: str
):
    changed = forged(made, 1, forge(made.results[1]))
    changed.write(tmp_path / "certificate.json")
    said = [check.said for check in verify(tmp_path / "certificate.json").of("does not hold")]
    assert any(says in each for each in said)


def test_a_replaced_report_in_a_certificate_is_named_by_verify(
    made: LegformCertificate, laboratory: Path, tmp_path: Path
):
    first = Result.read(laboratory / "runs" / "inverse" / "result.json")
    assert made.results[0].procedure == "inverse"
    results = [first, *made.results[1:]]
    changed = made.model_copy(update={"results": results, "id": ""}).with_id()
    changed.write(tmp_path / "certificate.json")
    said = [check.said for check in verify(tmp_path / "certificate.json").of("does not hold")]
    assert any(f"was replaced by the report {made.results[0].id}" in each for each in said)


def test_a_verdict_that_was_mended_by_hand_is_named(made: LegformCertificate, tmp_path: Path):
    made.model_copy(update={"verdict": "pass", "id": ""}).with_id().write(tmp_path / "certificate.json")
    failed = [check.what for check in verify(tmp_path / "certificate.json").of("does not hold")]
    assert failed == ["put together again: verdict"]


def test_the_old_report_is_said_to_be_replaced_when_the_new_one_lies_beside_it(laboratory: Path):
    old, new = (laboratory / "runs" / name for name in ("inverse", "inverse-amended"))
    check = next(each for each in verify(old, others=[old, new]).checks if each.code == "replaced-by")
    assert check.outcome == "does not hold"
    assert "ECL-2026-0005, revision 1" in check.said
    assert "the speed trap was missing" in check.said
    assert verify(new, others=[old, new]).holds
    assert verify(old).holds  # nobody can know of a report that is not there


@pytest.mark.usefixtures("made")
def test_a_wrong_passphrase_is_one_line(
    laboratory: Path,
    tmp_path: Path,
    certkit: Command,
):
    pytest.importorskip("pyhanko", reason="the extra `signature` is not installed")
    key, _ = write_key(tmp_path)
    words = (
        "certify",
        "FLX-0007",
        "--logbook",
        laboratory / "logbook",
        "--out",
        tmp_path / "made",
        "--sign",
        key,
    )
    refused = certkit(*map(str, words), CERTKIT_PASSPHRASE="guess")  # noqa: S106  # a wrong one
    assert (refused.returncode, refused.stdout) == (2, "")
    assert refused.stderr.count("\n") == 1
    assert "the key cannot be opened: its passphrase is another one" in refused.stderr
    assert not (tmp_path / "made").exists()


def test_a_wrong_passphrase_is_said_before_anything_is_computed(tmp_path: Path, certkit: Command):
    pytest.importorskip("pyhanko", reason="the extra `signature` is not installed")
    key, _ = write_key(tmp_path)
    refused = certkit("run", "pendulum", "--sign", str(key), CERTKIT_PASSPHRASE="guess")  # noqa: S106  # a wrong one
    assert refused.returncode == 2
    assert refused.stderr.count("\n") == 1
    assert "the key cannot be opened" in refused.stderr
    assert not (tmp_path / "runs").exists()
