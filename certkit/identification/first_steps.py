"""Steps 1 to 4 in their order: groups, momenta, forces, displacements, and the faces' outlines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.fe.plausible_nodes import require_same_run
from certkit.identification.balance import Flow, flows, group_masses, group_momenta
from certkit.identification.displacement import group_displacements
from certkit.identification.folding_outlines import FoldingOutlines, folding_outlines
from certkit.identification.grouping import Graph, build_graph
from certkit.identification.sampling import Grid, make_grid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import Case
    from certkit.exchange.fe import FrontData

    Values = NDArray[np.float64]

CARRIES = 5e-4
"""A path that passes less than this share of the largest impulse is left out."""


class FirstSteps(Struct, frozen=True):
    """Results of the first four steps."""

    case: Case
    data: FrontData
    graph: Graph
    grid: Grid
    momenta: dict[str, Values]
    masses: dict[str, float]
    flows: tuple[Flow, ...]
    displacements: dict[str, Values]
    outlines: dict[str, FoldingOutlines]

    @property
    def carrying(self) -> tuple[Flow, ...]:
        """Return the paths that carry something: more than `CARRIES` of the largest impulse."""
        largest = max(float(np.max(np.abs(flow.impulse))) for flow in self.flows)
        return tuple(f for f in self.flows if float(np.max(np.abs(f.impulse))) >= CARRIES * largest > 0)


def first_steps(case: Case, data: FrontData) -> FirstSteps:
    """Take the steps for a case.

    Raises
    ------
    DataError
        For anything missing or contradictory in its data.
    """
    histories = data.histories
    graph = build_graph(case, histories)
    window = None if case.settings.smoothing is None else float(case.settings.smoothing)
    until = None if case.settings.until is None else float(case.settings.until)
    grid = make_grid(histories.time, window=window, until=until)
    momenta = group_momenta(graph, histories, grid)
    if not any(np.any(np.abs(p - p[0]) > 1e-9) for p in momenta.values()):
        raise DataError(
            f"{histories.source}: no group's momentum ever changes; the histories end before the impact"
            "; let the run go on, or correct `until`"
        )
    for name, group in case.groups.items():
        if group.kind == "impactor" and momenta[name][0] < 0:
            raise DataError(
                f"{histories.source}: the impactor `{name}` moves towards -x, but +x leads into the car; "
                "turn the sign of everything along x: momenta, impulses, forces, displacements, places"
            )
    if data.motion is not None:
        require_same_run(data.motion, histories, data.faces)
    moved = group_displacements(case, graph, histories, grid)
    kinds = {name: group.kind for name, group in case.groups.items()}
    return FirstSteps(
        case,
        data,
        graph,
        grid,
        momenta,
        group_masses(graph, histories),
        flows(graph, momenta, histories, grid),
        moved,
        {} if data.motion is None else folding_outlines(graph, kinds, data.motion, moved, grid),
    )


def missing_impactor(steps: FirstSteps) -> list[str]:
    """Warn of a case whose impactor is not called one: nothing would be held to its run."""
    if any(group.kind == "impactor" for group in steps.case.groups.values()):
        return []
    begun = {name: abs(float(p[0])) for name, p in steps.momenta.items()}
    fastest = max(begun, key=lambda name: begun[name])
    if begun[fastest] <= 0:
        return []
    said = f"{fastest}: moves at the start and is no impactor, so the front is not held to its run"
    return [f"{said}; write `kind: impactor`"]
