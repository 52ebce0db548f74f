"""`certkit grade`: a measured test or a finite-element run, by the procedure that simulated tests have."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options

Data = Annotated[
    list[Path],
    typer.Argument(
        metavar="DATA",
        help="ISO-MME folder, .zip or .mme file, CSV file, or a finite-element run. Several go one by one.",
    ),
]
Procedure = Annotated[
    str, typer.Option("--procedure", "-p", metavar="NAME|FILE", help="Procedure that the test followed.")
]
Laboratory = Annotated[
    Path | None,
    typer.Option(
        "--lab",
        metavar="LAB.yaml",
        help="Laboratory, item, sensors, decision rule, uncertainties, conditions.",
    ),
]
MappingFile = Annotated[
    Path | None,
    typer.Option("--mapping", metavar="MAP.yaml", help="Own columns, channel codes, signs and conditions."),
]
Lenient = Annotated[
    bool, typer.Option("--lenient", help="List assumptions in the report instead of refusing damaged data.")
]
GradeOut = Annotated[
    Path | None, typer.Option("--out", help="Folder for the results.", show_default="runs/NAME of the data")
]


def grade(
    data: Data,
    *,
    procedure: Procedure,
    lab: Laboratory = None,
    mapping: MappingFile = None,
    lenient: Lenient = False,
    out: GradeOut = None,
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
    """Grade a measured test or a finite-element run and write its report.

    `certkit grade --procedure pendulum DATA --lab lab.yaml` checks the preconditions first, then conditions,
    filters and measures the channels as it does for a simulated test. The exit code is the verdict's. A
    finite-element run needs a mapping that says which of its histories are channels.
    Several recordings of one name are told apart by the folders they lie in. A folder that holds another
    result is refused, unless `--force` is given; without `--out` the next free `runs/NAME-2` is taken.
    """
    from certkit.bench.grade_measurement import grade as grade_test  # noqa: PLC0415  # numpy waits
    from certkit.bench.render_documents import check_key  # noqa: PLC0415  # likewise
    from certkit.bench.result_folder import distinct_names  # noqa: PLC0415  # likewise
    from certkit.cli import console as terminal  # noqa: PLC0415  # likewise
    from certkit.cli.graded_tests import GradedTests  # noqa: PLC0415  # likewise
    from certkit.definitions.loading.overrides import overrides_from  # noqa: PLC0415  # likewise

    wanted = terminal.formats(formats)
    terminal.check_language(language)
    check_key(sign)
    permitted = terminal.allowed(allow)
    several = len(data) > 1
    folder = out or Path("runs")
    names = distinct_names([(path.stem, path.absolute().parent.name) for path in data])
    tests = GradedTests(wanted, language, sign, force=force, verbose=verbose, numbered=out is None)
    with terminal.progress(len(data), quiet=quiet or as_json) as step:
        for path, name in zip(data, names, strict=True):
            step(path.name)
            place = folder / name if several or out is None else folder
            graded = partial(
                grade_test,
                procedure,
                path,
                laboratory=lab,
                mapping=mapping,
                lenient=lenient,
                library=tuple(library or ()),
                overrides=overrides_from(overrides or ()),
            )
            tests.add(graded, lambda _, place=place: place)  # type: ignore[misc]  # this round's place
    shown = folder if several or out or not tests.folders else tests.folders[0]
    terminal.show(tests.results, as_json=as_json, folder=shown, details=details or verbose)
    raise typer.Exit(terminal.exit_code(tests.results, permitted, tests.failures))
