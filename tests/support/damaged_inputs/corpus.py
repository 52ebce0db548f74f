"""The corpus: all variants of a seed, or every so many of them, tried one after the other."""

from __future__ import annotations

import tempfile
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import certkit
from support.damaged_inputs.definition_files import yaml_variants
from support.damaged_inputs.fe_files import binout_variants, converted_variants, native_variants
from support.damaged_inputs.measured_files import (
    PROCEDURE,
    csv_variants,
    mme,
    mme_variants,
    shipped_recording,
)
from support.damaged_inputs.result_files import json_variants, pdf_variants
from support.damaged_inputs.variant import Judged, Outcome, judged

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from support.damaged_inputs.variant import Variant

SEED = 20261128
"""The fixed seed of continuous integration."""

FORMATS = ("ISO-MME", "CSV", "YAML", "JSON", "PDF", "T01", "converted CSV", "binout")


def variants(seed: int, folder: Path, formats: Sequence[str] = FORMATS) -> Iterator[Variant]:
    """Yield all variants of a seed; what is intact is written below `folder`."""
    recording = shipped_recording()
    makers: dict[str, Callable[[np.random.Generator, Path], Iterable[Variant]]] = {
        "ISO-MME": lambda c, f: mme_variants(recording, c, f),
        "CSV": lambda c, f: csv_variants(recording, c, f),
        "YAML": lambda _c, f: yaml_variants(recording, f),
        "JSON": lambda c, f: json_variants(_graded(f), c, 30),
        "PDF": lambda c, f: pdf_variants(_graded(f), f, c, 20),
        "T01": lambda c, f: native_variants(c, 12, f),
        "converted CSV": lambda c, f: converted_variants(c, 6, f),
        "binout": lambda c, f: binout_variants(c, 12, f),
    }
    for number, name in enumerate(FORMATS):
        if name in formats:
            place = folder / f"intact {number}"
            place.mkdir()
            yield from makers[name](np.random.default_rng([seed, number]), place)


def _graded(folder: Path) -> certkit.Result:
    for path, text in mme(shipped_recording()).texts.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    return certkit.grade(PROCEDURE, folder / "leg")


def tried(
    seed: int, *, formats: Sequence[str] = FORMATS, every: dict[str, int] | None = None
) -> Iterator[Judged]:
    """Try the variants of a seed.

    Parameters
    ----------
    seed : int
    formats : sequence of str
        Those of `FORMATS` that are wanted.
    every : dict of str to int
        By format, every which variant is tried; all where it is missing. Which one is first, the seed says.
    """
    seen: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="damaged-") as name:
        top = Path(name)
        for number, variant in enumerate(variants(seed, top, formats)):
            seen[variant.format] += 1
            step = (every or {}).get(variant.format, 1)
            if (seen[variant.format] + seed) % step:
                continue
            folder = top / f"{number}"
            folder.mkdir()
            yield judged(variant, folder)


def counted(found: Iterable[Judged]) -> dict[tuple[str, str], Counter[Outcome]]:
    """Count the outcomes by format and kind."""
    counts: dict[tuple[str, str], Counter[Outcome]] = {}
    for item in found:
        counts.setdefault((item.variant.format, item.variant.kind), Counter())[item.outcome] += 1
    return counts
