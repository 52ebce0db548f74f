"""Sections on the leg: the paper's Table 1 with one thing changed at a time, and the family."""

from __future__ import annotations

from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import certkit
from certkit.bench.run_family import run_family
from certkit.definitions.loading.library import load
from docs.make.markdown import figure, signed, table

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.documents.result import Comparison, Result

TABLE_1 = "inverse-seed"
FLESH = {"specimen.flesh": "fitted"}
LOOSE = {"legform.flesh.tension": "0 N"}
STRONG = {"legform.flesh.tension": "20 kN"}
FREE = {"rig.hanger.hold": "free"}
VARIANTS: dict[str, dict[str, str]] = {
    "as the procedure has it": {},
    "flesh fitted, with its tension": FLESH,
    "flesh fitted, ten times the tension": {**FLESH, **STRONG},
    "flesh fitted, without tension": {**FLESH, **LOOSE},
    "femur end not held": FREE,
    "femur end not held, flesh with tension": {**FREE, **FLESH},
    "femur end not held, flesh without tension": {**FREE, **FLESH, **LOOSE},
}
"""What is changed in the seed paper's test, by what it is called."""


def variants(tell: Callable[[str], None]) -> dict[str, Comparison]:
    """Run Table 1's test with each change alone."""
    found = {}
    for words, overrides in VARIANTS.items():
        tell(f"run {TABLE_1}, {words}")
        comparison = certkit.run(TABLE_1, overrides=overrides, refine=False).comparison
        if comparison is not None:
            found[words] = comparison
    return found


def variants_table(found: dict[str, Comparison]) -> str:
    """Return the errors of each variant against the test, and of the paper's own simulation."""
    first = next(iter(found.values()))
    rows = [
        (words, *(signed(row.error_percent) for row in each.rows), f"**{each.rms_error_percent:.1f}**")
        for words, each in found.items()
    ]
    published = [row.published_error_percent for row in first.rows]
    if first.published_rms_error_percent is not None:
        shown = ("–" if error is None else signed(error) for error in published)
        rows.append(("the paper's simulation", *shown, f"**{first.published_rms_error_percent:.1f}**"))
    return table(("error in %", *(row.channel for row in first.rows), "rms"), rows)


def prediction_table(tell: Callable[[str], None]) -> str:
    """Fit the ram's contact alone to Table 1, with the leg as it is, and leave each value out in turn."""
    tell("predict Table 1")
    with TemporaryDirectory() as folder:
        report = certkit.calibrate("seed-table-1", out=folder, processes=1).report
    rows = []
    for value in report.values if report is not None else ():
        if not isinstance(value.after, float):
            continue
        left = value.left_out
        rows.append(
            (
                value.name.partition("/")[2] or value.name,
                figure(value.aim),
                figure(value.after),
                f"{signed(100 * (value.after / value.aim - 1))} %",
                f"{signed(100 * (left / value.aim - 1))} %" if isinstance(left, float) else "–",
            )
        )
    return table(("channel", "test, N·m", "model, N·m", "error", "predicted by the other six"), rows)


def tension_sentences(found: dict[str, Comparison]) -> str:
    """Say what the flesh's tension and the hanger do, in the numbers of these runs."""
    held, strong, loose = (f"flesh fitted, {words}" for words in ("with its tension", *_OTHER_TENSIONS))
    changes = [
        _change("Leaving the tension out", found[held], found[loose]),
        _change("Ten times the tension", found[held], found[strong]),
        _change("Letting the femur end go", found["as the procedure has it"], found["femur end not held"]),
    ]
    said = [words for words, _ in changes]
    (_, without), (_, tenfold), (_, free) = changes
    if abs(free) > 5 * max(abs(without), abs(tenfold)):
        said.append("In this model it is the hold of the femur end that decides F3, not the flesh's tension.")
    return " ".join(said)


_OTHER_TENSIONS = ("ten times the tension", "without tension")


def _change(what: str, before: Comparison, after: Comparison) -> tuple[str, float]:
    """Return a sentence on F3, T4 and the rms error, and the change of F3 in per cent."""
    change = {
        a.channel: (b.simulation - a.simulation) / a.simulation * 100
        for a, b in zip(before.rows, after.rows, strict=True)
    }
    said = (
        f"{what} changes F3 by {signed(change['F3'])} %, T4 by {signed(change['T4'])} %, and the rms error "
        f"from {before.rms_error_percent:.1f} to {after.rms_error_percent:.1f} %."
    )
    return said, change["F3"]


def family_results(tell: Callable[[str], None], procedures: tuple[str, ...]) -> dict[str, Result]:
    """Run procedures over the family of the shipped leg."""
    found = {}
    for name in procedures:
        tell(f"run {name} over the family")
        found[name] = run_family(name)
    return found


def family_size() -> int:
    """Return how many legs the shipped family has."""
    return len(load("family", "flex-pli-gtr").document.members)


def family_table(found: dict[str, Result]) -> str:
    """Return each value with its spread over the family."""
    rows = []
    for name, result in found.items():
        for each in result.criteria:
            if each.spread is None or each.value is None:
                continue
            corridor = f"{each.lower:g} to {each.upper:g}" if each.graded and each.lower is not None else ""
            spread = each.spread
            rows.append(
                (
                    f"`{name}`",
                    each.id,
                    f"{figure(each.value)} {each.unit}",
                    f"{figure(spread.minimum)} to {figure(spread.maximum)}",
                    f"{spread.standard_deviation:.2g}",
                    corridor,
                )
            )
    heads = ("test", "channel", "shipped leg", "over the family", "standard deviation", "corridor")
    return table(heads, rows)
