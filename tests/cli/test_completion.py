"""What Tab offers, and what help calls values."""

from __future__ import annotations

import pytest
import typer
from typer.testing import CliRunner

from certkit.cli import app, completion


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


@pytest.mark.parametrize("path", ["rig.release.angle=", "legform.parts.femur.bending stiffness="])
def test_what_tab_offers_can_be_set(path: str):
    assert path in completion.settings(Line(named=["pendulum"]), path.partition(".")[0])


def test_help_says_words_and_not_pythons_types():
    group = typer.main.get_command(app)
    for name in group.commands:
        said = CliRunner().invoke(app, [name, "--help"], env={"COLUMNS": "200"}).output
        for word in ("<bool>", "<str>", "<path>", "list[", " BOOLEAN", "<int"):
            assert word not in said, (name, word)
    assert "FOLDER" in CliRunner().invoke(app, ["run", "--help"]).output
