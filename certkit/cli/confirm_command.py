"""`certkit confirm`: walk the numbers that decide, and sign them against one's own copy of the text."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations

if TYPE_CHECKING:
    from certkit.bench.confirm import ConfirmationSession

HEADS = ("path", "value", "source", "answer", "place")
READ = "y, n, the text's own value, s(kip), q(uit)"
SIGN = "sign it? y, s(kip), q(uit)"


def confirm(
    definition: Annotated[
        str,
        typer.Argument(metavar="NAME|FILE", help="A definition, or its file."),
    ],
    *,
    by: Annotated[str, typer.Option("--by", metavar="PERSON", help="Who reads.")],
    title: Annotated[
        str | None,
        typer.Option("--title", metavar="TEXT", help="Text and edition, when it is begun."),
    ] = None,
    document: Annotated[
        Path | None, typer.Option("--document", metavar="FILE", help="The text's file; its SHA-256 is kept.")
    ] = None,
    library: Annotated[
        Path, typer.Option("--library", metavar="DIR", help="Folder of your own definitions.")
    ] = Path("library"),
    kind: Annotated[
        str | None, typer.Option("--kind", metavar="KIND", help="Where several kinds have that name.")
    ] = None,
    countersign: Annotated[
        bool, typer.Option("--countersign", help="Sign as the second person what another has read.")
    ] = False,
    write_table: Annotated[
        Path | None,
        typer.Option("--write-table", metavar="FILE.csv", help="Write the open numbers out."),
    ] = None,
    table: Annotated[
        Path | None,
        typer.Option("--table", metavar="FILE.csv", help="Take a filled-in table."),
    ] = None,
    force: options.Force = False,
) -> None:
    """Hold the numbers of a definition against the text itself, one by one.

    Each number is shown with where it is said to stand. Answer `y` when the text says so, `n` when not, or
    type the value that it gives; then page or clause. Every answer is kept at once: stop and go on at any
    time. Name the library with `--library` afterwards, and certificates carry the text and the person.
    """
    from certkit.bench.confirm import open_confirmation  # noqa: PLC0415  # not on the path of `--help`

    session = open_confirmation(definition, by=by, library=library, kind=kind, title=title, document=document)
    if write_table is not None:
        _write(session, write_table, countersigning=countersign, force=force)
        return
    if table is not None:
        _take(session, table, countersigning=countersign)
    else:
        _ask(session, countersigning=countersign)
    _tell(session)


def _ask(session: ConfirmationSession, *, countersigning: bool) -> None:
    """Ask for each number that waits, until the end or `q`."""
    from certkit.errors import UsageError  # noqa: PLC0415  # as above

    waiting = session.waiting(countersigning=countersigning)
    place = ""
    for number, entry in enumerate(waiting, 1):
        typer.echo(f"\n[{number}/{len(waiting)}] {entry.path}: {entry.value}\n    {entry.source}")
        while True:
            asked = SIGN if countersigning else READ
            word = typer.prompt(f"    {asked}", prompt_suffix=" > ").strip()
            if word == "q":
                return
            if word == "s":
                break
            try:
                if countersigning and word == "y":
                    session.countersign(entry.path)
                elif not countersigning:
                    answer = {"y": "yes", "n": "no"}.get(word, word)
                    place = typer.prompt("    page or clause", default=place, prompt_suffix=" > ").strip()
                    session.answer(entry.path, answer, place)
                else:
                    continue
            except UsageError as error:
                typer.echo(f"    {error}", err=True)
                continue
            break


def _write(session: ConfirmationSession, path: Path, *, countersigning: bool, force: bool) -> None:
    import csv  # noqa: PLC0415  # beside its only use
    import io  # noqa: PLC0415  # likewise

    from certkit.bench.result_folder import write_alone  # noqa: PLC0415  # likewise
    from certkit.exchange.csv_cells import harmless  # noqa: PLC0415  # likewise

    held = io.StringIO()
    writer = csv.writer(held, lineterminator="\r\n")
    writer.writerow(HEADS)
    for entry in session.waiting(countersigning=countersigning):
        writer.writerow([harmless(cell) for cell in (entry.path, entry.value, entry.source, "", "")])
    write_alone(path, "\ufeff" + held.getvalue(), force=force)
    typer.echo(f"wrote {path}: fill in `answer` (yes, no, or the text's value) and `place`,", err=True)
    typer.echo(f"then: --table {path}", err=True)


def _take(session: ConfirmationSession, path: Path, *, countersigning: bool) -> None:
    import csv  # noqa: PLC0415  # beside its only use

    from certkit.bench.confirm import take_table  # noqa: PLC0415  # not on the path of `--help`
    from certkit.definitions.loading.validation import read_bytes  # noqa: PLC0415  # likewise
    from certkit.errors import UsageError  # noqa: PLC0415  # likewise
    from certkit.exchange.text import decode  # noqa: PLC0415  # likewise

    text = decode(read_bytes(path), str(path))[0].removeprefix("\ufeff")
    head = text.partition("\n")[0]
    delimiter = ";" if head.count(";") > head.count(",") else ","
    rows = list(csv.DictReader(text.splitlines(), delimiter=delimiter))
    if not rows or any(row.get(name) is None for row in rows for name in HEADS):
        raise UsageError(f"{path}: has not the columns {', '.join(HEADS)}; write one with --write-table")
    plain = [{name: row[name].removeprefix("'") for name in HEADS} for row in rows]
    try:
        taken = take_table(session, plain, countersigning=countersigning)
    except UsageError as error:
        raise UsageError(f"{path}: {error}") from error
    typer.echo(f"{taken} answers taken from {path}", err=True)


def _tell(session: ConfirmationSession) -> None:
    from certkit.bench.confirm import answered  # noqa: PLC0415  # not on the path of `--help`

    yes, total = answered(session)
    typer.echo(f"{yes} of {total} numbers of {session.loaded.path} are confirmed by {session.text.title}")
    if session.path.exists():
        typer.echo(f"kept in {session.path}; use it: certkit run … --library {session.library}", err=True)
