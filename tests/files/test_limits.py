"""What would take all memory or all time is refused with one line, and costs little."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from support.peak_memory import COMMANDS, tried

MOST_MEGABYTES = 600

BOMBS = [(make, arguments) for makers, arguments in COMMANDS for make in makers]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("make", "arguments"), BOMBS, ids=[f"{arguments[0]}-{make.__name__}" for make, arguments in BOMBS]
)
def test_a_bomb_is_refused_within_the_memory(
    make: Callable[[Path], Path], arguments: tuple[str, ...], tmp_path: Path
):
    found = tried(make, arguments, tmp_path)
    assert found.code == 2, found.said
    assert "Traceback" not in found.said
    assert "error: " in found.said
    assert found.megabytes <= MOST_MEGABYTES
    assert not (tmp_path / "out").exists()
