"""Which criterion came nearest to its limit: picked from the margins that grading wrote, not judged here."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.grading.relative_margin import relative_margin
from certkit.reporting.language import Language, language
from certkit.reporting.number_format import corridor, criterion_decimals, fixed

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Result


def worst(result: Result) -> CriterionResult | None:
    """Return the graded criterion nearest to a limit or furthest beyond it, else any with a curve."""
    rated = [(m, c) for c in result.criteria if c.graded and (m := relative_margin(c)) is not None]
    if rated:
        return min(rated, key=lambda pair: pair[0])[1]
    drawn = [c for c in result.criteria if c.curve or (result.curves and c.channel in result.curves.series)]
    return next((c for c in drawn if c.graded), drawn[0] if drawn else None)


def margin_words(criterion: CriterionResult | None, spoken: Language | None = None) -> str:
    """Write `T4: 2.3 N·m inside 90 – 111 (22 % of the half-width)`, or a dash."""
    if criterion is None or criterion.margin is None or not math.isfinite(criterion.margin):
        return "–"
    t = (spoken or language()).word
    size = fixed(abs(criterion.margin), criterion_decimals(criterion))
    side = t("inside") if criterion.margin >= 0 else t("outside")
    words = f"{criterion.id}: {size} {criterion.unit} {side}"
    if criterion.lower is None and criterion.upper is None:
        return words
    words += f" {corridor(criterion.lower, criterion.upper)}"
    share = relative_margin(criterion)
    if share is None:
        return words
    percent = f"{abs(share) * 100:.0f}"
    if criterion.lower is not None and criterion.upper is not None:
        return f"{words} ({t('{percent} % of the half-width', percent=percent)})"
    return f"{words} ({t('{percent} % of the limit', percent=percent)})"


def nearest_words(criterion: CriterionResult | None, spoken: Language | None = None) -> str:
    """Write `Nearest to a limit: T4: …` or, where a limit was missed, `Furthest outside: PCL: …`."""
    if criterion is None or criterion.margin is None or not math.isfinite(criterion.margin):
        return ""
    t = (spoken or language()).word
    lead = t("Nearest to a limit") if criterion.margin >= 0 else t("Furthest outside")
    return f"{lead}: {margin_words(criterion, spoken)}"


def tally(result: Result, spoken: Language | None = None) -> str:
    """Write how the criteria came out: `7 of 7 graded criteria within corridor; 3 shown, not graded`."""
    spoken = spoken or language()
    t = spoken.word
    graded = [c for c in result.criteria if c.graded]
    shown = len(result.criteria) - len(graded)
    if not graded:
        said = t("No criterion could be graded; {shown} shown.", shown=shown)
        return said if shown else t("No criterion could be graded.")
    passed = sum(c.verdict == "pass" for c in graded)
    if len(graded) == 1:
        words = t("{passed} of {count} graded criterion within corridor", passed=passed, count=len(graded))
    else:
        words = t("{passed} of {count} graded criteria within corridor", passed=passed, count=len(graded))
    others = {
        word: sum(c.verdict == word for c in graded)
        for word in ("fail", "conditional", "not evaluated", "error")
    }
    words += "".join(f"; {count} {spoken.verdict(word)}" for word, count in others.items() if count)
    return words + (t("; {shown} shown, not graded.", shown=shown) if shown else ".")
