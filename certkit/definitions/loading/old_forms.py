"""Old forms of files and old paths: read for one release, each with a remark that gives the new form.

A kind of definition that has changed names a function in `certkit.definitions.loading.kinds`. It gets the
file's plain data and returns the data in today's form and where the parts have moved to; the places of the
values and the paths of `--set` follow from that.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from certkit.definitions.loading.error_messages import plain
from certkit.definitions.loading.overrides import words_of
from certkit.definitions.loading.search_path import shipped_root
from certkit.definitions.loading.yaml_reader import Tree, read_tree
from certkit.errors import OldFormWarning

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.loading.faults import Steps
    from certkit.definitions.loading.kinds import Kind
    from certkit.definitions.loading.overrides import Overrides


class Moved(Struct, frozen=True):
    """A file's data in today's form.

    Parameters
    ----------
    data : dict
        Plain data.
    moves : mapping of steps to steps
        Where a part stood in the old form, and where it stands now; also of a file that has today's form, so
        that old paths find their way.
    remark : str
        What is old about the file; empty for a file in today's form.
    """

    data: dict[str, Any]
    moves: Mapping[Steps, Steps]
    remark: str = ""


Modernise = Callable[[dict[str, Any]], Moved]
"""Brings plain data of a kind into today's form."""


def modernised(
    kind: Kind, tree: Tree, overrides: Overrides | None = None
) -> tuple[Tree, Overrides, tuple[str, ...]]:
    """Bring a file and the changes of its values into today's form.

    Parameters
    ----------
    kind : Kind
        Of the file.
    tree : Tree
        As read.
    overrides : mapping of str to value, optional
        Values by their paths.

    Returns
    -------
    tree, overrides, remarks
        The remarks are also given as `OldFormWarning`.
    """
    if kind.modernise is None:
        return tree, overrides or {}, ()
    modernise: Modernise = kind.modernise
    moved, prefix = modernise(tree.data), kind.prefix
    remarks = [f"{tree.file}: {moved.remark}"] if moved.remark else []
    if moved.remark:
        places = [
            {_new(steps, moved.moves): at for steps, at in held.items()} for held in (tree.values, tree.keys)
        ]
        tree = replace(tree, data=moved.data, values=places[0], keys=places[1])
    changed: dict[str, object] = {}
    for path, value in (overrides or {}).items():
        today = _today(path.strip(), moved.moves)
        if today is not None:
            remarks.append(f"`{prefix}{path.strip()}` is an old path; write `{prefix}{today}`")
        changed[path if today is None else today] = value
    for remark in remarks:
        warnings.warn(remark, OldFormWarning, stacklevel=2)
    return tree, changed, tuple(remarks)


def path_of_today(kind: Kind, text: str, file: str, path: str) -> str:
    """Return today's path of a value in a file; an old one is told by a warning.

    Parameters
    ----------
    kind : Kind
        Of the file.
    text, file : str
        What it says, in an old form or today's, and its name for messages.
    path : str
        Inside the file, without the kind before it: `femur.mass`, `parts.femur.mass`.

    Raises
    ------
    UsageError
        When there is no such value; names the nearest one.
    """
    tree, paths, _ = modernised(kind, read_tree(text.encode(), file), {path: None})
    return words_of(next(iter(paths)), tree.data, kind.model)


def _new(steps: Steps, moves: Mapping[Steps, Steps]) -> Steps:
    for end in range(len(steps), 0, -1):
        if steps[:end] in moves:
            return (*moves[steps[:end]], *steps[end:])
    return steps


def _today(path: str, moves: Mapping[Steps, Steps]) -> str | None:
    """Return today's path of an old one, or None."""
    flat = plain(path)
    near = [move for move in moves.items() if flat.startswith(plain(str(move[0][0])))]
    for old, new in sorted(near, key=lambda move: -len(move[0])):
        start = ".".join(str(step + 1) if isinstance(step, int) else step for step in old)
        if flat == plain(start) or flat.startswith(f"{plain(start)}."):
            return ".".join(str(step) for step in new) + flat[len(plain(start)) :]
    return None


def vehicle(data: dict[str, Any]) -> Moved:
    """Springs had no names: `connections` was a list, and a path held a position in it."""
    springs, listed = data.get("springs"), data.get("connections")
    if isinstance(springs, dict) or not isinstance(listed, list):
        names = list(springs) if isinstance(springs, dict) else []
        return Moved(data, {("connections", i): ("springs", name) for i, name in enumerate(names)})
    names = spring_names([entry.get("between") if isinstance(entry, dict) else None for entry in listed])
    named = dict(zip(names, listed, strict=True))
    moves: dict[Steps, Steps] = {("connections",): ("springs",)}
    moves |= {("connections", i): ("springs", name) for i, name in enumerate(names)}
    today = {("springs" if key == "connections" else key): value for key, value in data.items()}
    example = f", such as `{names[0]}: {{…}}`" if names else ""
    remark = f"`connections` is an old form; write `springs:` with a name before each{example}"
    return Moved({**today, "springs": named}, moves, remark)


def spring_names(ends: Sequence[object]) -> list[str]:
    """Name springs by what they lie between: `F1 to E1`; a second one of the same ends is `F1 to E1, 2`."""
    names: list[str] = []
    for pair in ends:
        base = " to ".join(map(str, pair)) if isinstance(pair, (list, tuple)) else f"spring {len(names) + 1}"
        name, number = base, 2
        while name in names:
            name, number = f"{base}, {number}", number + 1
        names.append(name)
    return names


def legform(data: dict[str, Any]) -> Moved:
    """Parts stood at the top, gauges in a section of their own; all had the shipped legform's channels."""
    known = data.get("channels")
    moves: dict[Steps, Steps] = {(part,): ("parts", part) for part in ("femur", "tibia")}
    if "parts" in data or not {"femur", "tibia"} & set(data):
        named = known if isinstance(known, dict) else {}
        moves |= {("gauges", name): ("channels", name, "from knee centre") for name in named}
        return Moved(data, moves)
    shipped = _shipped_legform()
    given = data.get("gauges")
    gauges: dict[str, Any] = given if isinstance(given, dict) else {}
    origin: Any = gauges.get("origin")
    channels: dict[str, Any] = {name: dict(channel) for name, channel in shipped["channels"].items()}
    for name, place in gauges.items():
        if name in channels:
            bare = isinstance(origin, dict) and not isinstance(place, dict)
            channels[name]["from knee centre"] = {"value": place} | origin if bare else place
            moves["gauges", name] = ("channels", name, "from knee centre")
    knee = data.get("knee")
    today = {
        "impactor": shipped["impactor"],
        "fine location": shipped["fine location"],
        **{key: value for key, value in data.items() if key not in {"femur", "tibia", "gauges", "knee"}},
        "parts": {part: data[part] for part in ("femur", "tibia") if part in data},
        "knee": {"between": ["femur", "tibia"]} | knee if isinstance(knee, dict) else knee,
        "channels": channels,
        "evaluation": shipped["evaluation"],
    }
    remark = (
        "`femur`, `tibia` and `gauges` are an old form; write the bones under `parts:`, from the top down, "
        f"and the gauges under `channels:`, as in the shipped legform `{shipped['legform']}`"
    )
    return Moved(today, moves, remark)


def _shipped_legform() -> dict[str, Any]:
    path = shipped_root() / "models" / "legforms" / "flex-pli-gtr.yaml"
    return read_tree(path.read_bytes(), path.name).data
