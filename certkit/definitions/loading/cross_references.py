"""Whether a procedure agrees with the definitions it names: they exist, have the entries, the units fit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.definitions.corridor_set import Band, CorridorSet, Polygon, ValueWindow
from certkit.definitions.loading.channel_tables import default_channels, legform_channels
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import find, load
from certkit.definitions.measures import MEASURES
from certkit.definitions.units import parse_quantity
from certkit.errors import DefinitionError, UsageError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.loading.faults import Fault
    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.yaml_reader import Tree
    from certkit.definitions.procedure import Criterion, Procedure
    from certkit.errors import Problem


def disagreements(procedure: Procedure, tree: Tree, library: Library = ()) -> list[Problem]:
    """Find what a procedure names and cannot use.

    Parameters
    ----------
    procedure : Procedure
        The document.
    tree : Tree
        Its file, for the places.
    library : sequence of Path or DefinitionStore
        Searched first for what it names.

    Returns
    -------
    list of Problem
        Empty when everything fits together.
    """
    found = [*_names(procedure, library), *_corridors(procedure, library), *_score(procedure, library)]
    return [tree.problem(steps, message) for steps, message in found]


def _names(procedure: Procedure, library: Library) -> Iterator[Fault]:
    named = [
        ("legform", ("specimen", "legform"), procedure.specimen.legform),
        ("vehicle", ("vehicle",), procedure.vehicle),
        ("reference", ("reference",), procedure.reference),
    ]
    for kind, steps, name in named:
        if name is None:
            continue
        try:
            find(KINDS[kind], name, library)
        except UsageError as error:
            yield steps, str(error)


def _corridors(procedure: Procedure, library: Library) -> Iterator[Fault]:
    sets: dict[str, CorridorSet | str] = {}
    channels = legform_channels(procedure.specimen.legform, library)
    for index, criterion in enumerate(procedure.criteria):
        if criterion.corridor is None:
            continue
        steps = ("criteria", index, "corridor")
        name, _, entry = criterion.corridor.partition("/")
        known = sets.setdefault(name, _set(name, library))
        if isinstance(known, str):
            yield steps, known
        elif entry not in known.entries:
            yield steps, f"the set `{name}` has no `{entry}`; {suggestion(entry, known.entries)}"
        else:
            yield from ((steps, said) for said in _unfit(criterion, known.entry(entry), channels))


def _set(name: str, library: Library) -> CorridorSet | str:
    """Return a corridor set, or why there is none."""
    try:
        return load("corridors", name, library=library).document
    except UsageError as error:
        return str(error)
    except DefinitionError as error:
        return f"the set `{name}` has errors of its own: {error.problems[0]}"


def _unfit(
    criterion: Criterion, corridor: ValueWindow | Polygon | Band | None, channels: ChannelTable
) -> Iterator[str]:
    """Yield why a criterion cannot be held against its corridor; an awaited one always fits."""
    if corridor is None:
        return
    wanted = MEASURES[criterion.measure].corridor
    if not isinstance(corridor, wanted):
        yield f"is a {corridor.noun}, but `{criterion.measure}` is held against a {wanted.noun}"
    elif isinstance(corridor, Polygon):
        for axis in ("x", "y"):
            drawn, asked = (channels.find(getattr(side, axis, "")) for side in (criterion.curve, corridor))
            if drawn != asked:
                title = asked.title if asked else getattr(corridor, axis)
                yield f"has {title} on its {axis} axis; the criterion's curve has another channel there"
    elif isinstance(corridor, ValueWindow):
        kind = channels.find(criterion.channel or "")
        quantity = MEASURES[criterion.measure].quantity or (kind.dimension.quantity if kind else None)
        for text in (corridor.lower, corridor.upper):
            if text is not None and quantity is not None:
                yield from _wrong_unit(text, quantity)


def _wrong_unit(text: str, quantity: str) -> Iterator[str]:
    try:
        parse_quantity(text, quantity)
    except ValueError as error:
        yield f"does not fit the criterion's channel: {error}"


def _score(procedure: Procedure, library: Library) -> Iterator[Fault]:
    if procedure.score is None:
        return
    known = _set(procedure.score, library)
    if isinstance(known, str):
        yield ("score",), known
    elif not known.scores:
        yield ("score",), f"the set `{procedure.score}` has no scores; name another, or leave it out"
    else:
        impactor = legform_channels(procedure.specimen.legform, library).impactor
        if (known.impactor or default_channels().impactor) != impactor:
            message = (
                f"the set `{procedure.score}` is for the {known.impactor}, not for the {impactor}"
                "; name another set, or leave `score` out"
            )
            yield ("score",), message
