"""What no single value can show: fixtures that cannot go together, criteria without a channel.

The checks look at the file as read, so that they report beside whatever else is wrong with it; odd values are
passed over here because the document itself reports them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from certkit.definitions.base import words
from certkit.definitions.fixture_list import FIXTURES
from certkit.definitions.legform import WHOLE
from certkit.definitions.loading.channel_tables import DEFAULT_LEGFORM, default_channels
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.field_types import fields
from certkit.definitions.loading.library import load
from certkit.definitions.loading.search_path import is_name
from certkit.definitions.measures import MEASURES
from certkit.definitions.procedure import Criterion
from certkit.definitions.units import parse_quantity
from certkit.errors import CertkitError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.fixtures.fixture import Fixture
    from certkit.definitions.legform import Legform
    from certkit.definitions.loading.faults import Steps
    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.yaml_reader import Tree
    from certkit.errors import Problem

Finding = tuple["Steps", str]


def check_procedure(tree: Tree, library: Library = ()) -> list[Problem]:
    """Check fixtures, specimen and criteria, by the parts and channels of the legform that is named."""
    data = tree.data
    legform = _legform(data, library)
    channels = legform.channel_table if legform else default_channels()
    values = [*_criteria(data.get("criteria"), channels), *_quantities(data.get("preconditions"))]
    values += [(steps, said) for steps, said in _names(data) if steps not in tree.changed]
    values += _places(data, legform) if legform else []
    found = [tree.problem(steps, message, key=True) for steps, message in _fixtures(data)]
    return found + [tree.problem(steps, message) for steps, message in values]


def check_vehicle(tree: Tree, library: Library = ()) -> list[Problem]:  # noqa: ARG001  # one signature
    """Check that springs lie between groups of this vehicle."""
    groups, springs = tree.data.get("groups"), tree.data.get("springs")
    if not isinstance(groups, dict) or not isinstance(springs, dict):
        return []
    known = ["ground", *groups]
    found: list[Finding] = []
    for name, spring in springs.items():
        ends = spring.get("between") if isinstance(spring, dict) else None
        if not isinstance(ends, list):
            continue
        steps: Steps = ("springs", name, "between")
        found += [
            ((*steps, i), f"there is no group `{end}`; {suggestion(str(end), known)}")
            for i, end in enumerate(ends)
            if end not in known
        ]
        if len(ends) == 2 and ends[0] == ends[1]:
            found.append((steps, f"both ends are `{ends[0]}`; a spring lies between two groups"))
    return [tree.problem(where, message) for where, message in found]


def check_reference(tree: Tree, library: Library = ()) -> list[Problem]:  # noqa: ARG001  # one signature
    """Check that values have their channel's unit, and that published ones stand beside measured ones.

    Values go by criterion ids. Those of the shipped legform's channels are checked; what another legform
    measures under other names shows when it is compared.
    """
    channels = default_channels()
    found: list[Finding] = []
    values = tree.data.get("values")
    for key in ("values", "published"):
        given = tree.data.get(key)
        for name, text in given.items() if isinstance(given, dict) else ():
            if key == "published" and isinstance(values, dict) and name not in values:
                message = f"`{name}` has no value to stand beside; {suggestion(name, list(values))}"
                found.append(((key, name), message))
            elif name in channels.kinds and isinstance(text, str):
                found += [((key, name), said) for said in _unfit(text, name, channels)]
    return [tree.problem(where, message) for where, message in found]


def _fixtures(data: dict[str, Any]) -> Iterator[Finding]:
    given = data.get("rig")
    if not isinstance(given, dict):
        return
    rig = [words(name) for name, fixture in given.items() if fixture is not None and name != "origin"]
    if not rig:
        yield ("rig",), "holds no fixture; name at least one, such as `hinge` or `supports`"
    fixtures = [kind for kind in FIXTURES if kind.name() in rig]
    for kind in fixtures:
        for other in kind.excludes:
            if other in rig:
                yield ("rig", other), f"`{kind.name()}` and `{other}` cannot be on the same rig; keep one"
        for needed in kind.needs:
            if needed not in rig:
                yield ("rig", kind.name()), f"`{kind.name()}` does nothing without `{needed}`; add it"
    yield from _specimen(data, fixtures)
    yield from _conditions(data, fixtures)


def _specimen(data: dict[str, Any], fixtures: list[type[Fixture]]) -> Iterator[Finding]:
    specimen = data.get("specimen")
    part = specimen.get("part", "leg") if isinstance(specimen, dict) else "leg"
    taking = [kind for kind in fixtures if kind.takes_part]
    if part == "leg" and taking:
        yield (
            ("rig", taking[0].name()),
            f"`{taking[0].name()}` takes no whole leg; set `part` of the specimen",
        )
    if isinstance(part, str) and part != "leg" and not taking:
        needed = " and ".join(f"`{kind.name()}`" for kind in FIXTURES if kind.takes_part)
        yield ("specimen", "part"), f"a {part} alone needs {needed} on the rig"
    hitting = [kind.name() for kind in FIXTURES if kind.hits_vehicle]
    hits = [kind for kind in fixtures if kind.hits_vehicle]
    if hits and data.get("vehicle") is None:
        yield ("rig", hits[0].name()), f"`{hits[0].name()}` hits a vehicle; name it with `vehicle`"
    if not hits and data.get("vehicle") is not None:
        named = " or ".join(f"`{name}`" for name in hitting)
        yield ("vehicle",), f"a vehicle is hit in {named} only; add that, or leave the vehicle out"


def _conditions(data: dict[str, Any], fixtures: list[type[Fixture]]) -> Iterator[Finding]:
    """Refuse preconditions on a fixture that is not there: no test could ever meet them."""
    given = data.get("preconditions")
    for index, asked in enumerate(given if isinstance(given, list) else ()):
        quantity = asked.get("quantity") if isinstance(asked, dict) else None
        owners = [kind for kind in FIXTURES if quantity in kind.conditions]
        if owners and not any(kind in fixtures for kind in owners):
            named = " or ".join(f"`{kind.name()}`" for kind in owners)
            yield (
                ("preconditions", index),
                (
                    f"`{quantity}` is a condition of {named}, which is not on the rig"
                    "; leave it out, or add the fixture"
                ),
            )


def _legform(data: dict[str, Any], library: Library) -> Legform | None:
    """Return the legform that a procedure names; None where there is no such one, which is told elsewhere."""
    specimen = data.get("specimen")
    name = specimen.get("legform", DEFAULT_LEGFORM) if isinstance(specimen, dict) else DEFAULT_LEGFORM
    if not isinstance(name, str) or not is_name(name):
        return None
    try:
        return load("legform", name, library=library).document
    except CertkitError:
        return None


def _places(data: dict[str, Any], legform: Legform) -> Iterator[Finding]:
    """Check that the specimen is a part of the legform, and that fixtures are at its ends."""
    specimen, rig = data.get("specimen"), data.get("rig")
    part = specimen.get("part") if isinstance(specimen, dict) else None
    known = [WHOLE, *legform.chain]
    if isinstance(part, str) and part not in known:
        yield ("specimen", "part"), f"`{legform.legform}` has no part `{part}`; {suggestion(part, known)}"
    ends = legform.ends
    for name, fixture in rig.items() if isinstance(rig, dict) else ():
        at = fixture.get("at") if isinstance(fixture, dict) else None
        if isinstance(at, str) and at not in ends:
            yield ("rig", name, "at"), f"`{at}` is no end of the leg; {suggestion(at, ends)}"


def _names(data: dict[str, Any]) -> Iterator[Finding]:
    """Refuse paths where a file names other definitions: names are looked for in the libraries only."""
    specimen = data.get("specimen")
    named: list[tuple[Steps, Any]] = [((key,), data.get(key)) for key in ("vehicle", "reference", "score")]
    named.append((("specimen", "legform"), specimen.get("legform") if isinstance(specimen, dict) else None))
    criteria = data.get("criteria")
    for index, criterion in enumerate(criteria if isinstance(criteria, list) else ()):
        corridor = criterion.get("corridor") if isinstance(criterion, dict) else None
        if isinstance(corridor, str) and "/" in corridor:
            named.append((("criteria", index, "corridor"), corridor.partition("/")[0]))
    for steps, name in named:
        if isinstance(name, str) and not is_name(name):
            yield steps, f"`{name}` is no name; write it without folders and ending"


def _criteria(criteria: Any, channels: ChannelTable) -> Iterator[Finding]:  # noqa: ANN401  # raw YAML data
    seen: set[str] = set()
    for index, criterion in enumerate(criteria if isinstance(criteria, list) else ()):
        if not isinstance(criterion, dict):
            continue
        steps: Steps = ("criteria", index)
        name = criterion.get("id")
        if isinstance(name, str) and name in seen:
            yield (
                (*steps, "id"),
                f"`{name}` is the id of a criterion already; ids are unique; give this one another",
            )
        seen.add(str(name))
        yield from (((*steps, *way), said) for way, said in _criterion(criterion, channels))


def _criterion(criterion: dict[str, Any], channels: ChannelTable) -> Iterator[Finding]:
    measure, channel, curve = (criterion.get(key) for key in ("measure", "channel", "curve"))
    misspelt = set(criterion) - set(fields(Criterion))
    if isinstance(measure, str) and measure in MEASURES and not misspelt:
        forms = {"curve": "a `curve: {x: …, y: …}` of two channels", "at": "`at: {channel: …, equals: …}`"}
        for key in MEASURES[measure].needs:
            if criterion.get(key) is None:
                form = forms.get(key) or f"a `channel`; {suggestion('', list(channels.kinds))}"
                yield ("measure",), f"`{measure}` needs {form}"
    yield from _channel(("channel",), channel, channels)
    if isinstance(curve, dict):
        for axis in ("x", "y"):
            yield from _channel(("curve", axis), curve.get(axis), channels)
    at = criterion.get("at")
    if isinstance(at, dict):
        yield from _channel(("at", "channel"), at.get("channel"), channels)
        if isinstance(at.get("channel"), str) and isinstance(at.get("equals"), str):
            yield from ((("at", "equals"), said) for said in _unfit(at["equals"], at["channel"], channels))
    corridor = criterion.get("corridor")
    if isinstance(corridor, str) and not all(corridor.partition("/")):
        yield ("corridor",), f"`{corridor}` has to be written set/entry, such as `r127-pendulum/T1`"


def _channel(steps: Steps, name: Any, channels: ChannelTable) -> Iterator[Finding]:  # noqa: ANN401  # raw YAML data
    if isinstance(name, str) and channels.find(name) is None:
        known = [word for kind in channels.kinds.values() for word in (kind.name, kind.title)]
        yield steps, f"no channel is called `{name}`; {suggestion(name, known)}"


def _unfit(text: str, channel: str, channels: ChannelTable) -> Iterator[str]:
    """Yield what is wrong with a quantity that should be one of the channel's."""
    kind = channels.find(channel)
    if kind is None:
        return
    try:
        parse_quantity(text, kind.dimension.quantity)
    except ValueError as error:
        yield f"{error}, which is what {kind.title} is"


def _quantities(preconditions: Any) -> Iterator[Finding]:  # noqa: ANN401  # raw YAML data
    seen: set[str] = set()
    for index, condition in enumerate(preconditions if isinstance(preconditions, list) else ()):
        name = condition.get("quantity") if isinstance(condition, dict) else None
        if isinstance(name, str) and name in seen:
            yield ("preconditions", index, "quantity"), f"`{name}` is a precondition already; keep one"
        seen.add(str(name))
