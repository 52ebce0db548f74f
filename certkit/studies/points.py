"""What one run of a study is given and gives back, and the key under which it is remembered."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Mapping

from msgspec import Struct

Setting = float | str
"""A parameter's value: a number in the parameter's unit, or a word."""

Point = Mapping[str, Setting]
"""The settings of one run, by parameter."""

Outputs = Mapping[str, float | str | None]
"""What a run gives, by column; None where a number could not be had."""

Evaluate = Callable[[Point], Outputs]
"""One run. It has to be picklable, and has to give the same bits for the same point in any process."""


class Outcome(Struct, frozen=True):
    """A run's outputs, or the error it ended with: a failed run is a row like any other.

    Parameters
    ----------
    outputs : mapping of str to float, str or None
        Empty when the run failed.
    error : str
        One line; empty when it did not fail.
    """

    outputs: Outputs
    error: str = ""


def attempt(evaluate: Evaluate, point: Point) -> Outcome:
    """Run one point; whatever goes wrong becomes the row's error."""
    try:
        outputs = evaluate(point)
    except Exception as error:  # noqa: BLE001  # one failed run must not end the study, whatever it died of
        words = str(error).splitlines() or [""]
        return Outcome({}, f"{type(error).__name__}: {words[0]}")
    return Outcome({name: _plain(value) for name, value in outputs.items()})


def _plain(value: object) -> float | str | None:
    """Bring a value to what survives a journal bit for bit."""
    if value is None or isinstance(value, str):
        return value
    number = float(value)  # type: ignore[arg-type]  # numpy's numbers and truth values included
    return number if math.isfinite(number) else None


def key_of(context: str, point: Point) -> str:
    """Return the content hash of a run: what it is a run of, and its settings to the last bit.

    Parameters
    ----------
    context : str
        Names everything besides the point that decides the outputs: the program's version, the hashes of all
        definitions.
    point : mapping of str to float or str
        Settings; their order does not matter.
    """
    text = json.dumps([context, sorted(point.items())], ensure_ascii=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:32]
