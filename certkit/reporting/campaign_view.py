"""A campaign as its reports show it: points in their order across the car, cells with words and shades."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.language import english, language
from certkit.reporting.number_format import MISSING, SIGNS, fixed, plain, shown

if TYPE_CHECKING:
    from certkit.documents.campaign_report import (
        CampaignReport,
        JudgedCriterion,
        JudgedPoint,
        JudgedScheme,
        PointReport,
        SourceReport,
    )
    from certkit.documents.result import Verdict
    from certkit.reporting.language import Language, Translate

KINDS = {"measured": "measured", "finite elements": "FE", "lumped": "lumped", "predicted": "predicted"}
BASES = {"mirrored": "mirrors {point}", "neighbour": "as {point}", "none": "nothing known"}

MEANINGS = {
    "pass": "Every scheme that gates is met at every point.",
    "fail": "At least one scheme, target or tolerance is not met.",
    "conditional": "At least one value lies inside the guard band of its limit.",
    "not evaluated": "Something that a verdict needs is missing.",
    "error": "At least one run cannot be trusted, so there is no verdict.",
}

SHADES = (0.999, 0.75, 0.5, 0.25)
"""Share of the points from which on a point is in the first, second, … of five shades."""

NEAR = 90.0
"""Percent of a limit from which on a passing value counts as near it."""


class Head(Struct, frozen=True):
    """A column of the table: a criterion, or what a value is held against."""

    id: str
    unit: str
    limits: str

    @property
    def text(self) -> str:
        """Name and unit."""
        return f"{self.id} [{self.unit}]"


class Cell(Struct, frozen=True):
    """A value of the table."""

    text: str
    percent: float | None
    shade: str
    words: str

    @property
    def bar(self) -> float:
        """Length of the bar behind it, 0 to 100."""
        return max(0.0, min(100.0, self.percent or 0.0))


class ShownPoint(Struct, frozen=True):
    """A row of the table."""

    point: PointReport
    across: str
    source: str
    basis: str
    cells: tuple[Cell, ...]
    judged: tuple[JudgedPoint, ...]
    shade: str
    decisive: SourceReport | None

    @property
    def name(self) -> str:
        """Of the point."""
        return self.point.name


class CampaignView:
    """The document with what every report needs of it."""

    def __init__(self, document: CampaignReport, spoken: Language | None = None) -> None:
        """Keep the document and the language of its words; everything else is made when asked for."""
        self.document = document
        self.spoken = spoken or language()
        self.t = self.spoken.word
        self.first = document.schemes[0]

    @cached_property
    def scheme_names(self) -> list[str]:
        """Short name of each scheme."""
        return [self.short(scheme) for scheme in self.document.schemes]

    @cached_property
    def criteria(self) -> list[Head]:
        """Columns: all criteria that some scheme looks at."""
        found: dict[str, tuple[str, list[str]]] = {}
        for scheme in self.document.schemes:
            for row in scheme.points:
                for each in row.criteria:
                    _, limits = found.setdefault(each.id, (each.unit, []))
                    words = limit_words(each)
                    if scheme is self.first and words not in limits:
                        limits.append(words)
        return [Head(name, unit, " / ".join(limits)) for name, (unit, limits) in found.items()]

    @cached_property
    def points(self) -> list[ShownPoint]:
        """Rows, from the right of the car to its left: as one reads the picture from ahead."""
        ordered = sorted(self.document.points, key=lambda point: point.across)
        return [self._shown(point) for point in ordered]

    def _shown(self, point: PointReport) -> ShownPoint:
        judged = tuple(row for s in self.document.schemes for row in s.points if row.point == point.name)
        first = judged[0]
        decisive = next((source for source in point.sources if source.decides), None)
        other = next((row for row in judged if row.basis != "none"), first)
        basis = "" if other.basis == "own" else self.t(BASES[other.basis], point=other.of)
        source = self.t(KINDS[decisive.kind]) if decisive else basis
        return ShownPoint(
            point=point,
            across=plain(point.across),
            source=source,
            basis=basis,
            cells=tuple(self._cell(head, point, judged) for head in self.criteria),
            judged=judged,
            shade=point_shade(first),
            decisive=decisive,
        )

    def _cell(self, head: Head, point: PointReport, judged: tuple[JudgedPoint, ...]) -> Cell:
        for row in judged:
            each = next((c for c in row.criteria if c.id == head.id), None)
            if each is not None:
                words = self.t(
                    "{percent} % of {limit}",
                    percent=plain(each.percent, 3),
                    limit=f"{limit_words(each)} {each.unit}",
                )
                return Cell(shown(each.value, each.unit), each.percent, criterion_shade(each), words)
        source = next((source for source in point.sources if source.decides), None)
        value = next((v for v in source.values if v.id == head.id), None) if source else None
        return Cell(MISSING, None, "none", value.reason if value and value.reason else self.t("no value"))

    def anchor(self, name: str) -> str:
        """Return where the page tells more of a point."""
        return f"point-{[point.name for point in self.document.points].index(name) + 1}"

    def shade(self, row: JudgedPoint) -> str:
        """Return the shade of a judged point."""
        return point_shade(row)

    def scheme_shade(self, scheme: JudgedScheme) -> str:
        """Return the shade of a scheme: its verdict's, or that of the mean share of its points."""
        if scheme.verdict is None:
            return "none" if scheme.percent is None else share_shade(scheme.percent / 100.0)
        return {"pass": "s1", "conditional": "s3", "fail": "s5"}.get(scheme.verdict, "none")

    def headline(self, scheme: JudgedScheme) -> str:
        """Return what a scheme comes to in a few words."""
        if scheme.total is not None:
            return self.t("{part} of {whole}", part=fixed(scheme.total, 3), whole=plain(scheme.maximum))
        if scheme.verdict is not None:
            passing = sum(row.verdict == "pass" for row in scheme.points)
            return self.t("{passed} of {count} points pass", passed=passing, count=len(scheme.points))
        return self.t("shares by point")

    def worst_words(self, scheme: JudgedScheme) -> str:
        """Return what decides at the worst point."""
        row = next(row for row in scheme.points if row.point == scheme.worst_point)
        score = "" if row.maximum is None else f"{self.judged_words(row)}, "
        percent = plain(row.percent, 3)
        return score + self.t("{criterion} at {percent} % of the limit", criterion=row.worst, percent=percent)

    def short(self, scheme: JudgedScheme) -> str:
        """Return a scheme's short name."""
        return short_name(scheme, self.t)

    def judged_words(self, row: JudgedPoint) -> str:
        """Return what is said of a judged point in its mark."""
        return judged_words(row, self.t)

    def shades(self, scheme: JudgedScheme) -> list[tuple[str, str]]:
        """Return the legend of a scheme's colours."""
        if scheme.kind != "points":
            words = (
                self.t("inside its limits"),
                self.t("from {percent} % of a limit on", percent=f"{NEAR:g}"),
                self.t("in a guard band"),
                self.t("beyond a limit"),
            )
            return list(zip(("s1", "s2", "s3", "s5"), words, strict=True))
        shares = ("all points", "75 % and more", "50 % and more", "25 % and more", "less")
        return [(f"s{place}", self.t(said)) for place, said in enumerate(shares, 1)]

    @property
    def meaning(self) -> str:
        """One sentence on what the verdict says."""
        return self.t(MEANINGS[self.document.verdict])

    @property
    def agreement_words(self) -> str:
        """What prediction against verification comes to; empty without such points."""
        rows = self.document.agreement
        if not rows:
            return ""
        mean = sum(abs(row.error_percent) for row in rows) / len(rows)
        far = max(rows, key=lambda row: abs(row.error_percent))
        places = len({row.point for row in rows})
        return self.t(
            "predicted against measured at {points}: {mean} % off in the mean, "
            "most {criterion} at {point}, {error} %",
            points=self.t("1 point") if places == 1 else self.t("{count} points", count=places),
            mean=f"{mean:.1f}",
            criterion=far.criterion,
            point=far.point,
            error=fixed(far.error_percent, 1),
        )


def short_name(scheme: JudgedScheme, t: Translate = english) -> str:
    """Return a scheme's name, or that these are the maker's own targets."""
    return t("own targets") if scheme.kind == "targets" else scheme.scheme


def limit_words(row: JudgedCriterion) -> str:
    """Return `340`, or `282–340` for a scale."""
    if row.full is None or row.full == row.limit:
        return plain(row.limit, 4)
    return f"{plain(row.full, 4)}–{plain(row.limit, 4)}"


def judged_words(row: JudgedPoint, t: Translate = english) -> str:
    """Return `✓ 83 %` of a limit, or `0.87 of 1` points."""
    if row.maximum is not None:
        return t("{part} of {whole}", part=fixed(row.points, 2), whole=plain(row.maximum))
    sign = SIGNS[row.verdict or "not evaluated"]
    return sign if row.percent is None else f"{sign} {row.worst} {row.percent:.0f} %"


def car_score(scheme: JudgedScheme) -> str:
    """Return `4.62 of 6 points`; empty where there is no total."""
    if scheme.total is None:
        return ""
    asked = "" if scheme.at_least is None else f", at least {plain(scheme.at_least)} asked for"
    return f"{fixed(scheme.total, 3)} of {plain(scheme.maximum)} points{asked}"


def point_shade(row: JudgedPoint) -> str:
    """Return the shade of a point: a verdict's, or s1 (full points) to s5 (none)."""
    if row.basis == "none" or (row.maximum is not None and not row.criteria):
        return "none"
    if row.maximum is not None:
        return share_shade((row.points or 0.0) / row.maximum)
    return _verdict_shade(row.verdict, row.percent)


def share_shade(share: float) -> str:
    """Return s1 for full points to s5 for none or nearly none."""
    return next((f"s{place}" for place, least in enumerate(SHADES, 1) if share >= least), "s5")


def criterion_shade(row: JudgedCriterion) -> str:
    """Return the shade of a value."""
    if row.share is not None:
        return share_shade(row.share)
    return _verdict_shade(row.verdict, row.percent)


def _verdict_shade(verdict: Verdict | None, percent: float | None) -> str:
    if verdict == "pass":
        return "s2" if (percent or 0.0) >= NEAR else "s1"
    return {"fail": "s5", "conditional": "s3"}.get(verdict or "", "none")
