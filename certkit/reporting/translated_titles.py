"""Titles of definitions and of the solver in the language of a report; unknown ones stay as they are."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Histories, Result
    from certkit.documents.rig_motion import Motion
    from certkit.reporting.language import Language

_NOTES = ("{angle}° above horizontal", "up to {force} kN", "{mass} kg at {speed} m/s")
"""What a fixture says beside its name, with its numbers."""

_NUMBERED = re.compile(r"(.*\D) (\d+)")
_LIGAMENT = re.compile(r"([A-Z]{2,4}) (.+)")
_TARGETS = re.compile(r"Own targets, (.+) of the limits: (.+)")
_ENERGY = re.compile(r"(.+) (stored|dissipated)")


def title_in(text: str, spoken: Language) -> str:
    """Return a title in a language: `Tibia moment 1`, `MCL elongation`, `joint spring stored`.

    A title is looked up as a whole, then without its number, its ligament, or what became of an energy.
    """
    words = spoken.words
    for known in (text, text[:1].lower() + text[1:]):
        if known in words:
            return words[known]
    if found := _NUMBERED.fullmatch(text):
        return f"{title_in(found[1], spoken)} {found[2]}"
    if found := _LIGAMENT.fullmatch(text):
        return f"{found[1]} {title_in(found[2], spoken)}"
    if found := _ENERGY.fullmatch(text):
        return f"{title_in(found[1], spoken)}, {title_in(found[2], spoken)}"
    if found := _TARGETS.fullmatch(text):
        scheme = title_in(found[2], spoken)
        return spoken.word("Own targets, {share} of the limits: {scheme}", share=found[1], scheme=scheme)
    return text


def with_titles(result: Result, spoken: Language) -> Result:
    """Return a result whose titles are in a language."""
    return result.model_copy(
        update={
            "title": title_in(result.title, spoken),
            "specimen": {name: title_in(value, spoken) for name, value in result.specimen.items()},
            "criteria": type(result.criteria)(_criterion(each, spoken) for each in result.criteria),
            "curves": _histories(result.curves, spoken),
            "energies": _histories(result.energies, spoken),
            "motion": _motion(result.motion, spoken),
        }
    )


def _criterion(criterion: CriterionResult, spoken: Language) -> CriterionResult:
    curve = criterion.curve
    if curve is not None:
        titles = {name: title_in(getattr(curve, name), spoken) for name in ("x_title", "y_title")}
        curve = curve.model_copy(update=titles)
    return criterion.model_copy(update={"title": title_in(criterion.title, spoken), "curve": curve})


def _histories(histories: Histories | None, spoken: Language) -> Histories | None:
    if histories is None:
        return None
    series = {
        name: each.model_copy(update={"title": title_in(each.title, spoken)})
        for name, each in histories.series.items()
    }
    return histories.model_copy(update={"series": series})


def _note_in(note: str, spoken: Language) -> str:
    """Return a note in a language; one that no fixture of ours writes stays."""
    for known in _NOTES:
        pattern = re.sub(r"\\{(\w+)\\}", r"(?P<\1>\\S+)", re.escape(known))
        if found := re.fullmatch(pattern, note):
            return spoken.word(known, **found.groupdict())
    return note


def _motion(motion: Motion | None, spoken: Language) -> Motion | None:
    """Name the parts of leg and rig, with what is noted beside a name."""
    if motion is None:
        return None
    named: dict[str, list[object]] = {
        field: [
            shape.model_copy(
                update={"name": title_in(shape.name, spoken), "note": _note_in(shape.note, spoken)}
            )
            for shape in getattr(motion, field)
        ]
        for field in ("shapes", "scene", "before")
    }
    named["joints"] = [title_in(name, spoken) for name in motion.joints]
    return motion.model_copy(update=named)
