"""The pages of a study, of an optimisation and of a calibration, each from its document alone.

HTML in the certificates' style, without a script.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from certkit.definitions.study import DESIGNS
from certkit.reporting.charts.study_charts import dots, tornado
from certkit.reporting.language import ENGLISH, language
from certkit.reporting.number_format import plain, significant
from certkit.reporting.static_page import static_page

if TYPE_CHECKING:
    from certkit.documents.calibration_report import CalibrationReport
    from certkit.documents.optimum_report import OptimumReport
    from certkit.documents.rounding import FigureOrWord
    from certkit.documents.study_report import Cloud, StudyReport, VariedParameter
    from certkit.reporting.language import Translate
    from certkit.reporting.svg import Drawing


def study_page(document: StudyReport, spoken: str = ENGLISH) -> str:
    """Return the page of a study: what moves what, by how much, in which direction."""
    return static_page(
        "study.html.j2",
        document.title,
        spoken=spoken,
        study=document,
        from_middle=document.design in DESIGNS and DESIGNS[document.design].from_middle,
        said=_in_short(document, language(spoken).word),
        overview=_overview(document),
        sections=[_section(document, name, language(spoken).word) for name in document.outputs],
        factors=[_range(factor, language(spoken).word) for factor in document.factors],
    )


def _in_short(document: StudyReport, t: Translate) -> list[str]:
    """Say how many runs keep every limit, what leaves its corridor first, and what is not known."""
    if not document.chances:
        return []
    first, together = document.chances[0], document.chances[-1]
    beyond = first.runs - first.inside - first.unknown
    said = [
        t("{inside} of {runs} runs keep every limit.", inside=together.inside, runs=together.runs),
        t("{criterion} leaves its corridor first, in {count} runs.", criterion=first.criterion, count=beyond)
        if beyond
        else "",
        t("{count} runs failed or were not evaluated; they count as outside.", count=together.unknown)
        if together.unknown
        else "",
    ]
    return [sentence for sentence in said if sentence]


def _overview(document: StudyReport) -> dict[str, Any]:
    """Return the share of each parameter in what moves each graded value, or each value where none is."""
    graded = {chance.criterion for chance in document.chances}
    shown = [name for name in document.outputs if name in graded] or document.outputs
    scopes = {name.partition("/")[0] for name in shown}
    heads = [name.partition("/")[2] or name for name in shown] if len(scopes) == 1 else shown
    effects = {(effect.factor, effect.output): effect for effect in document.effects}
    most = {
        output: max((e.share for (_, o), e in effects.items() if o == output), default=0.0)
        for output in shown
    }
    rows = [
        (
            factor.name,
            [
                (effect.share, effect.effect, effect.share == most[output])
                if (effect := effects.get((factor.name, output))) is not None
                else None
                for output in shown
            ],
        )
        for factor in document.factors
    ]
    rows.sort(key=lambda row: -max((cell[0] for cell in row[1] if cell is not None), default=0.0))
    return {"heads": heads, "rows": rows}


def _section(document: StudyReport, output: str, t: Translate) -> dict[str, Any]:
    unit = document.output_units.get(output, "")
    effects = [effect for effect in document.effects if effect.output == output]
    rows = [(effect.factor, effect.effect, effect.lower, effect.upper) for effect in effects]
    units = {factor.name: factor.unit for factor in document.factors} | document.output_units
    return {
        "output": output,
        "unit": unit,
        "effects": sorted(effects, key=lambda effect: -abs(effect.effect)),
        "tornado": tornado(
            rows,
            t("{value}: effect of each parameter", value=output),
            t("change over the range, {unit}", unit=unit or t("its unit")),
        ),
        "scatters": [
            _cloud(cloud, t("{value} against {parameter}", value=output, parameter=cloud.x_name), units)
            for cloud in document.clouds
            if cloud.y_name == output
        ],
        "models": [model for model in document.models if model.output == output],
        "indices": [index for index in document.indices or [] if index.output == output],
    }


def _cloud(cloud: Cloud, title: str, units: dict[str, str]) -> Drawing:
    axes = (_with_unit(cloud.x_name, units), _with_unit(cloud.y_name, units))
    return dots(cloud.x, cloud.y, title, axes, cloud.line)


def _range(factor: VariedParameter, t: Translate) -> dict[str, str]:
    """Say how a factor varies, in words."""
    if factor.entries is not None:
        words = ", ".join(_quantity(entry, factor.unit) for entry in factor.entries)
    else:
        low, high = factor.low or 0.0, factor.high or 0.0
        ends = t("{low} to {high}", low=plain(low), high=plain(high))
        words = f"{_quantity(ends, factor.unit, word=False)}, {t(factor.distribution)}"
    nominal = "–" if factor.nominal is None else _quantity(factor.nominal, factor.unit, word=False)
    return {"name": factor.name, "range": words, "nominal": nominal}


def _quantity(value: FigureOrWord, unit: str, *, word: bool = True) -> str:
    """Write a value with its unit; a word has none."""
    text = value if isinstance(value, str) else plain(value)
    return text if not unit or (word and isinstance(value, str)) else f"{text} {unit}"


def _with_unit(name: str, units: dict[str, str]) -> str:
    return f"{name}, {units[name]}" if units.get(name) else name


def optimum_page(document: OptimumReport, spoken: str = ENGLISH) -> str:
    """Return the page of an optimisation: best settings, their values, and the trade-off of two aims."""
    t = language(spoken).word
    settings = [
        {**_range(factor, t), "best": _quantity(_best(document.best[factor.name]), factor.unit, word=False)}
        for factor in document.factors
    ]
    units = {value.name: value.unit for value in document.outputs}
    return static_page(
        "optimum.html.j2",
        document.title,
        spoken=spoken,
        optimum=document,
        settings=settings,
        curve="" if document.cloud is None else _cloud(document.cloud, t("Trade-off of two aims"), units),
    )


def _best(value: FigureOrWord) -> str:
    """Write the best setting of a parameter with as many digits as it is worth."""
    return value if isinstance(value, str) else significant(value, 4)


def calibration_page(document: CalibrationReport, spoken: str = ENGLISH) -> str:
    """Return the page of a calibration: values before and after, and how well each parameter is known."""
    return static_page("fit.html.j2", document.title, spoken=spoken, fit=document)
