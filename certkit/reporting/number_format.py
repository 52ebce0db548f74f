"""How numbers and verdicts are worded, in every format alike."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Verdict

MISSING = "–"
MINUS = "−"

SIGNS = {"pass": "✓", "fail": "✗", "conditional": "!", "not evaluated": "○", "error": "⚠"}

# Decimals that the field writes; other units get four significant digits.
_DECIMALS = {"N·m": 1, "mm": 2, "N": 0, "kN": 2, "m/s²": 0, "deg": 1, "J": 2, "ms": 1}

CONFIDENCE = {
    "verified": "read in the named text",
    "secondary": "read in somebody's account of it",
    "recalled": "named text not read",
    "derived": "follows by arithmetic",
    "calibrated": "fitted to tests",
    "estimated": "a judgement",
}

_PLACES = 6  # powers of ten from which on a number is written with its power

_MEANINGS = {
    "pass": "All graded criteria lie inside their corridors.",
    "fail": "At least one criterion lies outside its corridor.",
    "conditional": "At least one criterion lies inside its guard band.",
    "not evaluated": "Something that a verdict needs is missing.",
    "error": "The run cannot be trusted, so there is no verdict.",
}


def verdict_class(verdict: str) -> str:
    """Return the class by which style sheets know a verdict, such as `v-not-evaluated`."""
    return "v-" + verdict.replace(" ", "-")


def meaning(verdict: Verdict) -> str:
    """Return one sentence on what an overall verdict says."""
    return _MEANINGS[verdict]


def named(name: str, title: str) -> str:
    """Return `T1 Tibia moment 1`, `MCL elongation` and `Knee bending angle`: nothing is said twice."""
    said = name.islower() or title.casefold().startswith(name.casefold())
    return title[:1].upper() + title[1:] if said else f"{name} {title}"


def rest(name: str, title: str) -> str:
    """Return what a title says beyond its name."""
    return title[len(name) :].strip() if title.casefold().startswith(name.casefold()) else title


def shortened(text: str, most: int) -> str:
    """Return a text, or as many of its letters as there is room for, with `…` at their end."""
    return text if len(text) <= most else f"{text[: most - 1]}…"


def fixed(value: float | None, decimals: int) -> str:
    """Write a number with so many decimals and a true minus sign."""
    if value is None or not math.isfinite(value):
        return MISSING
    text = f"{value:.{decimals}f}"
    if text.strip("-0.") == "":
        text = text.lstrip("-")
    return text.replace("-", MINUS)


def signed(value: float | None, decimals: int) -> str:
    """Write a difference likewise, with its sign; a zero has none."""
    return _with_plus(fixed(value, decimals))


def plain(value: float | None, digits: int = 6) -> str:
    """Write a given number (a limit) without needless zeros."""
    if value is None or not math.isfinite(value):
        return MISSING
    return f"{value:.{digits}g}".replace("-", MINUS)


def significant(value: float | None, digits: int) -> str:
    """Write a computed number with so many significant digits: `0.10`, `1.0`, `170`, never `1.7e+02`."""
    if value is None or not math.isfinite(value):
        return MISSING
    rounded = float(f"{value:.{digits - 1}e}")
    if rounded == 0:
        return "0"
    power = math.floor(math.log10(abs(rounded)))
    if not -_PLACES <= power <= _PLACES:
        return f"{rounded:.{digits - 1}e}".replace("-", MINUS)
    return fixed(rounded, max(0, digits - 1 - power))


def signed_significant(value: float | None, digits: int) -> str:
    """Write a difference likewise, with its sign; a zero has none."""
    return _with_plus(significant(value, digits))


def _with_plus(text: str) -> str:
    return text if text.startswith((MINUS, MISSING)) or not text.strip("0.") else f"+{text}"


def decimals(unit: str, value: float | None) -> int:
    """Return with how many decimals a value of that unit is shown."""
    if unit in _DECIMALS:
        return _DECIMALS[unit]
    if not value or not math.isfinite(value):
        return 1
    return min(6, max(0, 3 - math.floor(math.log10(abs(value)))))


def shown(value: float | None, unit: str) -> str:
    """Write a value as the field does, without its unit."""
    return fixed(value, decimals(unit, value))


def criterion_decimals(criterion: CriterionResult) -> int:
    """Return decimals that never round a value onto the limit it missed or met by little."""
    wanted = decimals(criterion.unit, criterion.value)
    margin = criterion.margin
    if margin is not None and math.isfinite(margin) and margin != 0:
        while wanted < 6 and abs(margin) < 0.95 * 10.0**-wanted:
            wanted += 1
    return wanted


def corridor(lower: float | None, upper: float | None) -> str:
    """Write a corridor: `235 – 272`, `≤ 22`, `≥ 400`."""
    if lower is not None and upper is not None:
        return f"{plain(lower)} – {plain(upper)}"
    if upper is not None:
        return f"≤ {plain(upper)}"
    return f"≥ {plain(lower)}" if lower is not None else MISSING


def milliseconds(seconds: float | None) -> str:
    """Write a time in ms with one decimal, without its unit."""
    return fixed(None if seconds is None else seconds * 1e3, 1)
