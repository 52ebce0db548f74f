"""Small evaluations for the tests of the studies: importable, so that worker processes find them."""

from __future__ import annotations

import math
import os
import time
import uuid
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.studies.points import Outputs, Point


def wave(point: Point) -> Outputs:
    """Something whose last bits would show a difference."""
    a, b = float(point["a"]), float(point["b"])
    return {"y": math.sin(a) * math.exp(b) / 3, "z": a - b}


def slow_wave(point: Point) -> Outputs:
    """The same, slowly."""
    time.sleep(0.05)
    return wave(point)


def fussy(point: Point) -> Outputs:
    """Fails for negative numbers."""
    return {"root": math.sqrt(float(point["a"]))}


def nothing(point: Point) -> Outputs:
    """Give what no journal can hold, and a word."""
    del point
    return {"nan": math.nan, "inf": math.inf, "word": "pass"}


def deadly(point: Point) -> Outputs:
    """Takes its process with it at 5."""
    if point["a"] == 5:
        os._exit(9)
    return {"twice": 2 * float(point["a"])}


@dataclass(frozen=True)
class Counted:
    """Leaves a file for every run that was begun."""

    folder: str

    def __call__(self, point: Point) -> Outputs:
        """Leave the file and take some time."""
        (Path(self.folder) / f"begun-{point['a']}-{uuid.uuid4().hex}").touch()
        time.sleep(0.03)
        return {"a": float(point["a"])}


@dataclass(frozen=True)
class Endless:
    """Leaves its process's number and then takes an hour."""

    folder: str

    def __call__(self, point: Point) -> Outputs:
        """Leave the number."""
        (Path(self.folder) / f"pid-{os.getpid()}").touch()
        time.sleep(3600)
        return {"a": float(point["a"])}


def linear(point: Point) -> Outputs:
    """y = 3 a − 2 b + 1, and z that depends on nothing."""
    a, b = float(point["a"]), float(point["b"])
    return {"y": 3 * a - 2 * b + 1, "z": 4.0}


def ishigami(point: Point) -> Outputs:
    """Ishigami's function with a = 7, b = 0.1: its Sobol indices are known in closed form."""
    x1, x2, x3 = (float(point[name]) for name in ("x1", "x2", "x3"))
    return {"y": math.sin(x1) + 7 * math.sin(x2) ** 2 + 0.1 * x3**4 * math.sin(x1)}
