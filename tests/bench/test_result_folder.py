"""A result folder holds one result as a whole, and none is overwritten in silence."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import support.synthetic_result as made_up
from support.command import Command

import certkit as bench
from certkit.bench.render_documents import render_pages
from certkit.bench.result_folder import AnotherResultError, distinct_names
from certkit.documents.result import Result
from certkit.documents.unverified import MARK, marked
from certkit.files.folder_switch import LIST, SWITCH, FolderSwitch


def other(result: Result) -> Result:
    """Return a result of the same procedure that fails."""
    return result.model_copy(update={"verdict": "fail"}).with_id()


@pytest.fixture
def result() -> Result:
    return made_up.static_result().with_id()


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def held(folder: Path) -> str:
    return str(json.loads((folder / "result.json").read_bytes())["id"])


def test_another_result_is_refused_and_the_old_one_stays_as_it_is(result: Result, tmp_path: Path):
    out = tmp_path / "out"
    bench.render(result, out, "html,junit")
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    with pytest.raises(AnotherResultError, match="--force"):
        bench.render(other(result), out, "junit")
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    assert names(tmp_path) == {"out"}


def test_the_same_result_again_is_written_and_keeps_its_other_pages(result: Result, tmp_path: Path):
    bench.render(result, tmp_path / "out", "html")
    bench.render(result, tmp_path / "out", "junit")
    assert names(tmp_path / "out") == {"result.json", "report.html", "junit.xml"}


def test_the_same_inputs_with_the_same_verdict_replace_an_older_result(result: Result, tmp_path: Path):
    bench.render(result, tmp_path / "out", "html")
    newer = result.model_copy(update={"title": "As a later version words it"}).with_id()
    bench.render(newer, tmp_path / "out", "none")
    assert held(tmp_path / "out") == newer.id
    assert names(tmp_path / "out") == {"result.json"}  # the page was the older one's


def test_one_test_exported_in_another_form_replaces_itself_and_another_test_does_not(
    result: Result, tmp_path: Path
):
    measured = result.model_copy(update={"kind": "test evaluation"}).with_id()
    bench.render(measured, tmp_path / "out", "none")
    file = measured.provenance.inputs[0].model_copy(update={"sha256": "0" * 64})
    again = measured.provenance.model_copy(update={"inputs": [file]})
    exported = measured.model_copy(update={"provenance": again}).with_id()
    bench.render(exported, tmp_path / "out", "none")
    assert held(tmp_path / "out") == exported.id != measured.id
    hotter = exported.model_copy(update={"conditions": {"temperature": 294.0}, "provenance": again})
    other_file = again.model_copy(update={"inputs": [file.model_copy(update={"sha256": "1" * 64})]})
    with pytest.raises(AnotherResultError):
        bench.render(hotter.model_copy(update={"provenance": other_file}).with_id(), tmp_path / "out", "none")


@pytest.mark.parametrize("foreign", [False, True])
def test_force_replaces_as_a_whole_but_leaves_what_is_somebody_elses(
    result: Result, tmp_path: Path, *, foreign: bool
):
    out = tmp_path / "out"
    bench.render(result, out, "html,junit,csv")
    drawn = out / f"{result.procedure}-corridor.svg"
    drawn.write_text("<svg/>")
    if foreign:
        (out / "notes.txt").write_text("mine")
    bench.render(other(result), out, "junit", force=True)
    assert names(out) == {"result.json", "junit.xml"} | ({"notes.txt"} if foreign else set())
    assert held(out) == other(result).id


def test_a_command_that_stands_in_the_folder_keeps_standing_in_it(
    result: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    bench.render(result, ".", "html")
    bench.render(other(result), ".", "junit", force=True)
    assert {path.name for path in Path().iterdir()} == {"result.json", "junit.xml"}


def test_a_numbered_folder_is_taken_where_the_named_one_is_in_use(result: Result, tmp_path: Path):
    said: list[str] = []
    for one in (result, other(result), other(result), result):
        bench.render(one, tmp_path / "out", "none", numbered=True, tell=said.append)
    assert (held(tmp_path / "out"), held(tmp_path / "out-2")) == (result.id, other(result).id)
    assert names(tmp_path) == {"out", "out-2"}
    assert all("stays" in line for line in said)


def test_pages_without_their_document_are_another_results_unless_they_say_the_id(
    result: Result, tmp_path: Path
):
    out = tmp_path / "out"
    bench.render(result, out, "html")
    (out / "result.json").unlink()
    with pytest.raises(AnotherResultError, match=r"report\.html"):
        bench.render(other(result), out, "junit")
    bench.render(result, out, "junit")


@pytest.mark.parametrize("force", [False, True])
def test_pages_of_a_changed_document_leave_it_where_it_is(result: Result, tmp_path: Path, *, force: bool):
    bench.render(result, tmp_path, "html")
    render_pages(marked(result), tmp_path, ["html"], force=force)
    assert held(tmp_path) == result.id
    assert MARK in (tmp_path / "report.html").read_text("utf-8")


def test_a_writer_that_fails_leaves_nothing(tmp_path: Path):
    def write_half() -> None:
        with FolderSwitch(tmp_path / "deep" / "out") as switch:
            (switch.stage / "half.txt").write_text("half")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        write_half()
    assert names(tmp_path) == set()


def test_what_a_killed_process_left_is_finished_or_removed_by_the_next(tmp_path: Path):
    out = tmp_path / "out"
    (out / SWITCH).mkdir(parents=True)
    (out / "old.txt").write_text("old")
    (out / "kept.txt").write_text("kept")
    (out / SWITCH / "new.txt").write_text("new")
    (out / SWITCH / LIST).write_text(json.dumps({"files": ["new.txt", "moved.txt"], "stale": ["old.txt"]}))
    (out / "moved.txt").write_text("new, and already in its place")
    (tmp_path / ".out.new").mkdir()
    (tmp_path / ".out.new" / "half").write_text("half")
    (tmp_path / ".out.lock").touch()
    with FolderSwitch(out) as switch:
        assert names(out) == {"new.txt", "moved.txt", "kept.txt"}
        (switch.stage / "newer.txt").write_text("newer")
    assert names(out) == {"new.txt", "moved.txt", "kept.txt", "newer.txt"}
    assert names(tmp_path) == {"out"}


def test_a_planted_list_leads_nowhere_else(tmp_path: Path):
    out = tmp_path / "out"
    (out / SWITCH).mkdir(parents=True)
    (tmp_path / "mine.txt").write_text("mine")
    plan = {"files": ["../mine.txt", "/etc/x"], "stale": ["../mine.txt", ".."]}
    (out / SWITCH / LIST).write_text(json.dumps(plan))
    with FolderSwitch(out):
        pass
    assert (tmp_path / "mine.txt").read_text() == "mine"


def test_recordings_of_one_name_go_into_folders_of_their_own(certkit: Command, table: Path, tmp_path: Path):
    for day in ("mon", "tue"):
        (tmp_path / day).mkdir()
        (tmp_path / day / "test.csv").write_bytes(table.read_bytes())
    graded = certkit(
        "grade", "-p", "pendulum", "mon/test.csv", "tue/test.csv", "--out", "x", "--format", "junit"
    )
    assert graded.returncode in {0, 4}, graded.stderr
    assert names(tmp_path / "x") == {"mon-test", "tue-test"}


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ([("a", ""), ("b", "")], ["a", "b"]),
        ([("a", "mon"), ("A", "tue")], ["mon-a", "tue-A"]),
        ([("a", "mon"), ("a", "mon")], ["mon-a", "mon-a-2"]),
        ([("a", ""), ("a", ""), ("a-2", "")], ["a", "a-2", "a-2-2"]),
    ],
)
def test_names_in_one_folder_differ(given: list[tuple[str, str]], found: list[str]):
    assert distinct_names(given) == found


def test_a_changed_test_without_out_is_numbered_and_with_out_refused(certkit: Command, tmp_path: Path):
    changed = ("--set", "rig.release.angle=25 deg", "--format", "junit")
    assert certkit("run", "pendulum", "--format", "junit").returncode == 0
    second = certkit("run", "pendulum", *changed)
    assert second.returncode == 1, second.stderr
    assert "runs/pendulum-2" in second.stderr
    refused = certkit("run", "pendulum", *changed, "--out", "runs/pendulum")
    assert refused.returncode == 2
    assert "--force" in refused.stderr
    assert names(tmp_path / "runs") == {"pendulum", "pendulum-2"}
    assert certkit("run", "pendulum", *changed, "--out", "runs/pendulum", "--force").returncode == 1


def test_a_figure_or_an_export_of_other_content_is_refused(certkit: Command, tmp_path: Path):
    assert certkit("run", "static-femur", "--format", "junit", "--out", "a").returncode == 4
    for command in (("figure", "a/result.json", "--out", "a.svg"), ("export", "a", "a.csv")):
        assert certkit(*command).returncode == 0
        assert certkit(*command).returncode == 0
    for name in ("a.svg", "a.csv"):
        (tmp_path / name).write_text("mine")
    for command in (("figure", "a/result.json", "--out", "a.svg"), ("export", "a", "a.csv")):
        assert certkit(*command).returncode == 2
        assert certkit(*command, "--force").returncode == 0
