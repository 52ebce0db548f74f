"""What the page on security says of bounds and trials is what the code and its tests have."""

from __future__ import annotations

from support.further_forgeries import OUTSIDE
from support.kills import COMMANDS

from docs.make.reference import DOCS
from docs.make.trials import limits_table

PAGE = (DOCS / "security.md").read_text("utf-8")


def test_the_bounds_are_those_of_the_code():
    assert limits_table() in PAGE


def test_every_command_that_is_killed_and_every_forgery_that_is_not_seen_stands_there():
    assert [kind.name for kind in COMMANDS if f"| `{kind.name}` |" not in PAGE] == []
    assert [forgery.name for forgery, _ in OUTSIDE if f"| {forgery.name} |" not in PAGE] == []
