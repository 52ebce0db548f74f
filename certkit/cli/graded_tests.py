"""What `run` and `grade` have in common: one test after the other, each rendered, one failure at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct, field

from certkit.errors import CertkitError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from certkit.documents.result import Result
    from certkit.reporting.result_view import View


class GradedTests(Struct):
    """The tests of one command.

    Parameters
    ----------
    formats : sequence of str
    language : str
    sign : Path, optional
        Key to sign the PDFs with.
    force, verbose : bool
        As the command has them.
    numbered : bool
        Whether a folder that holds another result is left alone and the next free number taken.
    results, folders : list
        What was done so far, and where it lies.
    failures : list of CertkitError
        One that fails must not take the others with it.
    shown : dict
        What the reports show, by language: a suite of them does not draw it again.
    """

    formats: Sequence[str]
    language: str
    sign: Path | None
    force: bool
    verbose: bool
    numbered: bool
    results: list[Result] = field(default_factory=list)
    folders: list[Path] = field(default_factory=list)
    failures: list[CertkitError] = field(default_factory=list)
    shown: dict[str, list[View]] = field(default_factory=dict)

    def add(self, grade: Callable[[], Result], folder: Callable[[Result], Path]) -> None:
        """Grade a test and write its reports into the folder that its result goes to."""
        from certkit.bench.render_documents import render  # noqa: PLC0415  # numpy waits until a test is graded
        from certkit.cli import console as terminal  # noqa: PLC0415  # likewise

        try:
            result = grade()
            written = render(
                result,
                folder(result),
                self.formats,
                language=self.language,
                sign=self.sign,
                force=self.force,
                numbered=self.numbered,
                tell=terminal.tell,
                shown=self.shown,
            )
        except CertkitError as error:
            self.failures.append(error)
            return
        self.results.append(result)
        self.folders.append(written[0].parent)
        if self.verbose:
            terminal.tell_files(written)
