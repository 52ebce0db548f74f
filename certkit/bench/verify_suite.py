"""Checks of a suite's folder: which runs it holds, and whether what binds them is made of these results."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit._version import __version__
from certkit.bench.verification import Check, Verification, fails, judged, left_out, unchecked
from certkit.bench.verify_beside import unknown_files
from certkit.bench.verify_document import of_another_certkit
from certkit.documents.document_kinds import document_in
from certkit.documents.result import Result
from certkit.files.bounded import read_bounded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path


def suite_runs(folder: Path) -> list[Path]:
    """Return the folders of the runs in a folder, by name; none where it is the folder of a document."""
    if not folder.is_dir() or document_in(folder) is not None:
        return []
    inside = (each for each in folder.iterdir() if not each.name.startswith("."))
    return sorted(each for each in inside if (each / Result.file_name).is_file())


def suite_verification(
    folder: Path, runs: Sequence[Path], check_pdf: Callable[[Path], Verification]
) -> list[Verification]:
    """Check what binds the results of a suite; nothing where there is nothing of the kind.

    Parameters
    ----------
    folder : Path
        The suite's.
    runs : sequence of Path
        Folders of its results, which are checked by themselves.
    check_pdf : callable
        Checks a PDF, without what its results say.
    """
    from certkit.reporting.report_formats import FORMATS, report_format  # noqa: PLC0415  # only for a suite

    results = {run.name: Result.read(run / Result.file_name) for run in runs}
    checks: list[Check] = []
    for name in FORMATS:
        made = report_format(name)
        if made.SUITE_FILE is None or not (folder / made.SUITE_FILE).is_file():
            continue
        if name == "pdf":
            checks += _pdf_checks(check_pdf(folder / made.SUITE_FILE), made.SUITE_FILE, results)
        elif made.REPEATABLE:
            checks += _page_checks(folder, name, made.SUITE_FILE, results)
        else:
            checks.append(left_out(made.SUITE_FILE, "not-compared"))
    if not checks:
        return []
    known = {*results, *(report_format(name).SUITE_FILE for name in FORMATS)}
    checks += unknown_files(folder, known)
    return [Verification(str(folder), tuple(result.id for result in results.values()), tuple(checks))]


def in_one(name: str, found: Sequence[Verification]) -> Verification:
    """Return the verifications of a suite's folder as one of all; each check names its run."""
    if len(found) == 1:
        return found[0]
    checks = [
        check if each.certificate == name else replace(check, what=f"{_last(each.certificate)}: {check.what}")
        for each in found
        for check in each.checks
    ]
    graded = [each for each in found if each.certificate != name]
    ids = tuple(one for each in graded for one in each.ids)
    return Verification(name, ids, tuple(checks), tuple(one for each in graded for one in each.verdicts))


def _last(certificate: str) -> str:
    return certificate.replace("\\", "/").rpartition("/")[2]


def _page_checks(folder: Path, form: str, file: str, results: dict[str, Result]) -> Iterator[Check]:
    """Render a page again from the results whose ids it says, in their order."""
    from certkit.reporting.writing import suite_again  # noqa: PLC0415  # only for a suite

    content = read_bounded(folder / file)
    places = {name: content.find(result.id.encode()) for name, result in results.items()}
    bound = [results[name] for name in sorted(places, key=places.__getitem__) if places[name] >= 0]
    if not bound:
        yield fails(file, "rendering-differs")
        return
    other = next((each.provenance.certkit for each in bound if of_another_certkit(each)), None)
    if other is not None:
        yield unchecked(file, "made-by-another-version", version=other, now=__version__)
    else:
        yield judged(file, suite_again(bound, form, content, folder) == content, "rendering-differs")
    yield from _not_bound(file, [name for name, place in places.items() if place < 0])


def _pdf_checks(inside: Verification, file: str, results: dict[str, Result]) -> Iterator[Check]:
    """Check a suite's PDF as such, and that it binds results of this folder."""
    yield from (replace(each, what=f"{file}: {each.what}") for each in inside.checks)
    here = {result.id for result in results.values()}
    yield judged(
        f"{file}: certificate", set(inside.ids) <= here, "other-certificate", ids=", ".join(inside.ids)
    )
    yield from _not_bound(file, [name for name, result in results.items() if result.id not in inside.ids])


def _not_bound(file: str, names: Sequence[str]) -> Iterator[Check]:
    if names:
        yield left_out("other results", "results-not-bound", file=file, names=", ".join(names))
