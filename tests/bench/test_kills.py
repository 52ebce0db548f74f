"""A command that is killed at any moment leaves the old result or the new one, and the next cleans up."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.kills import kill_runs


@pytest.mark.slow
def test_a_run_that_is_killed_leaves_the_old_or_the_new_result(tmp_path: Path):
    assert kill_runs(tmp_path, 12, seed=12) == []
