"""Progress of many runs on a terminal: how many are done, how many failed, how long it may still take."""

from __future__ import annotations

import contextlib
import sys
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextlib.contextmanager
def resumable(*, fresh: bool) -> Iterator[None]:
    """Tell whoever presses Ctrl-C that the finished runs are kept, and how to go on from them."""
    try:
        yield
    except KeyboardInterrupt:
        same = "the same command without --fresh" if fresh else "the same command"
        typer.echo(f"interrupted; the runs that are done are kept, {same} goes on from there", err=True)
        raise typer.Exit(130) from None


@contextlib.contextmanager
def counting(what: str, *, quiet: bool) -> Iterator[Callable[[int, int, int], None]]:
    """Show done, total and failed runs on standard error, where somebody watches."""
    if quiet or not sys.stderr.isatty():
        yield lambda *_: None
        return
    from rich.console import Console  # noqa: PLC0415  # 60 ms that pipes need not pay
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn  # noqa: PLC0415  # likewise
    from rich.progress import TimeRemainingColumn as TimeLeft  # noqa: PLC0415  # likewise

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeLeft())
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        task = shown.add_task(what, total=None)

        def count(done: int, total: int, failed: int) -> None:
            words = f"{what}, {failed} failed" if failed else what
            shown.update(task, completed=done, total=total, description=words)

        yield count
