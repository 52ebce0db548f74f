"""The pages of a study and of a fit: HTML in the certificates' style, without a script."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from certkit.reporting.static_page import sheet
from certkit.studies.factors import Levels
from certkit.studies.study_charts import dots, tornado

if TYPE_CHECKING:
    from certkit.studies.factors import Factor
    from certkit.studies.optimise import Optimum
    from certkit.studies.quick_model import QuickModel
    from certkit.studies.study_findings import Findings

MOST_SCATTERS = 3
"""Strongest parameters of each output that get a scatter figure."""


def study_page(findings: Findings) -> str:
    """Return the page of a study: what moves what, by how much, in which direction."""
    outputs = list(dict.fromkeys(findings.effects["output"])) if len(findings.effects) else []
    shown = [name for name in outputs if not _is_quality(name)]
    return sheet(
        "study.html.j2",
        findings.title,
        study=findings,
        sections=[_section(findings, name) for name in shown],
        factors=[_range(factor) for factor in findings.factors],
    )


def _section(findings: Findings, output: str) -> dict[str, Any]:
    unit = findings.output_units.get(output, "")
    effects = findings.effects[findings.effects["output"] == output]
    rows = [
        (str(e["factor"]), float(e["effect"]), float(e["lower"]), float(e["upper"]))
        for e in effects.to_dict(orient="records")
    ]
    strongest = sorted(rows, key=lambda row: -abs(row[1]))[:MOST_SCATTERS]
    numeric = {f.name: f for f in findings.factors if not _has_words(f)}
    indices = findings.indices
    own = None if indices is None else indices[indices["output"] == output]
    return {
        "output": output,
        "unit": unit,
        "effects": sorted(effects.to_dict(orient="records"), key=lambda row: -abs(row["effect"])),
        "tornado": tornado(rows, f"{output}: effect of each parameter", unit or "its unit"),
        "scatters": [
            _scatter(findings, output, numeric[name], unit) for name, *_ in strongest if name in numeric
        ],
        "models": [model for model in findings.models if model.output == output],
        "indices": [] if own is None else own.to_dict(orient="records"),
    }


def _scatter(findings: Findings, output: str, factor: Factor, unit: str) -> str:
    known = findings.table[findings.table[output].notna()]
    x, y = [float(v) for v in known[factor.name]], [float(v) for v in known[output]]
    axes = (_with_unit(factor.name, factor.unit), _with_unit(output, unit))
    linear = [m for m in findings.models if m.output == output and m.kind == "linear"]
    line = _line(linear[0], factor) if linear else ()
    return dots(x, y, f"{output} against {factor.name}", axes, line)


def _line(model: QuickModel, factor: Factor) -> list[tuple[float, float]]:
    """Return the linear model along one factor, the others in the middle."""
    if isinstance(factor.distribution, Levels):
        return []
    middle, slope = model.coefficients[0], model.coefficients[model.terms.index(factor.name)]
    return [(factor.distribution.low, middle - slope), (factor.distribution.high, middle + slope)]


def _range(factor: Factor) -> dict[str, str]:
    """Say how a factor varies, in words."""
    kind = factor.distribution
    unit = f" {factor.unit}" if factor.unit else ""
    if isinstance(kind, Levels):
        words = ", ".join(f"{entry}{'' if isinstance(entry, str) else unit}" for entry in kind.entries)
    else:
        words = f"{kind.low:.6g} to {kind.high:.6g}{unit}, {kind.word}"
    nominal = "–" if factor.nominal is None else f"{factor.nominal}{unit}"
    return {"name": factor.name, "range": words, "nominal": nominal}


def _with_unit(name: str, unit: str) -> str:
    return f"{name}, {unit}" if unit else name


def _has_words(factor: Factor) -> bool:
    kind = factor.distribution
    return isinstance(kind, Levels) and any(isinstance(entry, str) for entry in kind.entries)


def _is_quality(output: str) -> bool:
    return output.endswith((" %", " mm"))


def optimum_page(optimum: Optimum) -> str:
    """Return the page of an optimisation: best settings, their values, and the trade-off of two aims."""
    row = optimum.table.iloc[optimum.best]
    units = optimum.output_units
    settings = [
        {**_range(factor), "best": f"{row[factor.name]:.6g} {factor.unit}".rstrip()}
        for factor in optimum.factors
    ]
    shown = [name for name in units if name in optimum.table and not name.endswith(" margin")]
    outputs = [{"name": name, "value": float(row[name]), "unit": units[name]} for name in shown]
    return sheet(
        "optimum.html.j2",
        optimum.title,
        optimum=optimum,
        settings=settings,
        outputs=outputs,
        curve=_trade_off(optimum),
    )


def _trade_off(optimum: Optimum) -> str:
    if not optimum.curve:
        return ""
    first, second = (aim.output for aim in optimum.aims)
    rows = optimum.table[[first, second]].dropna()
    line = [
        (float(x), float(y)) for x, y in optimum.table.loc[list(optimum.curve), [first, second]].to_numpy()
    ]
    names = (
        _with_unit(first, optimum.output_units.get(first, "")),
        _with_unit(second, optimum.output_units.get(second, "")),
    )
    x, y = ([float(v) for v in rows[name]] for name in (first, second))
    return dots(x, y, "Trade-off of two aims", names, line)


def fit_page(report: dict[str, Any]) -> str:
    """Return the page of a fit, from its report (`certkit.studies.calibration.fitted_files.report`)."""
    return sheet("fit.html.j2", report["title"], fit=report)
