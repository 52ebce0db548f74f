"""From a text on the desk to a certificate without the remark: by keyboard, by table, by two persons."""

from __future__ import annotations

import csv
import hashlib
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from typer.testing import CliRunner

import certkit
from certkit.bench.confirm import answered, open_confirmation
from certkit.cli.commands import whole_app
from certkit.definitions.loading.library import load
from certkit.definitions.loading.search_path import shipped_root
from certkit.definitions.provenance import Number
from certkit.errors import DefinitionError, UsageError

if TYPE_CHECKING:
    from click.testing import Result

TITLE = "UN R127, 02 series"
WORDS = ("confirm", "r127-inverse", "--by", "M. Weber", "--title", TITLE)


@pytest.fixture(autouse=True)
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Put a made-up regulation into an empty folder, and work there."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "R127.pdf").write_bytes(b"%PDF-1.7 made up\n%%EOF\n")
    return tmp_path


def told(*words: str, keys: str = "") -> Result:
    return CliRunner().invoke(whole_app(), [str(word) for word in words], input=keys, catch_exceptions=False)


def everything_confirmed() -> None:
    told(*WORDS, "--document", "R127.pdf", keys="y\nannex 6, 1.4\n" + "y\n\n" * 6)


def test_each_number_is_asked_for_and_kept_with_text_place_and_person(desk: Path):
    done = told(*WORDS, "--document", "R127.pdf", keys="y\nannex 6, 1.4\n" + "y\n\n" * 6)
    assert "[1/7] windows.T1: 230 N·m to 272 N·m" in done.output
    assert "7 of 7 numbers" in done.output
    loaded = load("corridors", "r127-inverse", library="library")
    entry = loaded.document.windows["T1"]
    digest = hashlib.sha256((desk / "R127.pdf").read_bytes()).hexdigest()
    assert entry.confidence == "verified"
    assert entry.source.startswith(f"{TITLE}, annex 6, 1.4 (SHA-256 {digest[:12]}…); read by M. Weber on 20")
    assert loaded.remarks == ()


def test_the_certificate_carries_the_confirmation_and_loses_the_remark():
    everything_confirmed()
    result = certkit.run("inverse", library="library")
    assert {c.confidence for c in result.criteria if c.graded} == {"verified"}
    assert not [remark for remark in result.coded_remarks if remark.code.startswith("rests-on-")]
    (carried,) = [item for item in result.provenance.inputs if item.role == "confirmation"]
    assert "M. Weber" in carried.text
    path = Path("out.json")
    result.write(path)
    assert told("verify", str(path)).exit_code == 0


def test_one_can_stop_and_go_on():
    told(*WORDS, keys="y\nannex 6\ns\nq\n")
    session = open_confirmation("r127-inverse", by="M. Weber")
    assert answered(session) == (1, 7)
    assert next(entry.path for entry in session.waiting()) == "windows.T2"


def test_what_the_text_does_not_say_is_not_verified(desk: Path):
    source = shipped_root() / "corridors" / "r127-inverse.yaml"
    (desk / "library" / "corridors").mkdir(parents=True)
    ours = desk / "library" / "corridors" / "r127-inverse.yaml"
    ours.write_text(source.read_text("utf-8").replace("verified", "recalled"), "utf-8")
    told(*WORDS, keys="n\n\nq\n")
    windows = load("corridors", "r127-inverse", library="library").document.windows
    assert windows["T1"].confidence == "recalled"
    assert next(entry.path for entry in open_confirmation("r127-inverse", by="X Y").waiting()) == "windows.T2"


def test_the_texts_own_value_goes_into_ones_own_copy_and_nothing_else_changes(desk: Path):
    done = told(*WORDS, keys="231 N·m to 272 N·m\n1.4\nq\n")
    assert done.exit_code == 0
    ours = (desk / "library" / "corridors" / "r127-inverse.yaml").read_text("utf-8")
    shipped = (shipped_root() / "corridors" / "r127-inverse.yaml").read_text("utf-8")
    assert ours == shipped.replace("230 N·m", "231 N·m", 1)
    entry = load("corridors", "r127-inverse", library="library").document.windows["T1"]
    assert (entry.lower, entry.confidence) == ("231 N·m", "verified")


@pytest.mark.parametrize("value", ["300 N·m to 272 N·m", "231 mm to 272 mm", "231", "at most 3 N·m", "x"])
def test_a_value_that_does_not_fit_is_asked_again_and_nothing_is_kept(desk: Path, value: str):
    told(*WORDS, keys=f"{value}\n\nq\n")
    assert not list(desk.rglob("*.yaml"))
    assert answered(open_confirmation("r127-inverse", by="M. Weber", title=TITLE))[0] == 0


def test_a_number_that_is_changed_afterwards_is_confirmed_no_longer(desk: Path):
    everything_confirmed()
    ours = desk / "library" / "corridors" / "r127-inverse.yaml"
    ours.parent.mkdir(exist_ok=True)
    text = (shipped_root() / "corridors" / "r127-inverse.yaml").read_text("utf-8")
    ours.write_text(text.replace("230 N·m", "229 N·m").replace("verified", "recalled"), "utf-8")
    loaded = load("corridors", "r127-inverse", library="library")
    assert loaded.document.windows["T1"].confidence == "recalled"
    assert loaded.document.windows["T2"].confidence == "verified"
    (remark,) = loaded.remarks
    assert "`windows.T1` was confirmed as `230 N·m to 272 N·m` and is `229 N·m to 272 N·m` now" in remark
    result = certkit.run("inverse", library="library")
    assert any("confirmed no longer" in note for note in result.notes)


def test_ones_own_other_copy_and_a_filled_in_table_are_not_written_over(desk: Path):
    mine = desk / "elsewhere" / "r127-inverse.yaml"
    mine.parent.mkdir()
    text = (shipped_root() / "corridors" / "r127-inverse.yaml").read_text("utf-8")
    mine.write_text(text, "utf-8")
    ours = desk / "library" / "corridors" / "r127-inverse.yaml"
    ours.parent.mkdir(parents=True)
    ours.write_text(text.replace("230 N·m", "229 N·m"), "utf-8")
    session = open_confirmation(mine, by="M. Weber", title=TITLE)
    with pytest.raises(UsageError, match="is another than"):
        session.answer("windows.T1", "231 N·m to 272 N·m", "1.4")
    assert "229 N·m" in ours.read_text("utf-8")
    (desk / "open.csv").write_text("filled in", "utf-8")
    table = (*WORDS, "--write-table", "open.csv")
    with pytest.raises(UsageError, match="exists with other content"):
        told(*table)
    assert (desk / "open.csv").read_text("utf-8") == "filled in"
    assert told(*table, "--force").exit_code == 0
    assert "windows.T1" in (desk / "open.csv").read_text("utf-8-sig")


@pytest.mark.parametrize("title", ["", "T", "  R "])
def test_a_title_that_is_none_is_said_so(title: str):
    with pytest.raises(UsageError, match="is no title"):
        open_confirmation("r127-inverse", by="M. Weber", title=title)


def test_a_table_does_as_well_as_the_keyboard(desk: Path):
    told(*WORDS, "--document", "R127.pdf", "--write-table", "open.csv")
    rows = list(csv.DictReader((desk / "open.csv").read_text("utf-8-sig").splitlines()))
    assert [row["path"] for row in rows][:2] == ["windows.T1", "windows.T2"]
    for row in rows:
        row["answer"], row["place"] = "yes", "annex 6, 1.4"
    rows[1]["answer"] = "211 N·m to 252 N·m"
    with (desk / "filled.csv").open("w", encoding="cp1252", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys(), delimiter=";")  # as a German spreadsheet saves it
        writer.writeheader()
        writer.writerows(rows)
    assert "7 of 7 numbers" in told(*WORDS, "--document", "R127.pdf", "--table", "filled.csv").output
    windows = load("corridors", "r127-inverse", library="library").document.windows
    assert {window.confidence for window in windows.values()} == {"verified"}
    assert windows["T2"].lower == "211 N·m"


def test_a_table_of_other_numbers_is_refused_with_its_row():
    told(*WORDS, "--write-table", "open.csv")
    text = Path("open.csv").read_text("utf-8-sig").replace("230 N·m", "200 N·m")
    Path("bad.csv").write_text(text.replace(",,\r\n", ",yes,\r\n").replace(",,\n", ",yes,\n"), "utf-8")
    with pytest.raises(UsageError, match=r"bad.csv: row 2: `windows.T1` is not `200 N·m to 272 N·m`"):
        told(*WORDS, "--table", "bad.csv")


def test_a_second_person_countersigns_and_the_first_cannot():
    everything_confirmed()
    done = told("confirm", "r127-inverse", "--by", "A. Sato", "--countersign", keys="y\n" * 7)
    assert done.exit_code == 0
    source = load("corridors", "r127-inverse", library="library").document.windows["MCL"].source
    assert "read by M. Weber on" in source
    assert "countersigned by A. Sato on" in source
    session = open_confirmation("r127-inverse", by="m. weber ")
    with pytest.raises(UsageError, match="another person countersigns"):
        session.countersign("windows.T1")
    path = session.path
    path.write_text(path.read_text("utf-8").replace("A. Sato", "M. Weber"), "utf-8")
    with pytest.raises(DefinitionError, match="another person countersigns"):
        load("corridors", "r127-inverse", library="library")


def test_another_text_needs_another_confirmation(desk: Path):
    everything_confirmed()
    (desk / "new.pdf").write_bytes(b"another edition")
    with pytest.raises(UsageError, match="begun with another text"):
        open_confirmation("r127-inverse", by="M. Weber", document="new.pdf")
    with pytest.raises(UsageError, match="which text is read"):
        open_confirmation("r127-pendulum", by="M. Weber")


def test_the_numbers_of_a_procedure_are_confirmed_like_a_corridors():
    session = open_confirmation("inverse", by="M. Weber", title=TITLE, kind="procedure")
    before = {entry.path: entry.value for entry in session.listed()}
    for path in before:
        session.answer(path, "yes", "1.4")
    loaded = load("procedure", "inverse", library="library")
    speed = loaded.document.rig.ram.speed
    assert isinstance(speed, Number)
    assert speed.confidence == "verified"
    assert {entry.path: entry.value for entry in session.listed()} == before
