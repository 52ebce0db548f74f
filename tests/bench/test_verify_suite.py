"""The folder of a suite: each result in it is verified, and what binds them is held to these results."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

import certkit
from certkit.bench.render_documents import render_suite
from certkit.bench.verify import verify, verify_each
from certkit.cli.commands import whole_app
from certkit.documents.result import Result

DATA = Path(__file__).parents[2] / "examples" / "measured" / "FLX-0007-pendulum.zip"


@pytest.fixture(scope="module")
def suite(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the folder of a simulated and a measured test, in every format whose bytes can be compared."""
    folder = tmp_path_factory.mktemp("suite")
    results = [certkit.run("static-femur", refine=False), certkit.grade("pendulum", DATA)]
    for result in results:
        certkit.render(result, folder / result.procedure, "html")
    render_suite(results, folder, "html,junit,md", title="Tests of <May>", language="de")
    return folder


@pytest.fixture
def copied(suite: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(suite, tmp_path / "suite"))


def command(*words: object) -> tuple[int, str]:
    done = CliRunner().invoke(whole_app(), ["verify", *map(str, words)])
    return done.exit_code, done.output


def failed(folder: Path) -> list[str]:
    return [check.what for check in verify(folder).of("does not hold")]


def forge(path: Path) -> None:
    """Give a result another value of T1, and the id that goes with it."""
    result = Result.read(path)
    criteria = [c.model_copy(update={"value": 250.0}) if c.id == "T1" else c for c in result.criteria]
    path.write_text(result.model_copy(update={"criteria": criteria}).with_id().to_json(), encoding="utf-8")


def test_each_result_and_what_binds_them_has_one_line(suite: Path):
    code, said = command(suite)
    lines = [line for line in said.splitlines() if line.startswith(str(suite))]
    ids = {name: Result.read(suite / name / "result.json").id for name in ("pendulum", "static-femur")}
    assert code == 0, said
    assert [line.partition(" (")[0] for line in lines] == [
        *(str(suite / name) for name in sorted(ids)),
        str(suite),
    ]
    assert all(each in line for each, line in zip(ids.values(), lines, strict=False))
    assert all("holds: " in line for line in lines)
    checked = {check.what for check in verify_each(suite)[-1].checks if check.holds}
    assert checked == {"index.html", "junit.xml", "summary.md"}


def test_one_made_up_value_ends_the_whole_with_exit_code_1(copied: Path):
    forge(copied / "pendulum" / "result.json")
    code, said = command(copied)
    assert code == 1
    assert f"{copied / 'static-femur'} (" in said
    found = failed(copied)
    assert "pendulum: graded again: T1" in found
    assert "index.html" in found
    assert not any(each.startswith("static-femur") for each in found)


def test_a_changed_index_page_does_not_hold(copied: Path):
    page = copied / "index.html"
    page.write_text(page.read_text("utf-8").replace("Tibia", "Fibula"), "utf-8")
    assert failed(copied) == ["index.html"]


def test_a_page_of_a_result_that_is_not_there_does_not_hold(copied: Path):
    shutil.rmtree(copied / "pendulum")
    assert sorted(failed(copied)) == ["index.html", "junit.xml", "summary.md"]
    shutil.rmtree(copied / "static-femur")
    code, said = command(copied)
    assert code != 0
    assert "holds" not in said


def test_a_result_that_the_page_says_nothing_of_is_named(copied: Path):
    other = certkit.run("static-tibia", refine=False)
    certkit.render(other, copied / "static-tibia", "none")
    found = verify(copied)
    (told,) = [check for check in found.checks if "index.html" in check.said]
    assert (told.outcome, told.asked) == ("not checked", False)
    assert "static-tibia" in told.said
    assert told.said in command(copied)[1]
    assert found.holds
    assert set(found.ids) >= {other.id}


def test_the_document_of_a_suites_verification_has_an_item_a_line(suite: Path):
    code, said = command(suite, "--json")
    found = json.loads(said)
    assert code == 0
    assert [each["certificate"] for each in found] == [
        str(suite / "pendulum"),
        str(suite / "static-femur"),
        str(suite),
    ]


def test_recordings_are_held_to_the_results_of_a_suite(suite: Path):
    (found,) = [each for each in verify_each(suite, [DATA]) if each.certificate.endswith("pendulum")]
    assert any(check.holds and DATA.name in check.what for check in found.checks), found.checks


def test_the_bound_certificate_is_one_of_the_results_beside_it(copied: Path):
    results = [Result.read(copied / name / "result.json") for name in ("static-femur", "pendulum")]
    render_suite(results, copied, "html,junit,md,pdf", title="Tests of <May>", language="de")
    (bound,) = [each for each in verify_each(copied) if each.certificate == str(copied)]
    assert not bound.of("does not hold")
    assert any(check.what == "suite.pdf: certificate" and check.holds for check in bound.checks)
    code, said = command(copied, copied / "suite.pdf", "--quick")
    assert code == 0, said
    forge(copied / "pendulum" / "result.json")
    assert "suite.pdf: certificate" in failed(copied)
