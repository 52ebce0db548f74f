"""The numbers of a document: seven significant digits, so that the last bits of a machine do not show."""

from __future__ import annotations

import math
from functools import cache
from itertools import islice
from typing import TYPE_CHECKING, Annotated

from pydantic import PlainSerializer

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

SIGNIFICANT_DIGITS = 7

FLOOR_DIGITS = 10
"""Digits below the first of a channel's largest sample in which its smallest samples are written."""

RESIDUAL_DECIMALS = 6
"""Decimals of a residual in its unit (%, mm): far below any limit that it is held against."""


def rounded(value: float) -> float:
    """Round to the digits that the document keeps, so that the last bits of a platform's libm do not show."""
    if value == 0 or not math.isfinite(value):
        return value
    return round(value, SIGNIFICANT_DIGITS - 1 - math.floor(math.log10(abs(value))))


def rounded_all(values: Sequence[float] | NDArray[np.float64]) -> list[float]:
    """Round many values, shape (n,), as `rounded` does; 20 times quicker from a few dozen on."""
    import numpy as np  # noqa: PLC0415  # words and numbers are read without it

    given = np.asarray(values, dtype=np.float64)
    # A whole number over a power of ten up to 1e22 is the nearest double to the decimal, so it prints short.
    size = np.abs(given)
    plain = (size < 1e-15) | (size > 1e15) | ~np.isfinite(size)
    size[plain] = 1.0
    exponent = SIGNIFICANT_DIGITS - 1 - np.floor(np.log10(size))
    up, down = (_powers_of_ten()[np.maximum(e, 0).astype(np.intp)] for e in (exponent, -exponent))
    listed: list[float] = np.where(
        plain, given, np.rint(size * up / down) * down / up * np.sign(given)
    ).tolist()
    for index in np.flatnonzero(plain & (given != 0)):
        listed[int(index)] = rounded(listed[int(index)])
    return listed


@cache
def _powers_of_ten() -> NDArray[np.float64]:
    """Return 1, 10 … 1e22 as words give them: a vectorised `**` may be an ulp off, and then prints long."""
    import numpy as np  # noqa: PLC0415  # as above

    return np.array([float(f"1e{k}") for k in range(23)])


SMALLEST_PEAK = 1e-290
"""A channel that stays below is as good as zero; the power of ten that its floor asks for is no number."""


def rounded_series(values: Sequence[float] | NDArray[np.float64]) -> list[float]:
    """Round the samples of one channel: seven digits each, and none finer than `FLOOR_DIGITS` of the largest.

    `values`, shape (n,), are in one unit, whichever it is. A sample near zero is a difference of large
    numbers, and its own seven digits are the noise of a processor's last bits: with and without fused
    multiply-add a few of 100,000 samples would round apart.
    """
    import numpy as np  # noqa: PLC0415  # as above

    given = np.asarray(values, dtype=np.float64)
    peak = rounded(float(np.abs(given).max(initial=0.0)))
    if peak < SMALLEST_PEAK or not math.isfinite(peak):
        return rounded_all(given)
    decimals = FLOOR_DIGITS - 1 - math.floor(math.log10(peak))
    # Twice: the floor first, so that what is left of a small sample is short when its digits are rounded.
    return rounded_all(np.where(np.abs(given) < peak, np.round(given, decimals) + 0.0, given))


def rounded_residual(value: float) -> float:
    """Round a residual, such as the gap of a joint, which is zero but for the last bits of a processor."""
    return round(value, RESIDUAL_DECIMALS) + 0.0 if math.isfinite(value) else value


def rounded_difference(value: float, of: float) -> float:
    """Round a small difference of two numbers of the size `of`, whose last bits are a processor's own."""
    if of == 0 or not (math.isfinite(value) and math.isfinite(of)):
        return value
    return round(value, FLOOR_DIGITS - 2 - math.floor(math.log10(abs(of)))) + 0.0


def rounded_rows(rows: Sequence[Sequence[float]]) -> list[list[float]]:
    """Round rows of numbers, such as points, as `rounded` does, all in one go."""
    numbers = iter(rounded_all([value for row in rows for value in row]))
    return [list(islice(numbers, len(row))) for row in rows]


def rounded_frames(frames: Sequence[Sequence[Sequence[float]]]) -> list[list[list[float]]]:
    """Likewise for a table of numbers a frame."""
    rows = iter(rounded_rows([row for frame in frames for row in frame]))
    return [list(islice(rows, len(frame))) for frame in frames]


def rounded_number(value: float | str) -> float | str:
    """Round a value that may also be a word; a word and a whole number stay as they are."""
    return rounded(value) if isinstance(value, float) else value


Figure = Annotated[float, PlainSerializer(rounded, when_used="json")]
Figures = Annotated[list[float], PlainSerializer(rounded_all, return_type=list[float], when_used="json")]
FigureTuple = Annotated[
    tuple[float, ...], PlainSerializer(rounded_series, return_type=list[float], when_used="json")
]
FigureOrWord = Annotated[
    int | float | str, PlainSerializer(rounded_number, return_type=int | float | str, when_used="json")
]
Point = tuple[Figure, Figure]
Points = Annotated[list[Point], PlainSerializer(rounded_rows, when_used="json")]
Rows = Annotated[list[list[float]], PlainSerializer(rounded_rows, when_used="json")]
Pose = tuple[Figure, Figure, Figure]
LineFrames = Annotated[list[list[Point]], PlainSerializer(rounded_frames, when_used="json")]
Poses = Annotated[list[list[Pose]], PlainSerializer(rounded_frames, when_used="json")]
