"""Step 4: displacement of each group and shortening of each path.

The leg bends to the shape of the fascia's front, so a fascia group moves with its front face; every other
group moves with its centre of gravity.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.identification.grouping import GROUND, Graph, Link
from certkit.identification.part_groups import nodes_in

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import Case, CaseGroup
    from certkit.exchange.fe import PartHistories
    from certkit.identification.sampling import Grid

    Values = NDArray[np.float64]


def group_displacements(case: Case, graph: Graph, histories: PartHistories, grid: Grid) -> dict[str, Values]:
    """Return each group's displacement along x, m, shape (n,); zero where no path needs it.

    Raises
    ------
    DataError
        When the front of a fascia group or the centre of gravity of another was not recorded.
    """
    moved = {}
    needed = {end for link in graph.links if link.law for end in (link.source, link.target)}
    for name, group in case.groups.items():
        rule = group.moves_with
        if name not in needed:
            moved[name] = np.zeros_like(grid.time)
            continue
        if group.moves_with_box is not None:
            rule = nodes_in(group.moves_with_box, histories, name)
        if isinstance(rule, list):
            moved[name] = np.mean([grid.resample(histories.node(node)) for node in rule], axis=0)
        else:
            wanted = rule or ("front" if group.kind == "fascia" else "centre of gravity")
            moved[name] = _of_parts(name, group, graph.groups[name], wanted, histories, grid)
    return moved


def _of_parts(
    name: str, group: CaseGroup, parts: tuple[str, ...], wanted: str, histories: PartHistories, grid: Grid
) -> Values:
    values, weights = [], []
    for part in parts:
        history = histories.parts[part]
        moved = history.front if wanted == "front" else history.displacement
        if moved is None:
            raise DataError(
                f"{histories.source}: group `{name}` ({group.kind}) moves with its {wanted}, which was not "
                "recorded for "
                f"part `{part}`; name nodes under `moves with`"
            )
        values.append(grid.resample(moved))
        weights.append(history.mass if history.mass is not None and len(parts) > 1 else 1.0)
    return np.average(values, axis=0, weights=weights)


def shortening(link: Link, displacements: dict[str, Values]) -> Values:
    """Return u₁ − u₂, by how much the first group has come nearer to the second, m, shape (n,)."""
    source = displacements[link.source]
    return source if link.target == GROUND else source - displacements[link.target]
