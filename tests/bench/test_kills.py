"""A command that is killed at any moment leaves the old result or the new one, and the next cleans up.

A sample of what `python -m docs.make security --part kills` tries of every command.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from support.kills import COMMANDS, History, Killed, Run, Study, kill_command

SAMPLE = ((Run, 4), (Study, 2), (History, 3))


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks into /proc")
@pytest.mark.parametrize(("kind", "count"), SAMPLE, ids=[kind.name for kind, _ in SAMPLE])
def test_a_command_that_is_killed_leaves_the_old_or_the_new(kind: type[Killed], count: int, tmp_path: Path):
    tally = kill_command(kind, tmp_path / "killed", count, seed=12)
    assert tally.kills == count
    assert tally.wrong == []


def test_every_command_that_writes_documents_is_killed():
    assert {kind.name for kind in COMMANDS} == {
        "run",
        "run (PDF)",
        "grade",
        "extract",
        "study",
        "calibrate",
        "history add",
    }
