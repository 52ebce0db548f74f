"""The channels of a result as CSV, written by `certkit.exchange.channels_csv`; of one result alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.exchange.channels_csv import channels_csv

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result

FILE = "channels.csv"
SUITE_FILE: str | None = None


def write(results: Sequence[Result], *, title: str | None, paper: str, spoken: str) -> str | None:
    """Return the table; None where the result holds no raw channels."""
    del title, paper, spoken
    return channels_csv(results[0])
