"""Force over shortening of springs: the run's two branches, the law, and what the model ran through."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.chosen import chosen
from certkit.reporting.charts.grid import together
from certkit.reporting.charts.lines import Line, lines_chart, pressed
from certkit.reporting.coupled_check import check_of, group_of
from certkit.reporting.language import Translate, english

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult, LawResult, PathResult
    from certkit.documents.self_check import PathCheck
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 240.0
FARTHER = 1.005
"""Times the largest shortening of the run, beyond which the model is said to leave what was seen."""
PENS = (
    palette.Pen(palette.PENS[0].colour, None),
    palette.Pen(palette.PENS[0].colour, "2 2.5"),
    palette.Pen(palette.PENS[2].colour, "9 3 2 3"),
    palette.Pen(palette.PENS[1].colour, "7 3"),
)
"""Run while loading, run while unloading, law, model."""


def draw(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw all springs and sheets, or those that are named."""
    known = {path.name: path for path in result.paths if path.law or path.sheet}
    if not known:
        return None
    panels = [spring_chart(result, known[name]) for name in chosen(names, known, "load path")]
    return together([p for p in panels if p], f"Force over shortening, {result.title}")


def spring_chart(result: ExtractionResult, path: PathResult, t: Translate = english) -> Drawing | None:
    """Draw one spring or sheet; None for one that nothing pushed.

    A sheet's force follows the mean displacement of both groups; that is its abscissa.
    """
    check = path_check(result, path.name)
    if not any(path.force):
        return None
    if path.sheet is not None:
        return _sheet_chart(result, path, check, t)
    xs = [1e3 * x for x in path.shortening]
    if not any(xs):
        return None
    top = max(range(len(xs)), key=lambda k: xs[k])
    lines: list[Line] = [
        (t("run"), *pressed(xs[: top + 1], path.force[: top + 1])),
        (t("run, back"), *pressed(xs[top:], path.force[top:])),
    ]
    pens = [PENS[0], PENS[1]]
    farthest = max(xs[top], 1e3 * check.largest if check else 0.0)
    if path.law:
        lines.append((t("law"), *_law(path.law, 1e-3 * farthest)))
        pens.append(PENS[2])
    if check:
        lines.append((t("model"), *pressed([1e3 * x for x in check.shortening], check.force)))
        pens.append(PENS[3])
    beyond = xs[top] if farther(result, path) else None
    return lines_chart(
        lines, path.name, t("shortening, mm"), "N", width=WIDTH, height=HEIGHT, pens=pens, beyond=beyond
    )


def path_check(result: ExtractionResult, name: str) -> PathCheck | None:
    """Return what a path did in the coupled run."""
    check = check_of(result, "coupled")
    return next((p for p in check.paths if p.name == name), None) if check else None


def reach(result: ExtractionResult, path: PathResult) -> tuple[float, float] | None:
    """Return the farthest that a path went in the model and in the run, m; None without a coupled run.

    Of a spring its shortening, of a sheet the mean displacement of its groups.
    """
    check = path_check(result, path.name)
    if check is None:
        return None
    if path.sheet is None:
        return check.largest, check.run_largest
    run, model = _pushed_in(result, path)
    return (1e-3 * max(model), 1e-3 * max(run)) if run and model else None


def farther(result: ExtractionResult, path: PathResult) -> bool:
    """Tell whether a path went farther in the model than its law was read from."""
    found = reach(result, path)
    return found is not None and found[0] > max(FARTHER * found[1], 0.0)


def _pushed_in(result: ExtractionResult, path: PathResult) -> tuple[list[float], list[float]]:
    """Return the mean displacement of a sheet's groups in run and model, mm."""
    groups = {group.name: group.displacement for group in result.groups}
    coupled = check_of(result, "coupled")
    ends = (
        [groups.get(name, ()) for name in (path.source, path.target)],
        [g.displacement if g else () for g in (group_of(coupled, n) for n in (path.source, path.target))],
    )
    run, model = ([500 * (a + b) for a, b in zip(*own, strict=False)] for own in ends)
    return run, model


def _law(law: LawResult, farthest: float) -> tuple[list[float], list[float]]:
    """Return the law's loading curve up to the farthest shortening (m), and how it unloads from there."""
    points = [(x, f) for x, f in zip(law.shortening, law.force, strict=True) if 0.0 <= x < farthest]
    if not points or points[0][0] > 0:
        points.insert(0, (0.0, 0.0))
    end = _at(law, farthest)
    points.append((farthest, end))
    rest = law.permanent_set * farthest if law.residual > 0 else max(farthest - end / law.unloading, 0.0)
    count = 24
    for k in range(1, count + 1):
        x = farthest - (farthest - rest) * k / count
        steep = end - law.unloading * (farthest - x)
        flat = law.residual * end * (x - rest) / max(farthest - rest, 1e-12)
        points.append((x, max(steep, flat, 0.0)))
    return [1e3 * x for x, _ in points], [f for _, f in points]


def _at(law: LawResult, x: float) -> float:
    """Return the loading curve at a shortening (m), continued with its last slope, never a falling one."""
    xs, fs = law.shortening, law.force
    if len(xs) < 2:
        return fs[0] if fs else 0.0
    if x >= xs[-1]:
        slope = max((fs[-1] - fs[-2]) / max(xs[-1] - xs[-2], 1e-12), 0.0)
        return fs[-1] + slope * (x - xs[-1])
    k = next(k for k in range(1, len(xs)) if xs[k] > x)
    return fs[k - 1] + (fs[k] - fs[k - 1]) * (x - xs[k - 1]) / (xs[k] - xs[k - 1])


def _sheet_chart(
    result: ExtractionResult, path: PathResult, check: PathCheck | None, t: Translate
) -> Drawing | None:
    run, model = _pushed_in(result, path)
    if not run:
        return None
    top = max(range(len(run)), key=lambda k: run[k])
    lines: list[Line] = [
        (t("run"), run[: top + 1], path.force[: top + 1]),
        (t("run, back"), run[top:], path.force[top:]),
    ]
    pens = [PENS[0], PENS[1]]
    if check and model:
        lines.append((t("model"), model[: len(check.force)], check.force[: len(model)]))
        pens.append(PENS[3])
    beyond = run[top] if farther(result, path) else None
    return lines_chart(
        lines,
        path.name,
        t("both pushed in, mean, mm"),
        "N",
        width=WIDTH,
        height=HEIGHT,
        pens=pens,
        beyond=beyond,
    )
