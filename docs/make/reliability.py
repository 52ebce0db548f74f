"""Writes docs/reliability.md: how many damaged inputs were tried, and what came of them."""

from __future__ import annotations

import platform
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

ROOT = Path(__file__).parents[2]

HEAD = """# Reliability

A certificate is worth what the bench refuses. So certkit is tried on inputs that are damaged on purpose,
{tried} of them for this page, made from the shipped measured pendulum test, its mapping, laboratory file,
procedure, corridors, result document and certificate, and from the shipped simple bumper's histories.
`python -m docs.make reliability` makes the damages of a seed, tries them and writes this page; `--seed`
takes another one, `--every 1` tries all there are. Continuous integration tries a part of the fixed seed
each time, and more of it by night.

What is done to them: records that end or begin at every few milliseconds; channels that are frozen,
dropped, clipped (with and without noise), inverted, swapped, shifted, scaled by powers of ten, or that
overflow; cells that are no numbers; wrong counts; words that contradict each other; every line of every
header and definition emptied, garbled, halved, lost, doubled, made endless, given control characters or
another encoding; cut, lost and flipped bytes.

The oracle knows the intact input's graded values. A damaged input is

- **refused** when it ends with an error (exit code 2) or a verdict that is no pass,
- **unchanged** when it passes with the graded values of the intact one, to a hundredth: the damage touches
  nothing that is graded,
- **remarked** when a graded value changed, and a remark or note says what was seen,
- **silently passed** when a graded value changed and nothing says so. That must not happen, nor may a
  Python traceback, nor another exit code than 2 for an input that cannot be read.

Left out is what no file can show: a factor of a few per cent, and [larger ones](how-to/grade.md) where there
is an upper limit only; two channels exchanged whose corridors both
hold either, another number that is as good as the first.

"""


def reliability(seed: int | None, every: int, tell: Callable[[str], None]) -> str:
    """Try the variants of a seed and return the page.

    Parameters
    ----------
    seed : int, optional
        The fixed one of continuous integration when missing.
    every : int
        Every which variant of the recordings and definitions is tried; of the others all.
    tell : callable
        Told what went wrong, as it is found.
    """
    sys.path.insert(0, str(ROOT / "tests"))
    from support.damaged_inputs.corpus import FORMATS, SEED, counted, tried  # noqa: PLC0415  # not installed
    from support.damaged_inputs.variant import BAD, Outcome  # noqa: PLC0415  # likewise

    found = []
    seed = SEED if seed is None else seed
    for item in tried(seed, every=dict.fromkeys(("ISO-MME", "CSV", "YAML", "JSON"), every)):
        found.append(item)
        if item.outcome in BAD:
            tell(f"{item.outcome.value}: {item.variant.format}, {item.variant.kind}: {item.variant.name}")
    counts = counted(found)
    columns = [outcome.value for outcome in Outcome]
    rows = []
    for name in FORMATS:
        kinds = {kind: count for (form, kind), count in counts.items() if form == name}
        total: Counter[Outcome] = sum(kinds.values(), Counter())
        rows.append(_row(f"**{name}**", total, Outcome))
        rows += [_row(kind, count, Outcome) for kind, count in sorted(kinds.items())]
    rows.append(_row("**all**", sum(counts.values(), Counter()), Outcome))
    table = ["| | tried | " + " | ".join(columns) + " |", "|---|" + "---:|" * (len(columns) + 1), *rows]
    text = HEAD.format(tried=f"{len(found):,}") + "\n".join(table) + "\n"
    text += (
        f"\nSeed {seed}, every {every}th of recordings and documents, Python {platform.python_version()}.\n"
    )
    wrong = [item for item in found if item.outcome in BAD]
    if wrong:
        text += "\n## Open\n\n"
        text += "".join(
            f"- {item.outcome.value}: {item.variant.format}, {item.variant.kind}: {item.variant.name}\n"
            for item in wrong
        )
    return text


def _row(name: str, count: Counter[object], outcomes: Iterable[object]) -> str:
    cells = [str(sum(count.values())), *(str(count[outcome]) for outcome in outcomes)]
    return f"| {name} | " + " | ".join(cells) + " |"
