"""What a command took: processor time, and the most memory it held at once."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from multiprocessing import get_context
from pathlib import Path
from typing import NamedTuple

from support import bombs

LONGEST = 120.0
"""Seconds after which a command counts as hanging."""


class Taken(NamedTuple):
    """A finished command: exit code, processor seconds, peak of memory in MB, standard error."""

    code: int
    seconds: float
    megabytes: float
    said: str


LAUNCHER = (
    "import json, os, subprocess, sys\n"
    "null = subprocess.DEVNULL\n"
    "child = subprocess.Popen(sys.argv[1:], stdin=null, stdout=null, stderr=subprocess.PIPE)\n"
    "said = child.stderr.read()\n"
    "_, status, usage = os.wait4(child.pid, 0)\n"
    "code = os.waitstatus_to_exitcode(status)\n"
    "seconds = usage.ru_utime + usage.ru_stime\n"
    "print(json.dumps([code, seconds, usage.ru_maxrss / 1000, said.decode(errors='replace')]))"
)
"""A small process that starts the command: a child's peak begins at the size of its parent."""


def taken(arguments: list[str], folder: Path) -> Taken:
    """Run certkit in a process of its own and look at what it took."""
    command = ["timeout", str(LONGEST), sys.executable, "-m", "certkit", *arguments]
    done = subprocess.run(
        [sys.executable, "-S", "-c", LAUNCHER, *command],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return Taken(*json.loads(done.stdout))


COMMANDS: tuple[tuple[tuple[Callable[[Path], Path], ...], tuple[str, ...]], ...] = (
    (bombs.GRADED, ("grade", "--procedure", "pendulum", "FILE", "--out", "out")),
    (bombs.REPORTED, ("report", "FILE", "--out", "out")),
    (bombs.VALIDATED, ("run", "FILE", "--out", "out")),
    (bombs.EXTRACTED, ("extract", "case.yaml", "--out", "out")),
)
"""Bombs, and the command that is given each."""


def tried(make: Callable[[Path], Path], arguments: tuple[str, ...], folder: Path) -> Taken:
    """Make a bomb and give it to its command."""
    # In a process of its own: the memory of this one would count for the command as well.
    maker = get_context("fork").Process(target=make, args=(folder,))
    maker.start()
    maker.join()
    others = {"case.yaml"}
    (file,) = (path for path in folder.iterdir() if path.name not in others)
    return taken([file.name if word == "FILE" else word for word in arguments], folder)
