"""What commands that grade have in common: arguments checked, progress, the verdict table, the exit code."""

from __future__ import annotations

import contextlib
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from certkit.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from certkit.documents.output_document import OutputDocument
    from certkit.documents.result import Result, Verdict
    from certkit.errors import CertkitError

ALLOWED: dict[str, Verdict] = {"not-evaluated": "not evaluated"}


def formats(words: str) -> list[str]:
    """Split `html,pdf` and check each; see `certkit.reporting.writing`. Of `none` the JSON alone is left."""
    from certkit.bench.render_documents import split  # noqa: PLC0415  # not on the path of `--help`
    from certkit.reporting.writing import checked  # noqa: PLC0415  # likewise

    return checked(split(words))


def allowed(words: Sequence[str] | None) -> list[Verdict]:
    """Turn `--allow not-evaluated` into verdicts."""
    for word in words or ():
        if word not in ALLOWED:
            raise UsageError(f"`--allow {word}`: only `not-evaluated` can be allowed")
    return [ALLOWED[word] for word in words or ()]


def procedures(named: Sequence[str] | None, *, every: bool, library: Sequence[Path]) -> list[str]:
    """Return the procedures to run: those named, or all that the library knows."""
    from certkit.definitions.loading.library import names  # noqa: PLC0415  # not on the path of `--help`

    if every:
        if named:
            raise UsageError("`--all` and named procedures exclude each other; leave one out")
        return names("procedure", library)
    if not named:
        known = ", ".join(names("procedure", library))
        raise UsageError(f"which procedure? name one, or use --all; there are {known}")
    return list(dict.fromkeys(named))


@contextlib.contextmanager
def progress(total: int, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Show what is being done and how long it may still take, on standard error, where somebody watches."""
    if quiet or not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console  # noqa: PLC0415  # 60 ms that pipes need not pay
    from rich.progress import (  # noqa: PLC0415  # likewise
        BarColumn,
        MofNCompleteColumn,
        Progress,
        SpinnerColumn,
        TextColumn,
        TimeRemainingColumn,
    )

    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        task = shown.add_task("", total=total)
        begun = 0

        def step(what: str) -> None:
            nonlocal begun
            shown.update(task, completed=begun, description=what)
            begun += 1

        yield step


def folder(out: Path | None, name: str, *, several: bool) -> Path:
    """Return where one result goes: `--out`, a folder in it when there are several, or `runs/NAME`."""
    if out is None:
        return Path("runs") / name
    return out / name if several else out


def tell(what: str) -> None:
    """Say something on standard error, whoever watches."""
    typer.echo(what, err=True)


def tell_files(written: Sequence[Path]) -> None:
    """Name the files that were written."""
    for path in written:
        typer.echo(f"wrote {path}", err=True)


def render_and_tell(
    document: OutputDocument,
    words: str,
    out: Path | None,
    usual: str,
    formats: Sequence[str],
    *,
    force: bool,
    as_json: bool,
) -> None:
    """Write a document with its reports, print it, and say where to look.

    Parameters
    ----------
    document : OutputDocument
    words : str
        The document for a terminal.
    out : Path, optional
        `runs` and the usual name, or the next free one, otherwise.
    usual : str
    formats : sequence of str
    force, as_json : bool
        As the command has them.
    """
    from certkit.bench.render_documents import render  # noqa: PLC0415  # numpy waits until there is a document

    folder = out or Path("runs") / usual
    written = render(document, folder, formats, force=force, numbered=out is None, tell=tell)
    typer.echo(document.to_json() if as_json else words, nl=not as_json)
    typer.echo(f"look at {written[-1]}", err=True)


def show(results: Sequence[Result], *, as_json: bool, folder: Path, details: bool = False) -> None:
    """Print the verdict table, or the document alone; tell the CI service beside it.

    Of several results one table, and the criteria of each with `details`.
    """
    from certkit.documents.output_document import listed_json  # noqa: PLC0415  # not on the path of `--help`

    if not results:
        return
    if as_json:
        text = results[0].to_json() if len(results) == 1 else listed_json(results)
        typer.echo(text, nl=False)
        return
    from certkit.reporting import text_table as terminal  # noqa: PLC0415  # likewise
    from certkit.reporting.result_view import unique_views  # noqa: PLC0415  # likewise

    views = unique_views(results)
    terminal.show(views, details=details)
    page = next((page for page in (folder / "index.html", folder / "report.html") if page.exists()), folder)
    more = "" if details or len(results) == 1 else "; `--details` shows the criteria of each"
    typer.echo(f"look at {page}{more}", err=True)
    if os.environ.get("GITHUB_ACTIONS") == "true":
        from certkit.reporting.markdown import github_annotations  # noqa: PLC0415  # only there

        for line in github_annotations(views):
            tell = getattr(sys.stdout, "command", None) or typer.echo
            tell(line)


def exit_code(
    results: Sequence[Result], permitted: Sequence[Verdict], failures: Sequence[CertkitError] = ()
) -> int:
    """Tell of what failed, and return the contract's exit code: the worst, in the order 3, 2, 1, 4, 0."""
    from certkit.grading import exit_code as code  # noqa: PLC0415  # not on the path of `--help`

    for failure in failures:
        for line in str(failure).splitlines():
            typer.echo(f"error: {line}", err=True)
    codes = {failure.exit_code for failure in failures}
    if results:
        codes.add(code(results, permitted))
    return next(worst for worst in (3, 2, 1, 4, 0) if worst in codes)


def check_language(code: str) -> None:
    """Refuse a language that there is not before anything is computed."""
    from certkit.reporting.language import language  # noqa: PLC0415  # as all of reporting

    language(code)
