"""A result as all of its reports show it: worded once for every format, drawn when a format asks for it."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.documents.result import CALIBRATION
from certkit.reporting import number_format as words
from certkit.reporting.channel_order import ordered_channels
from certkit.reporting.criterion_row import Row, criterion_row, figure_of, slug
from certkit.reporting.laboratory_view import LaboratoryView, laboratory_view
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.margins import margin_words, nearest_words, tally, worst
from certkit.reporting.result_figures import ResultFigures, drawable
from certkit.reporting.score_words import score_words
from certkit.reporting.translated_titles import with_titles

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.bibliography import Work
    from certkit.documents.result import PreconditionResult, Result

KINDS = {
    "virtual certification": ("Model validation report", "simulated test"),
    "virtual test": ("Virtual test report", "simulated test of others"),
    "test evaluation": ("Test report", "measured test"),
}
"""What the report of each kind of result is called, and what it is of."""


class NumberGroup(Struct, frozen=True):
    """Numbers that went in from one file: (name, value, confidence, number of the source)."""

    title: str
    rows: list[tuple[str, str, str, int]]


class View(ResultFigures, frozen=True, dict=True):
    """A result, ready for every format; `ResultFigures` has its figures, and what they are drawn of.

    Parameters
    ----------
    document : Result
        As it was written.
    pdf : bytes, optional
        Its certificate, where that was set before.
    """

    document: Result
    heading: str
    subject: str
    meaning: str
    tally: str
    nearest: str
    nearest_words: str
    points: str
    rows: list[Row]
    sources: list[str]
    laboratory: LaboratoryView | None
    specimen: list[tuple[str, str]]
    numbers: list[NumberGroup]
    number_sources: list[str]
    pdf: bytes | None = None

    @cached_property
    def works(self) -> dict[str, Work]:
        """The works that sources name, by their short names, each with its full entry."""
        from certkit.reporting.works_cited import works_cited  # noqa: PLC0415  # only where it is printed

        return works_cited(self.result)

    @cached_property
    def own_work(self) -> str:
        """What numbers without a work rest on."""
        from certkit.reporting.works_cited import own_work  # noqa: PLC0415  # likewise

        return own_work(self.result)

    @property
    def conditions(self) -> list[PreconditionResult]:
        """The preconditions that are no calibrations; those stand in the table of equipment."""
        tabled = self.laboratory is not None and self.laboratory.tables
        return [
            row for row in self.result.preconditions if not (tabled and row.quantity.startswith(CALIBRATION))
        ]

    @property
    def specimen_words(self) -> str:
        """The legform that was on the rig, with its serial number where it has one."""
        specimen = self.result.specimen
        return " ".join(word for word in (specimen.get("legform"), specimen.get("serial")) if word) or "–"

    @property
    def reference(self) -> str:
        """What the report is referred to by: its number and revision, else its id."""
        lab, t = self.laboratory, self.spoken.word
        if lab is None or not lab.number:
            return self.result.id or t("without id")
        return f"{lab.number}, {t('revision')} {lab.revision}"

    @property
    def recordings(self) -> list[tuple[str, int]]:
        """The recorded files by the container or folder that they came in, with how many there are."""
        counts: dict[str, int] = {}
        for item in self.result.provenance.inputs:
            if item.role == "recording":
                counts[item.path.partition("/")[0]] = counts.get(item.path.partition("/")[0], 0) + 1
        return list(counts.items())

    @property
    def sign(self) -> str:
        """A sign for the verdict."""
        return words.SIGNS[self.result.verdict]

    @property
    def error(self) -> str:
        """The rms error against the reference in %, as the field writes it; empty without a comparison."""
        comparison = self.result.comparison
        return words.fixed(comparison.rms_error_percent, 1) if comparison else ""

    @property
    def confidences(self) -> list[tuple[str, int]]:
        """Return how many numbers that went in have each confidence."""
        counts = dict.fromkeys(words.CONFIDENCE, 0)
        for parameter in self.result.parameters:
            counts[parameter.confidence] += 1
        return [(word, count) for word, count in counts.items() if count]


def view(result: Result, *, suffix: str = "", spoken: str = ENGLISH) -> View:
    """Word a result in a language; `suffix` tells two results of one procedure apart."""
    chosen = language(spoken)
    t = chosen.word
    document = result
    if spoken != ENGLISH:
        result = with_titles(worded(result, spoken), chosen)
    key = slug(result.procedure) + suffix
    drawn = {figure_of(c) for c in result.criteria if c.curve}
    drawn |= set(ordered_channels(result)) if drawable(result) else set()
    sources = list(dict.fromkeys(c.source for c in result.criteria if c.source))
    number_sources = list(dict.fromkeys(p.source for p in result.parameters))
    nearest = worst(result)
    heading, subject = KINDS[result.kind]
    return View(
        document=document,
        result=result,
        spoken=chosen,
        key=key,
        heading=t(heading),
        subject=t(subject),
        meaning=t(words.meaning(result.verdict)) if result.verdict in {"not evaluated", "error"} else "",
        tally=tally(result, chosen),
        nearest_criterion=nearest,
        nearest=margin_words(nearest, chosen),
        nearest_words=nearest_words(nearest, chosen),
        points=score_words(result, chosen),
        rows=[criterion_row(criterion, key, drawn, sources, t) for criterion in result.criteria],
        sources=sources,
        laboratory=laboratory_view(result.laboratory, t),
        specimen=[(t(name), value) for name, value in result.specimen.items()],
        numbers=_numbers(result, number_sources),
        number_sources=number_sources,
    )


def unique_views(results: Sequence[Result], spoken: str = ENGLISH) -> list[View]:
    """Return views whose keys differ, also when a procedure was run twice."""
    counts: dict[str, int] = {}
    views = []
    for result in results:
        counts[result.procedure] = counts.get(result.procedure, 0) + 1
        number = counts[result.procedure]
        views.append(view(result, suffix=f"-{number}" if number > 1 else "", spoken=spoken))
    return views


def _numbers(result: Result, sources: list[str]) -> list[NumberGroup]:
    """Group the numbers that went in by the file before the colon of their path."""
    groups: dict[str, list[tuple[str, str, str, int]]] = {}
    for number in result.parameters:
        file, colon, name = number.path.partition(": ")
        row = (
            name if colon else number.path,
            number.value,
            number.confidence,
            sources.index(number.source) + 1,
        )
        groups.setdefault(file if colon else "", []).append(row)
    return [NumberGroup(title, rows) for title, rows in groups.items()]
