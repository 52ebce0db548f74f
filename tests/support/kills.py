"""Commands that are killed at random moments, and what is wrong afterwards."""

from __future__ import annotations

import io
import json
import os
import random
import signal
import subprocess
import sys
import time
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

from support.forty_tests import BEGIN, document

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
EXAMPLES = Path(__file__).parents[2] / "examples"
MARK = "CERTKIT_KILLED_IN"
"""Environment variable by which the processes of a killed command are found."""


def command(words: Sequence[str], folder: Path) -> subprocess.Popen[bytes]:
    """Start certkit in a folder."""
    # In the background of a shell it is ignored, which a child would inherit.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    return subprocess.Popen(
        [sys.executable, "-m", "certkit", *words],
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "NO_COLOR": "1", MARK: str(folder)},
    )


def finish(words: Sequence[str], folder: Path) -> float:
    """Leave a command alone until it ends; return how many seconds it took."""
    begun = time.monotonic()
    code = command(words, folder).wait(timeout=600)
    assert code in {0, 1, 4}, f"exit code {code} of certkit {' '.join(words)}"
    return time.monotonic() - begun


def still_running(folder: Path, within: float = 10.0) -> int:
    """Return how many processes of commands in a folder are there after some seconds."""
    mark = f"{MARK}={folder}\0".encode()
    until = time.monotonic() + within
    while True:
        count = 0
        for each in Path("/proc").glob("[0-9]*/environ"):
            try:
                count += mark in each.read_bytes() + b"\0"
            except OSError:
                continue
        if not count or time.monotonic() > until:
            return count
        time.sleep(0.05)


@dataclass
class Killed(ABC):
    """A command that is killed again and again in a folder.

    Parameters
    ----------
    folder : Path
        Empty.
    """

    folder: Path
    number: int = 0

    name: ClassVar[str]
    writing: ClassVar[tuple[str, ...]] = (".out.new", "out/.certkit-switch")
    """Patterns of what is there only while it writes."""

    def __post_init__(self) -> None:
        """Prepare the folder."""
        self.folder.mkdir(parents=True, exist_ok=True)
        self.longest = self.prepare()

    @abstractmethod
    def prepare(self) -> float:
        """Write the inputs and the first result; return the seconds that a command takes."""

    @abstractmethod
    def words(self) -> list[str]:
        """Return the command that is killed next."""

    @abstractmethod
    def wrong(self) -> str:
        """Say what is wrong after a kill; nothing when nothing is."""

    def ended(self) -> str:
        """Finish the command, and say what is wrong or was left behind."""
        finish(self.words(), self.folder)
        return self.wrong() or self._left({"out", "in"})

    def _left(self, expected: set[str]) -> str:
        found = {path.name for path in self.folder.iterdir()} - expected
        found |= {p.name for p in self.folder.rglob("*") if p.suffix == ".part" or ".certkit" in p.name}
        return f"left behind: {sorted(found)}" if found else ""

    def is_writing(self) -> bool:
        """Tell whether it is about to replace something."""
        return any(next(self.folder.glob(pattern), None) for pattern in self.writing)


class ReplacedResult(Killed):
    """A result that is replaced by another one, in turn."""

    files: ClassVar[frozenset[str]]

    def prepare(self) -> float:
        (self.folder / "in").mkdir()
        longest = 0.0
        for self.number in (1, 0):
            longest = max(longest, finish(self.words(), self.folder))
        return longest

    def wrong(self) -> str:
        out = self.folder / "out"
        there = {path.name for path in out.iterdir() if not path.name.startswith(".")}
        if there != self.files:
            return f"the folder holds {sorted(there)}"
        (main,) = (name for name in self.files if name in {"result.json", "extraction.json"})
        said = json.loads((out / main).read_bytes())["id"]
        odd = [name for name in self.files - {main, "vehicle.yaml"} if said not in id_text(out / name)]
        return f"{odd} of another result than {main}" if odd else ""


def id_text(path: Path) -> str:
    """Return a text that holds the id of the document that a page was made of."""
    if path.suffix != ".pdf":
        return path.read_text("utf-8")
    import pikepdf  # noqa: PLC0415  # only where there is one

    with pikepdf.open(io.BytesIO(path.read_bytes())) as pdf:
        return pdf.attachments["result.json"].get_file().read_bytes().decode()


class Run(ReplacedResult):
    name = "run"
    files = frozenset({"result.json", "report.html", "junit.xml"})

    def words(self) -> list[str]:
        changed = ["--set", "run.time step=10 µs"] if self.number % 2 else []
        return ["run", "static-tibia", "--format", "html,junit", "--out", "out", "--force", *changed]


class Certificate(ReplacedResult):
    name = "run (PDF)"
    files = frozenset({"result.json", "report.pdf"})

    def words(self) -> list[str]:
        changed = ["--set", "run.time step=10 µs"] if self.number % 2 else []
        return ["run", "static-tibia", "--format", "pdf", "--out", "out", "--force", *changed]


class Grade(ReplacedResult):
    name = "grade"
    files = frozenset({"result.json", "report.html", "junit.xml", "channels.csv"})

    def words(self) -> list[str]:
        lab = ["--lab", str(EXAMPLES / "measured/lab.yaml")] if self.number % 2 else ["--lenient"]
        data = str(EXAMPLES / "measured/FLX-0007-pendulum.zip")
        options = ["--format", "html,junit,csv", "--out", "out", "--force"]
        return ["grade", "--procedure", "pendulum", data, *lab, *options]


class Extract(ReplacedResult):
    name = "extract"
    files = frozenset({"extraction.json", "extraction.html", "vehicle.yaml"})

    def words(self) -> list[str]:
        case = str(EXAMPLES / "extract/bumper-reference/case-tidy.yaml")
        options = ["--no-checks", "--format", "html", "--out", "out", "--force"]
        return ["extract", case, *options, "--name", "ab"[self.number % 2]]


@dataclass
class Journaled(Killed):
    """Many runs whose finished ones are kept: it goes on where it was, and ends where it would have ended."""

    kept: set[bytes] = field(default_factory=set)
    whole: dict[str, bytes] = field(default_factory=dict)

    def prepare(self) -> float:
        (self.folder / "in").mkdir()
        self.write_sheet()
        seconds = finish(self.words(), self.folder)
        self.whole = self._files()
        self._again()
        return seconds

    @abstractmethod
    def write_sheet(self) -> None:
        """Write what is to be run."""

    def _files(self) -> dict[str, bytes]:
        files = {path.name: path for path in (self.folder / "out").rglob("*") if path.is_file()}
        return {name: path.read_bytes() for name, path in files.items() if name != "runs.jsonl"}

    def _lines(self) -> list[bytes]:
        journal = self.folder / "out" / "runs.jsonl"
        return journal.read_bytes().splitlines(keepends=True) if journal.exists() else []

    def is_writing(self) -> bool:
        """Tell whether the journal has grown, or the result is about to be written, in turn."""
        if self.number % 3 == 0:
            return super().is_writing()
        return len(self._lines()) > len(self.kept)

    def _again(self) -> None:
        """Begin anew."""
        for path in sorted((self.folder / "out").rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()
        self.kept = set()

    def wrong(self) -> str:
        lines = self._lines()
        lost = len(self.kept - set(lines))
        self.kept = {line for line in lines if line.endswith(b"}\n")}
        if lost:
            return f"{lost} finished runs are lost"
        results = {name for name in self.whole if not name.startswith(".")} & set(self._files())
        if not results:
            return ""
        said = self._ended()
        self._again()
        return said

    def _ended(self) -> str:
        files = self._files()
        odd = sorted(name for name in files.keys() | self.whole if files.get(name) != self.whole.get(name))
        if odd:
            return f"{odd} are not those of a run that was left alone"
        keys = [json.loads(line)["key"] for line in self._lines()]
        return "" if len(keys) == len(set(keys)) else "runs were done twice"

    def ended(self) -> str:
        finish(self.words(), self.folder)
        return self._ended() or self._left({"out", "in"})


class Study(Journaled):
    name = "study"

    def write_sheet(self) -> None:
        (self.folder / "in" / "study.yaml").write_text(
            "study: small\ntitle: Small\nprocedures: [static-tibia]\n"
            "parameters: [{path: legform.parts.tibia.bending stiffness, uniform: 2 %}]\n"
            "design: {kind: latin hypercube, runs: 40, seed: 1}\n",
            encoding="utf-8",
        )

    def words(self) -> list[str]:
        return ["study", "in/study.yaml", "--out", "out", "--quiet", "--processes", "2"]


class Calibrate(Journaled):
    name = "calibrate"

    def write_sheet(self) -> None:
        (self.folder / "in" / "fit.yaml").write_text(
            "fit: small\ntitle: Small\nlegform: flex-pli-gtr\nparameters:\n"
            "  - path: legform.parts.femur.bending stiffness\n"
            "    lower: 100 N·m²\n    upper: 250 N·m²\n    reason: a test\n"
            "targets: [{procedure: inverse, criteria: [T1, MCL]}]\n"
            "search: {generations: 1, population: 5, steps: 2, pull: 0.0}\n",
            encoding="utf-8",
        )

    def words(self) -> list[str]:
        return ["calibrate", "in/fit.yaml", "--out", "out", "--quiet", "--processes", "1"]


class History(Killed):
    """Tests that are put into a logbook, a few at a time."""

    name = "history add"
    writing = ("out/results/.*.part", "out/.*.part")
    step: ClassVar[int] = 4

    def prepare(self) -> float:
        self._add_inputs()
        return finish(self.words(), self.folder)

    def _add_inputs(self) -> list[str]:
        names = []
        for n in range(self.step * self.number, self.step * (self.number + 1)):
            path = self.folder / "in" / f"{n}.json"
            if not path.exists():
                document(f"K-{n % 2}", BEGIN, n, "pendulum", 250.0).write(path)
            names.append(f"in/{n}.json")
        return names

    def words(self) -> list[str]:
        return ["history", "add", *self._add_inputs(), "--logbook", "out"]

    def _booked(self) -> dict[str, str]:
        from certkit.logbooks import Logbook  # noqa: PLC0415  # only here

        logbook = Logbook(self.folder / "out")
        return {entry.number: entry.id for serial in logbook.serials() for entry in logbook.entries(serial)}

    def wrong(self) -> str:
        booked = self._booked()
        documents = {
            json.loads(path.read_bytes())["id"] for path in (self.folder / "out/results").glob("*.json")
        }
        if set(booked.values()) != documents:
            return "logbook and documents do not agree"
        # What was booked by a command that ended has to stay.
        missing = {f"2025-{n}" for n in range(self.step)} - set(booked)
        return f"{len(missing)} tests are lost" if missing else ""

    def ended(self) -> str:
        finish(["history", "add", "in/0.json", "--logbook", "out"], self.folder)
        if said := self._left({"out", "in"}):
            return said
        every = [f"in/{path.name}" for path in (self.folder / "in").iterdir()]
        finish(["history", "add", *every, "--logbook", "out"], self.folder)
        if len(self._booked()) != len(every):
            return f"{len(self._booked())} tests are booked of {len(every)}"
        return self._left({"out", "in"})


COMMANDS: tuple[type[Killed], ...] = (Run, Certificate, Grade, Extract, Study, Calibrate, History)


def kill(victim: Killed, chance: random.Random) -> str:
    """Kill a command once, at any moment or while it writes; say by what, and what is wrong then."""
    victim.number += 1
    by, while_writing = chance.choice(SIGNALS), chance.random() < 0.6
    # A short command writes for a few milliseconds only.
    after = victim.longest * (chance.uniform(0.0, 0.05) if while_writing else chance.uniform(0.1, 1.1))
    child = command(victim.words(), victim.folder)
    begun = time.monotonic()
    if while_writing:
        while child.poll() is None and not victim.is_writing():
            time.sleep(0.001)
        time.sleep(after)
    else:
        while child.poll() is None and time.monotonic() - begun < after:
            time.sleep(0.005)
    hit = child.poll() is None
    if hit:
        child.send_signal(by)
    child.wait(timeout=60)
    running = still_running(victim.folder)
    said = f"{running} processes go on" if running else victim.wrong()
    moment = "while writing" if while_writing else f"after {after:.2f} s"
    return f"kill {victim.number} by {by.name} {moment}: {said}" if said else ("" if hit else "missed")


@dataclass
class Tally:
    """How often a command was killed, and what was wrong."""

    name: str
    kills: int
    wrong: list[str]


def kill_command(kind: type[Killed], folder: Path, count: int, seed: int) -> Tally:
    """Kill one kind of command a number of times, then let it finish."""
    chance = random.Random(f"{kind.name} {seed}")  # noqa: S311  # moments, no secrets
    victim = kind(folder)
    kills, wrong = 0, []
    for _ in range(10 * count):
        if kills == count:
            break
        said = kill(victim, chance)
        kills += said != "missed"
        if said not in {"", "missed"}:
            wrong.append(said)
    if said := victim.ended():
        wrong.append(f"at the end: {said}")
    return Tally(kind.name, kills, wrong)
