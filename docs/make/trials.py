"""What security.md says was tried: bombs, kills, writers, environments; each a table of what came of it."""

from __future__ import annotations

import ast
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from certkit.files import limits
from docs.make.markdown import table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Tell = Callable[[str], None]

SEED = 12


def limits_table() -> str:
    """List the bounds of `certkit/files/limits.py`, each with its reason."""
    body = ast.parse(Path(limits.__file__).read_text("utf-8")).body
    rows: list[tuple[str, str, str]] = []
    names: list[str] = []
    for statement in body:
        if isinstance(statement, ast.Assign):
            names += [target.id for target in statement.targets if isinstance(target, ast.Name)]
        elif isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant) and names:
            reason = " ".join(str(statement.value.value).split())
            rows += [(f"`{name}`", _written(name), reason) for name in names if name != "MEGABYTE"]
            names = []
    return table(("bound", "at most", "of what"), rows)


def _written(name: str) -> str:
    value = getattr(limits, name)
    return f"{value / limits.MEGABYTE:g} MB" if name.endswith("_BYTES") else f"{value:,}"


def bombs(tell: Tell) -> str:
    """Give every bomb that the tests know to its command."""
    from support.peak_memory import COMMANDS, tried  # noqa: PLC0415  # the tests' folder

    rows, most, longest = [], 0.0, 0.0
    for makers, arguments in COMMANDS:
        for make in makers:
            with tempfile.TemporaryDirectory() as folder:
                taken = tried(make, arguments, Path(folder))
            most, longest = max(most, taken.megabytes), max(longest, taken.seconds)
            said = next((line for line in taken.said.splitlines() if "error: " in line), taken.said)
            name = make.__name__.removeprefix("document_of_").replace("_", " ")
            told = _short(said.partition("error: ")[2])
            rows.append((f"`{arguments[0]}`", name, f"{taken.megabytes:.0f}", f"{taken.seconds:.1f}", told))
            tell(f"{arguments[0]} {name}: exit {taken.code}, {taken.megabytes:.0f} MB, {taken.seconds:.1f} s")
    head = (
        f"{len(rows)} bombs tried, each refused in one line; the most memory was {most:.0f} MB, the longest "
        f"took {longest:.1f} s of processor time."
    )
    return f"{head}\n\n" + table(("command", "bomb", "MB", "s", "what it says"), rows)


def kills(tell: Tell, count: int) -> str:
    """Kill each kind of command a number of times."""
    from support.kills import COMMANDS, kill_command  # noqa: PLC0415  # the tests' folder

    rows, wrong = [], 0
    for kind in COMMANDS:
        with tempfile.TemporaryDirectory() as folder:
            tally = kill_command(kind, Path(folder) / "killed", count, SEED)
        tell(f"{tally.name}: {tally.kills} kills, {len(tally.wrong)} wrong {tally.wrong}")
        rows.append((f"`{tally.name}`", str(tally.kills), str(len(tally.wrong))))
        wrong += len(tally.wrong)
    total = sum(int(row[1]) for row in rows)
    head = f"{total} kills, {wrong} of them left something half, lost, twice or behind."
    return f"{head}\n\n" + table(("command", "kills", "wrong"), rows)


def writers(tell: Tell) -> str:
    """Let 2 to 8 processes write into one logbook."""
    from support.writers import booked_by  # noqa: PLC0415  # the tests' folder

    rows = []
    for number in (2, 4, 8):
        with tempfile.TemporaryDirectory() as folder:
            booked = booked_by(number, 20, Path(folder))
        tell(f"{number} writers of 20 tests: {booked}")
        rows.append([str(figure) for figure in (number, 20, *booked)])
    return table(("writers", "tests each", "in the logbook", "ids", "documents", "in the index"), rows)


def environments(tell: Tell, pythons: Sequence[str]) -> str:
    """Make the same certificates in many environments."""
    from support.environments import ENVIRONMENTS, Environment, ids_in  # noqa: PLC0415  # the tests' folder

    every = [*ENVIRONMENTS, *(Environment(f"Python of {path}", python=path) for path in pythons)]
    rows: list[tuple[str, str, str]] = []
    usual: tuple[str, ...] = ()
    same = 0
    for each in every:
        if each.before and not shutil.which(each.before[0]):
            continue
        found: Any = ids_in(each)
        usual = usual or found.ids
        alike = found.ids == usual
        same += alike
        told = "the same" if alike else ", ".join(i for i in found.ids if i not in usual)
        rows.append((each.name if not each.python else found.versions, each.settings, told))
        tell(f"{each.name}: {told} {found.ids}")
    head = (
        f"{len(rows)} environments, {same} with the same {len(usual)} ids "
        f"({', '.join(f'`{one}`' for one in usual)})."
    )
    return f"{head}\n\n" + table(("environment", "how", "ids"), rows)


def _short(text: str, longest: int = 150) -> str:
    text = text.replace("<", "&lt;")
    return text if len(text) <= longest else f"{text[:longest]}…"
