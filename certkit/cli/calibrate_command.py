"""`certkit calibrate`: fit the free numbers of a leg to its tests, and find its relatives."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations
from certkit.cli.many_runs import Cluster, Fresh, Processes, TlsCa, TlsCert, TlsKey, cluster_address

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
    tls_ca_file: TlsCa = None,
    tls_cert: TlsCert = None,
    tls_key: TlsKey = None,
    fresh: Fresh = False,
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
    from certkit.studies.calibration.calibrate_legform import calibrate as fit  # noqa: PLC0415  # likewise
    from certkit.studies.calibration.fit import fit_sheet  # noqa: PLC0415  # likewise

    sheet = fit_sheet(document, tuple(library or ()))
    folder = out or Path("runs") / f"fit-{sheet.fit}"
    watched = not (quiet or as_json)

    def tell(words: str) -> None:
        if watched:
            # One line that is written over on a terminal, a line each in a log.
            end, start = ("", "\r\033[K") if sys.stderr.isatty() else ("\n", "")
            sys.stderr.write(f"{start}{words}{end}")
            sys.stderr.flush()

    with resumable(fresh=fresh):
        found = fit(
            document,
            out=folder,
            family=family,
            fresh=fresh,
            library=library or (),
            processes=processes,
            cluster=cluster_address(cluster, tls_ca_file, tls_cert, tls_key),
            tell=tell,
            force=force,
        )
    if watched and sys.stderr.isatty():
        sys.stderr.write("\r\033[K")
    if found.report is not None:
        text = found.report.to_json() if as_json else calibration_text(found.report)
        typer.echo(text, nl=not as_json)
    if not as_json:
        for path in found.files:
            typer.echo(f"wrote {path}", err=True)
        procedure = sheet.targets[0].procedure
        typer.echo(f"try it: certkit run {procedure} --library {folder}", err=True)
