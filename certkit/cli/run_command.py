"""`certkit run`: simulate, grade, render."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import completion, options
from certkit.errors import CertkitError

if TYPE_CHECKING:
    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.overrides import Overrides
    from certkit.documents.result import Result

Named = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="[NAME|FILE]…",
        help="Procedures to run, as in `certkit list procedure`, or YAML files.",
        show_default=False,
        autocompletion=completion.procedures,
    ),
]
Procedures = Annotated[
    list[str] | None,
    typer.Option(
        "--procedure",
        "-p",
        metavar="NAME|FILE",
        help="The same as an option. Repeatable.",
        autocompletion=completion.procedures,
    ),
]


def run(
    named: Named = None,
    *,
    procedure: Procedures = None,
    every: Annotated[bool, typer.Option("--all", help="Run every procedure there is.")] = False,
    family: Annotated[
        bool, typer.Option("--family", help="Also run every leg of the certified family: value with spread.")
    ] = False,
    out: options.Out = None,
    formats: options.Formats = options.DEFAULT_FORMATS,
    language: options.Language = "en",
    sign: options.Sign = None,
    force: options.Force = False,
    overrides: options.Overrides = None,
    library: options.Libraries = None,
    allow: options.Allow = None,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
    verbose: options.Verbose = False,
    details: options.Details = False,
) -> None:
    """Simulate a test, grade it and write its certificate.

    `certkit run pendulum` writes `runs/pendulum/` with the report as HTML and PDF, a JUnit file,
    the channels as CSV and the result document. The exit code is the verdict's. Where that folder holds
    another result, this one goes to `runs/pendulum-2`; with `--out` it is refused, unless `--force` is given.
    """
    from certkit.bench.render_documents import check_key, render_suite  # noqa: PLC0415  # numpy waits until a test is run
    from certkit.bench.result_folder import distinct_names  # noqa: PLC0415  # likewise
    from certkit.bench.run_simulation import run as simulate  # noqa: PLC0415  # likewise
    from certkit.cli import console as terminal  # noqa: PLC0415  # likewise
    from certkit.cli.graded_tests import GradedTests  # noqa: PLC0415  # likewise
    from certkit.definitions.loading.overrides import overrides_from  # noqa: PLC0415  # likewise

    wanted = terminal.formats(formats)
    terminal.check_language(language)
    check_key(sign)
    permitted = terminal.allowed(allow)
    names = terminal.procedures([*(named or ()), *(procedure or ())], every=every, library=library or ())
    changes = overrides_from(overrides or ())
    call = _family if family else simulate
    used: list[tuple[str, str]] = []

    def place(result: Result) -> Path:
        used.append((result.procedure, ""))
        return terminal.folder(out, distinct_names(used)[-1], several=len(names) > 1)

    tests = GradedTests(wanted, language, sign, force=force, verbose=verbose, numbered=out is None)
    with terminal.progress(len(names), quiet=quiet or as_json) as step:
        for name in names:
            step(name)
            tests.add(partial(call, name, library=tuple(library or ()), overrides=changes), place)
        if len(tests.results) > 1:
            try:
                render_suite(
                    tests.results,
                    out or Path("runs"),
                    wanted,
                    language=language,
                    sign=sign,
                    force=force or out is None,
                    folders=tests.folders,
                    shown=tests.shown,
                )
            except CertkitError as error:
                tests.failures.append(error)
    shown = tests.folders[0] if len(names) == 1 and tests.results else out or Path("runs")
    terminal.show(tests.results, as_json=as_json, folder=shown, details=details or verbose)
    raise typer.Exit(terminal.exit_code(tests.results, permitted, tests.failures))


def _family(name: str, *, library: Library, overrides: Overrides) -> Result:
    from certkit.bench.run_family import run_family  # noqa: PLC0415  # only where a spread is wanted

    return run_family(name, library=library, overrides=overrides)
