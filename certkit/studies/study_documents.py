"""The documents of a study and of an optimisation, from what was found."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msgspec.structs import asdict

from certkit._version import __version__
from certkit.documents.optimum_report import OptimumReport, OptimumValue, PursuedAim
from certkit.documents.study_report import Cloud, Effect, SensitivityIndex, StudyReport, VariedParameter
from certkit.studies.factors import Levels
from certkit.studies.run_table import records
from certkit.studies.study_findings import Findings

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import pandas as pd

    from certkit.documents.rounding import FigureOrWord
    from certkit.documents.study_report import QuickModel
    from certkit.studies.factors import Factor
    from certkit.studies.optimise import Optimum

MOST_CLOUDS = 3
"""Strongest parameters of each output over which its runs are drawn."""

MOST_DOTS = 600
"""Dots in one cloud: more cannot be told apart and make the page heavy."""


def report_of(found: Findings | Optimum) -> StudyReport | OptimumReport:
    """Return the document of what a study found."""
    return study_report(found) if isinstance(found, Findings) else optimum_report(found)


def study_report(findings: Findings) -> StudyReport:
    """Return the document of a study with a design."""
    effects = [Effect(**row) for row in records(findings.effects)]
    outputs = [name for name in dict.fromkeys(e.output for e in effects) if not _is_quality(name)]
    return StudyReport(
        study=findings.name,
        title=findings.title,
        design=findings.design,
        runs=len(findings.table),
        failed=findings.failed,
        factors=[_varied(factor) for factor in findings.factors],
        output_units=findings.output_units,
        effects=effects,
        indices=None
        if findings.indices is None
        else [SensitivityIndex(**row) for row in records(findings.indices)],
        models=findings.models,
        chances=findings.chances,
        outputs=outputs,
        clouds=[cloud for name in outputs for cloud in _clouds(findings, effects, name)],
        certkit=__version__,
    ).with_id()


def optimum_report(optimum: Optimum) -> OptimumReport:
    """Return the document of an optimisation."""
    row = optimum.table.iloc[optimum.best]
    shown = [name for name in optimum.output_units if name in optimum.table and not name.endswith(" margin")]
    return OptimumReport(
        study=optimum.name,
        title=optimum.title,
        runs=len(optimum.table),
        keeps_all_limits=optimum.keeps,
        slack=optimum.slack,
        best_run=optimum.best + 1,
        settings=list(optimum.settings),
        factors=[_varied(factor) for factor in optimum.factors],
        best={factor.name: _plain(row[factor.name]) for factor in optimum.factors},
        outputs=[
            OptimumValue(name=name, value=_number(row[name]), unit=optimum.output_units[name])
            for name in shown
        ],
        aims=[PursuedAim(output=aim.output, direction=aim.direction) for aim in optimum.aims],
        trade_off=[
            {"run": place + 1, **{a.output: float(optimum.table.iloc[place][a.output]) for a in optimum.aims}}
            for place in optimum.curve
        ],
        cloud=_trade_off(optimum),
        certkit=__version__,
    ).with_id()


def _clouds(findings: Findings, effects: Sequence[Effect], output: str) -> Iterator[Cloud]:
    """Yield the runs of an output over the parameters that move it most, with the linear model's line."""
    strongest = sorted((e for e in effects if e.output == output), key=lambda e: -abs(e.effect))
    numeric = {factor.name: factor for factor in findings.factors if not _has_words(factor)}
    known = findings.table[findings.table[output].notna()]
    linear = next((m for m in findings.models if m.output == output and m.kind == "linear"), None)
    for effect in strongest[:MOST_CLOUDS]:
        factor = numeric.get(effect.factor)
        if factor is not None:
            line = [] if linear is None else _line(linear, factor)
            yield _cloud(known, factor.name, output, line)


def _line(model: QuickModel, factor: Factor) -> list[tuple[float, float]]:
    """Return the linear model along one factor, the others in the middle."""
    if isinstance(factor.distribution, Levels):
        return []
    middle, slope = model.coefficients[0], model.coefficients[model.terms.index(factor.name)]
    return [(factor.distribution.low, middle - slope), (factor.distribution.high, middle + slope)]


def _trade_off(optimum: Optimum) -> Cloud | None:
    if not optimum.curve:
        return None
    first, second = (aim.output for aim in optimum.aims)
    line = optimum.table.loc[list(optimum.curve), [first, second]].to_numpy()
    known = optimum.table[[first, second]].dropna()
    return _cloud(known, first, second, [(float(x), float(y)) for x, y in line])


def _cloud(table: pd.DataFrame, x: str, y: str, line: list[tuple[float, float]]) -> Cloud:
    stride = max(1, -(-len(table) // MOST_DOTS))
    xs, ys = ([float(v) for v in table[name]][::stride] for name in (x, y))
    return Cloud(x_name=x, y_name=y, x=xs, y=ys, line=line)


def _varied(factor: Factor) -> VariedParameter:
    kind = factor.distribution
    given = asdict(kind)
    if not isinstance(kind, Levels):
        given |= {"low": kind.low, "high": kind.high}
    return VariedParameter(
        name=factor.name, unit=factor.unit, nominal=factor.nominal, distribution=kind.word, **given
    )


def _has_words(factor: Factor) -> bool:
    kind = factor.distribution
    return isinstance(kind, Levels) and any(isinstance(entry, str) for entry in kind.entries)


def _is_quality(output: str) -> bool:
    return output.endswith((" %", " mm"))


def _plain(value: Any) -> FigureOrWord:  # noqa: ANN401  # a cell of a table
    return value if isinstance(value, str) else float(value)


def _number(value: Any) -> float | None:  # noqa: ANN401  # a cell of a table
    return None if value != value else float(value)  # noqa: PLR0124  # NaN
