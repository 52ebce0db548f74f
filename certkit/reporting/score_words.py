"""Points of rating schemes in one line, for terminal, Markdown and the first page of a report."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.number_format import plain, shown

if TYPE_CHECKING:
    from certkit.documents.result import Result, ScoreResult
    from certkit.reporting.language import Language


def score_words(result: Result, language: Language) -> str:
    """Return `Points (euro-ncap-2014): tibia 0.31 of 0.5 (T1 304.0 N·m); knee 0 of 0.5 (MCL 22.41 mm)`.

    Empty where there are no scores. Behind the points stands the band's colour, where a scheme has bands, and
    the criterion that decided.
    """
    if not result.scores:
        return ""
    schemes = list(dict.fromkeys(score.scheme for score in result.scores if score.scheme))
    named = f" ({', '.join(schemes)})" if schemes else ""
    points = language.word("Points")
    return f"{points}{named}: {'; '.join(_one(score, language) for score in result.scores)}"


def _one(score: ScoreResult, language: Language) -> str:
    of = language.word("of")
    decided = f"{score.criterion} {shown(score.value, score.unit)} {score.unit}"
    colour = f"{language.word(score.colour)}, " if score.colour else ""
    return f"{score.id} {plain(score.points, 3)} {of} {plain(score.maximum, 3)} ({colour}{decided})"
