"""A certificate of a logger's table, whose written times are no exact steps, holds."""

from __future__ import annotations

from pathlib import Path

from certkit import grade, render, verify

MEASURED = Path(__file__).parents[2] / "examples" / "measured"


def test_a_certificate_of_a_table_holds_right_after_it_was_made(tmp_path: Path) -> None:
    result = grade(
        "pendulum",
        MEASURED / "FLX-0007-pendulum.csv",
        mapping=MEASURED / "mapping.yaml",
        laboratory=MEASURED / "lab.yaml",
    )
    render(result, tmp_path, "none")
    assert [check.what for check in verify(tmp_path).checks if check.outcome == "does not hold"] == []
