"""The channels of a result as CSV, written by `certkit.exchange.channels_csv`; of one result alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.exchange.channels_csv import channels_csv

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.reporting.result_view import View

FILE = "channels.csv"
SUITE_FILE: str | None = None
TRANSLATED = False
REPEATABLE = False  # `verify` compares the table by itself: another certkit may say more above it


def write(views: Sequence[View], *, title: str | None, paper: str) -> str | None:
    """Return the table; None where the result holds no raw channels."""
    del title, paper
    return channels_csv(views[0].document)
