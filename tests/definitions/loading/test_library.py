"""Definitions are found by name or path; one's own come first, and names lead nowhere else."""

from __future__ import annotations

import shutil
from hashlib import sha256
from pathlib import Path

import pytest

from certkit.definitions.loading.kinds import KINDS, kind_of
from certkit.definitions.loading.library import load, names, neighbours
from certkit.definitions.loading.search_path import FolderStore, RememberedStore, TextStore, shipped_root
from certkit.errors import DefinitionError, UsageError

PENDULUM = shipped_root() / "procedures" / "pendulum.yaml"


def test_a_shipped_definition_is_found_by_its_name_from_any_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    loaded = load("procedure", "pendulum")
    assert (loaded.kind, loaded.name, loaded.path) == ("procedure", "pendulum", "procedures/pendulum.yaml")
    assert loaded.sha256 == sha256(PENDULUM.read_bytes()).hexdigest()
    assert loaded.text == PENDULUM.read_text(encoding="utf-8")


@pytest.mark.parametrize("place", ["", "procedures"])
def test_a_file_in_ones_own_library_wins_over_a_shipped_name(tmp_path: Path, place: str):
    folder = tmp_path / place
    folder.mkdir(exist_ok=True)
    text = PENDULUM.read_text(encoding="utf-8").replace("title: Dynamic", "title: Our dynamic")
    (folder / "pendulum.yaml").write_text(text, encoding="utf-8")
    loaded = load("procedure", "pendulum", library=[tmp_path])
    assert loaded.document.title.startswith("Our dynamic")
    assert loaded.path.endswith("pendulum.yaml")
    assert not Path(loaded.path).is_absolute()


def test_a_family_is_found_where_a_fit_writes_it(tmp_path: Path):
    folder = tmp_path / "families"
    folder.mkdir()
    members = "".join(f"  - {{id: a{n}, values: {{parts.femur.segments: {n}}}}}\n" for n in (6, 8))
    head = "family: flex-pli-gtr\ntitle: Two legs\nlegform: flex-pli-gtr\nmembers:\n"
    (folder / "flex-pli-gtr.yaml").write_text(head + members, encoding="utf-8")
    assert load("family", "flex-pli-gtr", library=[tmp_path]).document.title == "Two legs"


def test_the_first_of_several_libraries_wins(tmp_path: Path):
    for number in (1, 2):
        folder = tmp_path / str(number)
        folder.mkdir()
        text = PENDULUM.read_text(encoding="utf-8").replace("title: Dynamic", f"title: Lab {number}")
        (folder / "pendulum.yaml").write_text(text, encoding="utf-8")
    assert load("procedure", "pendulum", library=[tmp_path / "2", tmp_path / "1"]).document.title.startswith(
        "Lab 2"
    )


def test_what_the_own_library_lacks_is_found_among_the_shipped(tmp_path: Path):
    shutil.copy(PENDULUM, tmp_path)
    assert load("procedure", "inverse", library=[tmp_path]).path == "procedures/inverse.yaml"


def test_a_library_in_which_nothing_is_found_is_no_library(tmp_path: Path):
    (tmp_path / "notes.txt").write_text("procedure: pendulum\n")
    with pytest.raises(UsageError, match="holds no definitions; name the folder that has"):
        load("procedure", "pendulum", library=[tmp_path])


OURS = PENDULUM.read_text(encoding="utf-8").replace("title: Dynamic", "title: Ours, dynamic")


@pytest.mark.parametrize(
    ("data", "name"),
    [
        (b"\xef\xbb\xbf" + OURS.encode(), "pendulum.yaml"),
        (("# Ours.\n" * 2000 + OURS).encode(), "pendulum.yaml"),
        (OURS.replace("procedure: pendulum", '"procedure": pendulum').encode(), "pendulum.yaml"),
        (OURS.replace("procedure: pendulum\n", "").encode() + b"procedure: pendulum\n", "pendulum.yaml"),
        (b"---\n" + OURS.encode(), "pendulum.yaml"),
        (OURS.encode(), "pendulum.YML"),
    ],
    ids=[
        "byte order mark",
        "long comment",
        "quoted key",
        "key at the end",
        "document start",
        "capital ending",
    ],
)
def test_ones_own_file_decides_however_it_was_saved(tmp_path: Path, data: bytes, name: str):
    (tmp_path / name).write_bytes(data)
    assert load("procedure", "pendulum", library=[tmp_path]).document.title.startswith("Ours")
    assert "pendulum" in names("procedure", [tmp_path])


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (OURS.encode("utf-16"), "saved as UTF-16; save it as UTF-8"),
        (b"", "empty"),
        (b"# nothing but this\n", "empty"),
        (b"procedre: pendulum\n", "begins with `procedre`, which is no kind of definition"),
        (b"[pendulum]\n", "mapping"),
    ],
    ids=["utf-16", "empty", "comment", "misspelt", "list"],
)
def test_ones_own_file_that_says_no_kind_is_not_passed_over_for_the_shipped_one(
    tmp_path: Path, data: bytes, message: str
):
    (tmp_path / "pendulum.yaml").write_bytes(data)
    with pytest.raises(DefinitionError, match=message):
        load("procedure", "pendulum", library=[tmp_path])


def test_a_file_of_another_kind_and_the_same_name_is_not_meant(tmp_path: Path):
    (tmp_path / "pendulum.yaml").write_text("reference: pendulum\ntitle: Peaks\n")
    assert load("procedure", "pendulum", library=[tmp_path]).path == "procedures/pendulum.yaml"


@pytest.mark.parametrize(
    "name", ["../outside", "/outside", "a/b", "..", "C:\\x", "nul", "COM1.x", "ends.", "x.yaml"]
)
def test_no_name_in_a_file_leads_out_of_its_folder(tmp_path: Path, name: str):
    path = tmp_path / "mine.yaml"
    path.write_text(OURS.replace("procedure: pendulum", f"procedure: '{name}'"), encoding="utf-8")
    with pytest.raises(DefinitionError, match=r"mine.yaml:\d+:\d+: .*is no name"):
        load("procedure", path)


def test_a_file_is_read_by_its_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    shutil.copy(PENDULUM, tmp_path / "copy.yaml")
    monkeypatch.chdir(tmp_path)
    assert load("procedure", "copy.yaml").path == "copy.yaml"
    assert load("procedure", "./copy.yaml").name == "pendulum"
    assert load("procedure", tmp_path / "copy.yaml").path == "copy.yaml"


def test_no_result_ever_holds_an_absolute_path(tmp_path: Path):
    shutil.copy(PENDULUM, tmp_path / "copy.yaml")
    assert load("procedure", tmp_path / "copy.yaml").path == "copy.yaml"
    shutil.copy(PENDULUM, tmp_path / "pendulum.yaml")
    assert load("procedure", "pendulum", library=[tmp_path]).path == f"{tmp_path.name}/pendulum.yaml"


@pytest.mark.parametrize(
    "name", ["..", "a..b", ".hidden", "~root", "a\\b", "a\0b", "", " ", "x" * 200, "-rf"]
)
def test_a_name_leads_nowhere_else(name: str):
    with pytest.raises(UsageError, match="is no name of a procedure"):
        load("procedure", name)


def test_a_name_inside_a_procedure_is_no_path(tmp_path: Path):
    text = PENDULUM.read_text(encoding="utf-8").replace("legform: flex-pli-gtr", "legform: ../../secret")
    (tmp_path / "mine.yaml").write_text(
        text.replace("procedure: pendulum", "procedure: mine"), encoding="utf-8"
    )
    with pytest.raises(DefinitionError, match=r"mine.yaml:\d+:\d+: .*`\.\./\.\./secret` is no name"):
        load("procedure", tmp_path / "mine.yaml")


def test_an_unknown_name_brings_the_nearest_one():
    with pytest.raises(UsageError, match="there is no procedure `pendlum`; did you mean `pendulum`"):
        load("procedure", "pendlum")


def test_a_missing_file_and_a_missing_library_are_said_plainly(tmp_path: Path):
    with pytest.raises(DefinitionError, match=r"nowhere.yaml: does not exist"):
        load("procedure", tmp_path / "nowhere.yaml")
    with pytest.raises(DefinitionError, match="is a folder"):
        load("procedure", tmp_path)
    with pytest.raises(UsageError, match="is no folder"):
        load("procedure", "pendulum", library=[tmp_path / "nowhere"])


def test_a_file_that_calls_itself_otherwise_is_refused(tmp_path: Path):
    shutil.copy(PENDULUM, tmp_path / "other.yaml")
    with pytest.raises(DefinitionError, match="has to be `other` too"):
        load("procedure", "other", library=[tmp_path])


def test_texts_at_hand_can_stand_in_for_files():
    text = PENDULUM.read_text(encoding="utf-8").replace("title: Dynamic", "title: Embedded")
    store = TextStore({("procedure", "pendulum"): text})
    loaded = load("procedure", "pendulum", library=[store])
    assert loaded.document.title.startswith("Embedded")
    assert names("procedure", [store]) == names("procedure")


def test_files_of_several_kinds_may_share_a_folder(tmp_path: Path):
    shutil.copy(PENDULUM, tmp_path / "pendulum.yaml")
    shutil.copy(shipped_root() / "corridors" / "r127-pendulum.yaml", tmp_path / "r127-pendulum.yaml")
    assert "r127-pendulum" not in names("procedure", [tmp_path])
    assert load("corridors", "r127-pendulum", library=[tmp_path]).path.startswith(tmp_path.name)


def test_beside_a_file_lie_its_folder_and_its_library():
    roots = [str(store.folder) for store in neighbours(Path("lab/models/legforms/mine.yaml"))]
    assert roots == ["lab/models/legforms", "lab"]
    assert [str(store.folder) for store in neighbours(Path("mine.yaml"))] == ["."]


@pytest.mark.parametrize(
    "word", ["procedure", "procedures", "corridors", "corridor", "legforms", "models/legforms"]
)
def test_a_kind_is_known_by_its_word_its_plural_and_its_folder(word: str):
    assert kind_of(word).word in KINDS


def test_an_unknown_kind_brings_the_nearest_one():
    with pytest.raises(UsageError, match="`procdure` is no kind of definition; did you mean `procedure`"):
        kind_of("procdure")


def test_a_remembered_store_shows_what_it_showed_first(tmp_path: Path):
    (tmp_path / "corridors").mkdir()
    path = tmp_path / "corridors" / "mine.yaml"
    path.write_bytes(b"corridors: mine\n")
    store = RememberedStore(FolderStore(tmp_path))
    first = store.find(KINDS["corridors"], "mine")
    assert (first, store.names(KINDS["corridors"])) == (
        FolderStore(tmp_path).find(KINDS["corridors"], "mine"),
        ["mine"],
    )
    path.write_bytes(b"corridors: mine\ntitle: changed\n")
    (tmp_path / "corridors" / "other.yaml").write_bytes(b"corridors: other\n")
    assert store.find(KINDS["corridors"], "mine") == first
    assert store.names(KINDS["corridors"]) == ["mine"]
    assert FolderStore(tmp_path).find(KINDS["corridors"], "mine") != first
