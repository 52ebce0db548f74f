"""What commands that make many runs have in common: where the runs are done, and starting anew."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from certkit.studies.dask_cluster import ClusterAddress

Processes = Annotated[
    int | None,
    typer.Option("--processes", min=1, help="Processes on this machine.", show_default="all cores"),
]
Cluster = Annotated[
    str | None,
    typer.Option("--cluster", metavar="ADDRESS", help="Run on the Dask cluster with this scheduler instead."),
]
TlsCa = Annotated[
    Path | None,
    typer.Option("--tls-ca-file", metavar="CA.pem", help="Authority that cluster and we trust (tls://)."),
]
TlsCert = Annotated[
    Path | None, typer.Option("--tls-cert", metavar="CERT.pem", help="Our certificate for the cluster.")
]
TlsKey = Annotated[Path | None, typer.Option("--tls-key", metavar="KEY.pem", help="Its key.")]
Fresh = Annotated[bool, typer.Option("--fresh", help="Forget the runs that an earlier call has done.")]


def cluster_address(
    scheduler: str | None, ca_file: Path | None, cert: Path | None, key: Path | None
) -> ClusterAddress | None:
    """Return where the cluster is, and how we prove who we are.

    Raises
    ------
    UsageError
        When the options do not fit together.
    """
    from certkit.errors import UsageError  # noqa: PLC0415  # waits until a study is run
    from certkit.studies.dask_cluster import ClusterAddress  # noqa: PLC0415  # likewise

    if scheduler is None:
        if ca_file or cert or key:
            raise UsageError("TLS is for a cluster; name its scheduler with --cluster tls://HOST:PORT")
        return None
    address = ClusterAddress(scheduler, ca_file, cert, key)
    address.check()
    return address
