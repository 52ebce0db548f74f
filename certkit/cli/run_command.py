"""`certkit run`: simulate, grade, render."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options
from certkit.errors import CertkitError

if TYPE_CHECKING:
    from certkit.documents.result import Result

Procedures = Annotated[
    list[str] | None,
    typer.Option("--procedure", "-p", metavar="NAME|FILE", help="Procedure to run. Repeatable."),
]


def run(
    procedure: Procedures = None,
    *,
    every: Annotated[bool, typer.Option("--all", help="Run every procedure there is.")] = False,
    family: Annotated[
        bool, typer.Option("--family", help="Also run every leg of the certified family: value with spread.")
    ] = False,
    out: options.Out = None,
    formats: options.Formats = options.DEFAULT_FORMATS,
    overrides: options.Overrides = None,
    library: options.Libraries = None,
    allow: options.Allow = None,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
) -> None:
    """Simulate a test, grade it and write its certificate.

    `certkit run --procedure pendulum` writes `runs/pendulum/` with the report as HTML and PDF, a JUnit file,
    the channels as CSV and the result document. The exit code is the verdict's.
    """
    from certkit import bench  # noqa: PLC0415  # numpy and pydantic wait until a test is run
    from certkit.cli import console as terminal  # noqa: PLC0415  # likewise

    wanted = terminal.formats(formats)
    permitted = terminal.allowed(allow)
    names = terminal.procedures(procedure, every=every, library=library or ())
    results: list[Result] = []
    failures: list[CertkitError] = []
    with terminal.progress(len(names), quiet=quiet or as_json) as step:
        for name in names:
            step(name)
            try:
                call = bench.run_family if family else bench.run
                result = call(name, library=tuple(library or ()), overrides=tuple(overrides or ()))
                target = terminal.folder(out, result.procedure, several=len(names) > 1)
                written = bench.save(result, target, wanted)
            except CertkitError as error:
                # One procedure that cannot be run must not take the others with it.
                failures.append(error)
                continue
            results.append(result)
            if verbose:
                terminal.tell_files(written)
        if len(results) > 1:
            bench.save_suite(results, out or Path("runs"), wanted)
    place = out or Path("runs")
    if len(names) == 1 and results:
        place = terminal.folder(out, results[0].procedure, several=False)
    terminal.show(results, as_json=as_json, folder=place)
    raise typer.Exit(terminal.exit_code(results, permitted, failures))
