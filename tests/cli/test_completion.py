"""What Tab offers, and what help calls values."""

from __future__ import annotations

import os

import pytest
import typer
from typer.testing import CliRunner

from certkit.cli import completion
from certkit.cli.commands import whole_app
from certkit.definitions.loading.library import names


class Line:
    """As much of a command line as has been written."""

    def __init__(self, **params: object) -> None:
        self.params = params


@pytest.mark.parametrize(
    ("incomplete", "offered"),
    [
        ("rig.release.a", ["rig.release.angle="]),
        ("legform.knee.condyles.fr", ["legform.knee.condyles.friction="]),
        ("legf", "legform="),
        ("legform=flex-pli-g", "legform=flex-pli-gtr"),
        ("rig.ram", []),
    ],
)
def test_tab_offers_what_set_can_change(incomplete: str, offered: list[str] | str):
    found = completion.settings(Line(named=["pendulum"]), incomplete)
    assert offered in found if isinstance(offered, str) else found == offered


def test_tab_follows_the_procedure_on_the_line():
    assert "rig.ram.speed=" in completion.settings(Line(procedure=["inverse"]), "rig.ram")
    assert any(
        path.startswith("vehicle.") for path in completion.settings(Line(named=["vehicle"]), "vehicle.")
    )
    assert completion.settings(Line(named=["no-such-test"]), "rig.") == []


@pytest.mark.parametrize("path", ["rig.release.angle=", "legform.parts.femur.bending_stiffness="])
def test_what_tab_offers_can_be_set(path: str):
    assert path in completion.settings(Line(named=["pendulum"]), path.partition(".")[0])


def test_no_offer_needs_quotes():
    assert not [path for path in completion.settings(Line(named=["pendulum"]), "") if " " in path]
    assert completion.settings(Line(named=["pendulum"]), "rig.added mass.m") == ["rig.added_mass.mass="]


@pytest.mark.parametrize(
    ("shell", "asked"),
    [
        ("bash", {"COMP_WORDS": "certkit\nrun\npendulum\n--set\nrig.added_m", "COMP_CWORD": "4"}),
        ("zsh", {"_TYPER_COMPLETE_ARGS": "certkit run pendulum --set rig.added_m"}),
        (
            "fish",
            {
                "_TYPER_COMPLETE_ARGS": "certkit run pendulum --set rig.added_m",
                "_TYPER_COMPLETE_FISH_ACTION": "get-args",
            },
        ),
    ],
)
def test_each_shell_is_offered_what_can_be_set(shell: str, asked: dict[str, str]):
    env = asked | {"_CERTKIT_COMPLETE": f"complete_{shell}"}
    said = CliRunner().invoke(whole_app(), [], prog_name="certkit", env=env).output
    assert "rig.added_mass.mass=" in said
    assert "rig.release" not in said


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        (["--set", "legform", "=", "flex-pli-g"], ["flex-pli-gtr"]),
        (["--set", "legform", "="], names("legform")),
        (["--set", "legform", "=", "apli", "--set", "rig.rel"], None),
    ],
)
def test_bash_takes_a_word_apart_at_its_equals_sign(
    line: list[str], offered: list[str] | None, monkeypatch: pytest.MonkeyPatch
):
    words = ["certkit", "run", "vehicle", *line]
    monkeypatch.setenv("COMP_WORDS", "\n".join(words))
    monkeypatch.setenv("COMP_CWORD", str(len(words) - 1))
    assert completion.words_of_bash() == offered
    if offered is None:
        assert os.environ["COMP_WORDS"].split("\n")[3:] == ["--set", "legform=apli", "--set", "rig.rel"]


def test_help_says_words_and_not_pythons_types():
    group = typer.main.get_command(whole_app())
    for name in group.commands:
        said = CliRunner().invoke(whole_app(), [name, "--help"], env={"COLUMNS": "200"}).output
        for word in ("<bool>", "<str>", "<path>", "list[", " BOOLEAN", "<int"):
            assert word not in said, (name, word)
    assert "FOLDER" in CliRunner().invoke(whole_app(), ["run", "--help"]).output
