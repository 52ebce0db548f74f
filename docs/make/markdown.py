"""Small pieces of Markdown that the generated pages are built of."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


def cell(text: str) -> str:
    """Return a text that may stand in a table: one line, with its bars escaped."""
    return re.sub(r"\s+", " ", text).strip().replace("|", "\\|")


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table; columns that are empty in every row are left out.

    Parameters
    ----------
    heads : sequence of str
        Column heads.
    rows : iterable of sequence of str
        Cells, as many as there are heads.

    Returns
    -------
    str
        The table, or nothing when there are no rows.
    """
    given = [[cell(text) for text in row] for row in rows]
    if not given:
        return ""
    kept = [index for index in range(len(heads)) if any(row[index] for row in given)]
    lines = [[heads[index] for index in kept], ["---"] * len(kept)]
    lines += [[row[index] for index in kept] for row in given]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def anchor(*words: str) -> str:
    """Return an address within a page: `procedure-rig-ram`."""
    return re.sub(r"[^a-z0-9]+", "-", " ".join(words).lower()).strip("-")


def page(*parts: str) -> str:
    """Return parts, each set off by an empty line."""
    return "\n\n".join(part.strip("\n") for part in parts if part.strip()) + "\n"


def figure(value: float) -> str:
    """Return a number with four digits that count."""
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}"


def signed(value: float) -> str:
    """Return a number of per cent with its sign: `+1.2`, `−0.4`, `0.0`."""
    rounded = f"{abs(value):.1f}"
    return rounded if rounded == "0.0" else ("−" if value < 0 else "+") + rounded
