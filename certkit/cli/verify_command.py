"""`certkit verify`: say whether a certificate still holds, what was checked, and what was not."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations
from certkit.reporting.language_list import languages

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.bench.verification import Verification
    from certkit.reporting.language import Language

Certificate = Annotated[
    list[Path],
    typer.Argument(
        metavar="CERTIFICATE [DATA]...",
        help=(
            "A document (result.json, …), report.pdf, or the folder of a run or a suite; repeatable. "
            "Recordings among them (ISO-MME, CSV) are compared with hashes and channels of the certificates."
        ),
    ),
]
Trust = Annotated[
    Path | None,
    typer.Option(
        "--trust",
        metavar="ROOTS.pem",
        help="Certificates that have to vouch for the signer of a PDF; without a signature it does not hold.",
    ),
]
Quick = Annotated[bool, typer.Option("--quick", help="Do not simulate simulated certificates again.")]

EXIT = {"holds": 0, "does not hold": 1, "not checked": 4}
SIGNS = {"holds": "✓", "does not hold": "✗", "not checked": "–"}


def verify(
    certificate: Certificate,
    *,
    trust: Trust = None,
    quick: Quick = False,
    language: Annotated[
        str,
        typer.Option(
            "--language", metavar="CODE", help=f"Language of what is said: {', '.join(languages())}."
        ),
    ] = "en",
    as_json: options.AsJson = False,
    verbose: options.Verbose = False,
) -> None:
    """Check a certificate: every hash, every page, the grading, the simulation, the sources, the signature.

    Exit code 0 when it holds, 1 when it does not, 2 when it cannot be read, 4 when nothing speaks against it
    but something could not be checked. What nobody asked for (recordings that were not named, `--quick`) is
    told as well, and does not count. A report that another of the named certificates replaced does not hold.
    In the folder of a suite (what `certkit run --all` wrote) each result is checked, and the pages that bind
    them: one line each, after what speaks against it; `--verbose` tells the rest.
    """
    import json  # noqa: PLC0415  # waits until a certificate is verified

    from certkit.bench.verify import is_certificate, verify_each  # noqa: PLC0415  # likewise
    from certkit.errors import UsageError  # noqa: PLC0415  # likewise
    from certkit.reporting.language import language as language_of  # noqa: PLC0415  # likewise

    spoken = language_of(language)

    certificates = [path for path in certificate if is_certificate(path)] or certificate[:1]
    data = [path for path in certificate if path not in certificates]
    if not all(path.exists() for path in certificate):
        missing = next(path for path in certificate if not path.exists())
        raise UsageError(f"{missing}: there is no such file or folder; check the name")
    given = [verify_each(path, data, trust=trust, quick=quick, others=certificates) for path in certificates]
    found = [each for of_one in given for each in of_one]
    if as_json:
        typer.echo(json.dumps([_plain(each, language) for each in found], ensure_ascii=False, indent=1))
    else:
        for of_one in given:
            brief = len(of_one) > 1 and not verbose
            for each in of_one:
                _tell(each, spoken, verbose=verbose, brief=brief)
            if brief:
                typer.echo(_left(of_one, spoken))
        typer.echo(spoken.verified("limits", {}))
    codes = {EXIT[each.outcome] for each in found}
    raise typer.Exit(next(code for code in (1, 4, 0) if code in codes))


def _tell(found: Verification, spoken: Language, *, verbose: bool, brief: bool) -> None:
    """Say what does not hold and what was not checked; then the verdict, and what was checked.

    In brief the names of what was checked are left out, and of a result what nobody asked for.
    """
    hidden = brief and bool(found.verdicts)
    for check in found.checks:
        if verbose or not (check.holds or (hidden and not check.asked)):
            said = f": {why}" if (why := check.said_in(spoken.code)) else ""
            typer.echo(f"{SIGNS[check.outcome]} {_named(check.what, spoken)}{said}")
    held = [check for check in found.checks if check.holds]
    groups = list(dict.fromkeys(_named(check.what.partition(":")[0], spoken) for check in held))
    t, verdict = spoken.word, ", ".join(map(spoken.verdict, found.verdicts))
    verdicts = t(", verdict {verdict}", verdict=verdict) if found.verdicts else ""
    outcome = t("holds: {count} checks", count=len(held)) if found.holds else t(found.outcome)
    if found.outcome == "not checked":
        outcome = t("cannot be said to hold: not everything could be checked")
    if not brief:
        typer.echo(t("checked: {names}", names=", ".join(groups) or t("nothing")))
        typer.echo(_left([found], spoken))
    typer.echo(f"{found.certificate} ({', '.join(found.ids)}{verdicts}) {outcome}")


def _left(found: Sequence[Verification], spoken: Language) -> str:
    """Name what was not checked."""
    left = dict.fromkeys(_named(check.what, spoken) for each in found for check in each.of("not checked"))
    t = spoken.word
    return t("not checked: {names}", names=", ".join(left) or t("nothing was left out"))


def _named(what: str, spoken: Language) -> str:
    """Return what was looked at in a language; names of files and criteria stay."""
    return ": ".join(map(spoken.word, what.split(": ")))


def _plain(found: Verification, spoken: str) -> dict[str, object]:
    checks = [
        {
            "what": each.what,
            "outcome": each.outcome,
            "code": each.code,
            "said": each.said_in(spoken),
            "asked": each.asked,
        }
        for each in found.checks
    ]
    return {
        "certificate": found.certificate,
        "ids": found.ids,
        "verdicts": found.verdicts,
        "outcome": found.outcome,
        "holds": found.holds,
        "checks": checks,
    }
