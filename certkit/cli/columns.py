"""Tables for people on a terminal, and the same rows with tabs between the columns for everything else."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


def show(heads: Sequence[str], rows: Iterable[Sequence[str]], *, title: str = "") -> None:
    """Print a table on standard output.

    Parameters
    ----------
    heads : sequence of str
        Column heads; left out where nobody looks.
    rows : iterable of sequence of str
        As many cells as there are heads.
    title : str
        Stands above the table on a terminal.
    """
    if not sys.stdout.isatty():
        for row in rows:
            typer.echo("\t".join(row))
        return
    from rich import box  # noqa: PLC0415  # 40 ms that a pipe need not wait for
    from rich.console import Console  # noqa: PLC0415  # likewise
    from rich.table import Table  # noqa: PLC0415  # likewise
    from rich.text import Text  # noqa: PLC0415  # likewise

    table = Table(*heads, title=title or None, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))  # as it stands: a `[` in a source is no markup
    Console().print(table)
