"""Steps 2 and 3: momentum of each group, and from it the impulse and force in every load path.

For each group, the change of its momentum is what has flowed in less what has flowed out. Some flows were
recorded (contacts, springs to the ground); the others are unknown and follow from the balances, which is the
same as saying: the impulse through a cut is what all groups upstream of it have lost. Where there are more
balances than unknown flows the surplus tells how well the impulse closes; where there are fewer, recorded
contacts have to help, and if they cannot, the case is refused rather than guessed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.fe.integral import running_integral
from certkit.identification.grouping import GROUND, Graph, Link

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.exchange.fe import PartHistories
    from certkit.identification.sampling import Grid

    Values = NDArray[np.float64]

BY_MOMENTUM = "momentum upstream of the cut"
BY_CONTACT = "recorded contact"
BY_SPRING = "recorded spring"


class Closure(Struct, frozen=True):
    """How well impulse closes, by two independent sides.

    Parameters
    ----------
    title : str
        What was held against what.
    residual : float
        Largest difference in N·s.
    impulse : float
        Impulse that passed, N·s, by the side that shows more of it; above zero.
    """

    title: str
    residual: float
    impulse: float

    @property
    def percent(self) -> float:
        """Residual in per cent of the impulse that passed."""
        return 100.0 * self.residual / self.impulse


class Flow(Struct, frozen=True):
    """Impulse and force of one load path over time, positive from its first group to its second."""

    link: Link
    known_by: str
    impulse: Values
    force: Values
    recorded: Values | None
    closures: tuple[Closure, ...]


def group_momenta(graph: Graph, histories: PartHistories, grid: Grid) -> dict[str, Values]:
    """Sum the momenta of each group's parts, N·s on the uniform axis, shape (n,) each (step 2)."""
    momenta = {}
    for name, parts in graph.groups.items():
        total = np.zeros_like(grid.time)
        for part in parts:
            momentum = histories.parts[part].momentum
            if momentum is not None:
                total = total + grid.resample(momentum)
        momenta[name] = total
    return momenta


def group_masses(graph: Graph, histories: PartHistories) -> dict[str, float]:
    """Sum the initial masses of each group's parts in kg.

    Raises
    ------
    DataError
        When a part's mass stands nowhere.
    """
    masses = {}
    for name, parts in graph.groups.items():
        total = 0.0
        for part in parts:
            mass = histories.parts[part].mass
            if mass is None:
                raise DataError(
                    f"{histories.source}: the mass of part `{part}` (group `{name}`) stands nowhere; give it"
                )
            total += mass
        masses[name] = total
    return masses


def flows(graph: Graph, momenta: dict[str, Values], histories: PartHistories, grid: Grid) -> tuple[Flow, ...]:
    """Find impulse (N·s) and force (N) in every load path, shape (n,) on the uniform axis (step 3).

    The impulses J solve A·J = p(t) − p(0) with the groups' momenta p, where A (groups × paths) is −1 at the
    group that a path starts from and +1 at the one that it ends at.
    Force is dJ/dt, or that of a recorded spring.

    Raises
    ------
    DataError
        When paths branch and join again with too few recorded contacts to tell how the load divides.
    """
    contacts = {link.name: _contact_impulse(link, histories, grid) for link in graph.links if link.contacts}
    springs = {link.name: _spring_impulse(link, histories, grid) for link in graph.links if link.springs}
    recorded: dict[str, Values] = dict(springs)
    if not _determinate([link for link in graph.links if link.name not in recorded], graph):
        recorded.update(contacts)
        loose = [link for link in graph.links if link.name not in recorded]
        if not _determinate(loose, graph):
            raise DataError(
                "the balances cannot tell how the load divides between "
                f"{', '.join(link.name for link in _surplus(loose, graph))}; record a contact in one of "
                "these paths"
            )
    solved, balances = _solve(graph, momenta, recorded)
    impulses = {**recorded, **solved}
    result = []
    for link in graph.links:
        impulse = impulses[link.name]
        closures = [c for groups, c in balances if link.source in groups or link.target in groups]
        contact = contacts.get(link.name)
        if contact is not None and link.name in solved:
            title = f"{link.name}: momentum upstream against recorded contact"
            passed = float(max(np.max(np.abs(contact)), np.max(np.abs(impulse))))
            if passed > 0:  # where neither side shows an impulse, nothing closes
                closures.insert(0, Closure(title, float(np.max(np.abs(contact - impulse))), passed))
        known = BY_MOMENTUM if link.name in solved else BY_SPRING if link.springs else BY_CONTACT
        force = (
            grid.smooth(grid.resample(_spring_force(link, histories)))
            if link.springs
            else grid.derivative(impulse)
        )
        reference = None if contact is None else np.gradient(contact, grid.step)
        result.append(Flow(link, known, impulse, force, reference, tuple(closures)))
    return tuple(result)


def _contact_impulse(link: Link, histories: PartHistories, grid: Grid) -> Values:
    """Return what a path's contacts have passed on.

    A contact only pushes, so its impulse flows from the first to the second group, whatever sign the file
    gives.
    """
    total = np.zeros_like(grid.time)
    for name in link.contacts:
        impulse = grid.resample(histories.contact(name).impulse)
        impulse = impulse - impulse[0]
        largest = impulse[int(np.argmax(np.abs(impulse)))]
        total = total + (-impulse if largest < 0 else impulse)
    return total


def _spring_force(link: Link, histories: PartHistories) -> Values:
    return np.asarray(sum(histories.spring(name).force for name in link.springs))


def _spring_impulse(link: Link, histories: PartHistories, grid: Grid) -> Values:
    force = _spring_force(link, histories)
    return grid.resample(running_integral(force, histories.time))


def _incidence(links: list[Link], groups: list[str]) -> Values:
    """Return the matrix (groups × links) that turns flows into what each group receives."""
    matrix = np.zeros((len(groups), len(links)))
    for k, link in enumerate(links):
        if link.source != GROUND:
            matrix[groups.index(link.source), k] -= 1.0
        if link.target != GROUND:
            matrix[groups.index(link.target), k] += 1.0
    return matrix


def _determinate(loose: list[Link], graph: Graph) -> bool:
    return not loose or int(np.linalg.matrix_rank(_incidence(loose, list(graph.groups)))) == len(loose)


def _surplus(loose: list[Link], graph: Graph) -> list[Link]:
    """Return the paths that take part in a loop: leaving any of them out loses no rank."""
    groups = list(graph.groups)
    rank = np.linalg.matrix_rank(_incidence(loose, groups))
    return [
        link
        for link in loose
        if np.linalg.matrix_rank(_incidence([other for other in loose if other is not link], groups)) == rank
    ]


def _solve(
    graph: Graph, momenta: dict[str, Values], recorded: dict[str, Values]
) -> tuple[dict[str, Values], list[tuple[set[str], Closure]]]:
    """Solve each set of groups that unknown flows connect; a set with no way out closes a balance."""
    known = [link for link in graph.links if link.name in recorded]
    loose = [link for link in graph.links if link.name not in recorded]
    solved: dict[str, Values] = {}
    balances = []
    for groups in _connected(graph, loose):
        inside = [link for link in loose if link.source in groups or link.target in groups]
        names = sorted(groups)
        needed = np.array([momenta[g] - momenta[g][0] for g in names])
        through = np.zeros_like(needed[0])
        for link in known:
            if link.source in groups:
                needed[names.index(link.source)] += recorded[link.name]
            if link.target in groups:
                needed[names.index(link.target)] -= recorded[link.name]
            if (link.source in groups) != (link.target in groups):
                through = through + np.abs(recorded[link.name])
        if inside:
            matrix = _incidence(inside, names)
            flow = np.linalg.lstsq(matrix, needed, rcond=None)[0]
            solved.update({link.name: flow[k] for k, link in enumerate(inside)})
        if all(GROUND not in (link.source, link.target) for link in inside):
            title = f"all impulse into and out of {', '.join(names)}"
            change = float(np.max(np.abs(needed.sum(axis=0))))
            own = max(float(np.max(np.abs(momenta[g] - momenta[g][0]))) for g in names)
            passed = max(0.5 * float(np.max(through)), own)
            if passed > 0:
                balances.append((groups, Closure(title, change, passed)))
    return solved, balances


def _connected(graph: Graph, loose: list[Link]) -> list[set[str]]:
    """Return the sets of groups that unknown flows connect, in the order of the case."""
    sets: list[set[str]] = []
    left = list(graph.groups)
    while left:
        reached, edge = {left[0]}, [left[0]]
        while edge:
            group = edge.pop()
            for link in loose:
                if group in (link.source, link.target):
                    other = link.target if link.source == group else link.source
                    if other != GROUND and other not in reached:
                        reached.add(other)
                        edge.append(other)
        sets.append(reached)
        left = [name for name in left if name not in reached]
    return sets
