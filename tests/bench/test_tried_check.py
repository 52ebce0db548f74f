"""A self-check of an extraction whose run does not come to its end."""

from __future__ import annotations

from certkit.bench.tried_check import tried
from certkit.documents.self_check import SelfCheck
from certkit.errors import RunError
from certkit.reporting.extraction_text import check_sentence


def test_a_run_that_does_not_end_is_a_failed_check_that_says_why() -> None:
    def runs_away() -> SelfCheck:
        raise RunError("F6 goes 700 mm; it has 200 mm of room")

    check = tried("coupled", (0.0, 1e-4), 0.045, runs_away)
    assert check.within is False
    assert check_sentence(check) == "Leg and front together: F6 goes 700 mm; it has 200 mm of room"
