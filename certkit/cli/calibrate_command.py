"""`certkit calibrate`: fit the free numbers of a leg to its tests, and find its relatives."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations
from certkit.cli.study_command import Cluster, Processes  # noqa: TC001  # likewise

Document = Annotated[str, typer.Argument(metavar="FIT.yaml", help="The fit: a file, or a shipped name.")]
Family = Annotated[
    int | None,
    typer.Option("--family", min=2, metavar="N", help="Also write N legs that pass every graded criterion."),
]


def calibrate(
    document: Document,
    *,
    family: Family = None,
    out: options.Out = None,
    processes: Processes = None,
    cluster: Cluster = None,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Forget the runs that an earlier call has done.")
    ] = False,
    force: options.Force = False,
    library: options.Libraries = None,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
) -> None:
    """Fit parameters of a legform and of rigs to tests, within bounds.

    Writes the legform file with the fitted numbers, each naming the fit as its source, and a report:
    distance of every value before and after, uncertainty of every parameter, what the tests leave open. A
    fit that was interrupted goes on where it was and ends at the same numbers. Put the folder first with
    `--library` to run a procedure with the new leg.
    """
    from certkit.cli.counting import resumable  # noqa: PLC0415  # waits until a fit is run
    from certkit.reporting.study_text import calibration_text  # noqa: PLC0415  # likewise
    from certkit.studies.calibration.fit import make_ready  # noqa: PLC0415  # likewise
    from certkit.studies.calibration.run_calibration import carry_and_write  # noqa: PLC0415  # waits until a fit is run
    from certkit.studies.journal import forget  # noqa: PLC0415  # likewise

    task = make_ready(document, tuple(library or ()))
    folder = out or Path("runs") / f"fit-{task.sheet.fit}"
    if fresh:
        forget(folder / "runs.jsonl")
    watched = not (quiet or as_json)

    def tell(words: str) -> None:
        if watched:
            # One line that is written over on a terminal, a line each in a log.
            end, start = ("", "\r\033[K") if sys.stderr.isatty() else ("\n", "")
            sys.stderr.write(f"{start}{words}{end}")
            sys.stderr.flush()

    with resumable():
        written, report = carry_and_write(
            task, folder, family=family, processes=processes, cluster=cluster, tell=tell, force=force
        )
    if watched and sys.stderr.isatty():
        sys.stderr.write("\r\033[K")
    typer.echo(report.to_json() if as_json else calibration_text(report), nl=not as_json)
    if not as_json:
        for path in written:
            typer.echo(f"wrote {path}", err=True)
        procedure = task.sheet.targets[0].procedure
        typer.echo(f"try it: certkit run {procedure} --library {folder}", err=True)
