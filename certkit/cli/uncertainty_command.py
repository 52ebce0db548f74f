"""`certkit uncertainty`: the uncertainty of a test, from tolerances of its rig and its sensors."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations
from certkit.cli.many_runs import Cluster, Fresh, Processes, TlsCa, TlsCert, TlsKey, cluster_address

Document = Annotated[
    str, typer.Argument(metavar="BUDGET.yaml", help="The budget: a file, or a shipped name.")
]


def uncertainty(
    document: Document,
    *,
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
    """Propagate tolerances of rig and sensors into U of every criterion, and say what it comes from.

    By the GUM and by Monte Carlo, one against the other. Writes the budget, its page, and the lines
    `uncertainties:` for a laboratory file. Exit code 1 when a criterion's U is more than its corridor allows
    with the wanted risk.
    """
    from certkit.cli.counting import counting, resumable  # noqa: PLC0415  # waits until a budget is run
    from certkit.reporting.uncertainty_page import uncertainty_text  # noqa: PLC0415  # likewise
    from certkit.studies.execution import Execution  # noqa: PLC0415  # likewise
    from certkit.studies.propagate_uncertainty import SNIPPET, budget_sheet  # noqa: PLC0415  # likewise
    from certkit.studies.propagate_uncertainty import uncertainty as propagate  # noqa: PLC0415  # likewise

    sheet = budget_sheet(document, tuple(library or ()))
    folder = out or Path("runs") / sheet.budget
    address = cluster_address(cluster, tls_ca_file, tls_cert, tls_key)
    with resumable(fresh=fresh), counting(sheet.budget, quiet=quiet or as_json) as progress:
        report = propagate(
            sheet,
            out=folder,
            library=library or (),
            execution=Execution(processes, address, progress),
            fresh=fresh,
            force=force,
        )
    typer.echo(report.to_json() if as_json else uncertainty_text(report), nl=not as_json)
    typer.echo(
        f"look at {folder / 'uncertainty.html'}; lines for a laboratory file are in {folder / SNIPPET}",
        err=True,
    )
    raise typer.Exit(1 if any(each.tighten for each in report.criteria) else 0)
