"""Masses and faces of a front's parts from its table of groups and its outlines."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes
from certkit.exchange.fe.numeric_table import read_cells

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray


class Face(Struct, frozen=True):
    """Mass and face of one part. Heights are above the ground, x grows into the car; metres and kilograms.

    `position` is x at the middle of the height span and `slope` is dx/dz, both a straight line through the
    outline. `centre` is (x, z) of the part's centre of gravity, where the table has it.
    """

    mass: float
    low: float | None = None
    high: float | None = None
    position: float | None = None
    slope: float | None = None
    centre: tuple[float, float] | None = None


def joint_face(faces: Sequence[Face]) -> Face | None:
    """Return the face of several parts: one line from the lowest part's lower end to the highest's upper end.

    None where none of them has a face.
    """
    own = [face for face in faces if None not in (face.low, face.high, face.position)]
    if len(own) < 2:
        return own[0] if own else None

    def at(face: Face, high: bool) -> tuple[float, float]:  # noqa: FBT001  # which end
        low, top = float(face.low or 0.0), float(face.high or 0.0)
        rise = 0.5 * (top - low) * float(face.slope or 0.0)
        return (top if high else low), float(face.position or 0.0) + (rise if high else -rise)

    (low, x_low), (high, x_high) = min(at(f, False) for f in own), max(at(f, True) for f in own)
    return Face(
        mass=sum(face.mass for face in faces),
        low=low,
        high=high,
        position=0.5 * (x_low + x_high),
        slope=(x_high - x_low) / (high - low),
    )


def read_faces(table: Path, outlines: Path | None) -> tuple[dict[str, Face], dict[str, str]]:
    """Read the table of groups (group, mass_kg, z_low_mm, z_high_mm) and the outlines of `params.json`.

    Every key that starts with `fascia` or `hood` and ends with `_poly_x_z` is an outline: a list of (x, z)
    in mm. A part lies on the outline that covers most of its height span.

    Returns
    -------
    faces : dict of str to Face
    digests : dict of str to str
        SHA-256 by file.
    """
    rows, digest = read_cells(table)
    digests = {str(table): digest}
    lines: list[NDArray[np.float64]] = []
    if outlines is not None:
        lines, digests[str(outlines)] = _outlines(outlines)
    faces = {}
    spans: list[tuple[float, float]] = []
    for number, row in enumerate(rows, start=2):
        name = row.get("group", "")
        place = f"{table}:{number}"
        if not name:
            raise DataError(f"{place}: the column `group` is missing or empty; name each group there")
        if name in faces:
            raise DataError(f"{place}: the group `{name}` stands there twice; name each once")
        mass = _number(row, "mass_kg", place)
        if mass is None or mass <= 0:
            raise DataError(f"{place}: `{name}` needs a mass above zero in `mass_kg`")
        low, high = _number(row, "z_low_mm", place), _number(row, "z_high_mm", place)
        x, z = _number(row, "cg_x0_mm", place), _number(row, "cg_z0_mm", place)
        centre = None if x is None or z is None else (x * 1e-3, z * 1e-3)
        if low is None or high is None:
            faces[name] = Face(mass, centre=centre)
            continue
        if high <= low:
            raise DataError(
                f"{place}: `{name}` ends at {high:g} mm, below where it begins ({low:g} mm); correct "
                "`z_low_mm` or `z_high_mm`"
            )
        spans.append((low, high))
        position, slope = _line(low, high, lines, row, place)
        faces[name] = Face(mass, low * 1e-3, high * 1e-3, position * 1e-3, slope, centre)
    if lines and spans and not any(_covered(line, *span) > 0 for line in lines for span in spans):
        raise DataError(
            f"{outlines}: no outline reaches the height of any face of {table}; give both in mm above the "
            "ground"
        )
    return faces, digests


def _outlines(path: Path) -> tuple[list[NDArray[np.float64]], str]:
    content, digest = read_bytes(path)
    try:
        data = json.loads(content)
        found = {k: v for k, v in data.items() if k.endswith("_poly_x_z")}
        lines = [np.array(found[k], dtype=np.float64) for k in sorted(found)]
    except (ValueError, AttributeError, RecursionError) as error:
        raise DataError(f"{path}: no JSON object with outlines ({error}); write it again") from None
    for name, line in zip(sorted(found), lines, strict=True):
        if line.ndim != 2 or line.shape[1] != 2 or len(line) < 2 or np.any(np.diff(line[:, 1]) <= 0):
            raise DataError(f"{path}: `{name}` must be points [x, z] with rising z; sort them")
        if not np.all(np.isfinite(line)):
            raise DataError(f"{path}: `{name}` holds a number that is not finite; correct it")
    return lines, digest


def _line(
    low: float, high: float, lines: list[NDArray[np.float64]], row: Mapping[str, str], place: str
) -> tuple[float, float]:
    """Fit a line to the outline over the span; without an outline take the table's middle and no slope."""
    best, share = None, 0.0
    for line in lines:
        covered = _covered(line, low, high)
        if covered > share:
            best, share = line, covered
    if best is None:
        x = [_number(row, name, place) for name in ("x_front_min_mm", "x_front_max_mm")]
        if x[0] is None or x[1] is None:
            raise DataError(
                f"{place}: neither an outline nor `x_front_min_mm`/`x_front_max_mm` tell its face; "
                "give one of them"
            )
        return 0.5 * (x[0] + x[1]), 0.0
    z = np.linspace(max(low, best[0, 1]), min(high, best[-1, 1]), 41)
    slope, offset = np.polyfit(z, np.interp(z, best[:, 1], best[:, 0]), 1)
    return float(offset + slope * 0.5 * (low + high)), float(slope)


def _covered(line: NDArray[np.float64], low: float, high: float) -> float:
    """Return how much of a height span an outline covers, mm; negative where it does not reach it."""
    return float(min(high, line[-1, 1]) - max(low, line[0, 1]))


def _number(row: Mapping[str, str], column: str, place: str) -> float | None:
    text = row.get(column, "")
    if not text:
        return None
    try:
        value = float(text)
    except ValueError:
        raise DataError(f"{place}: column `{column}`: `{text}` is not a number; correct it") from None
    if not np.isfinite(value):
        raise DataError(f"{place}: column `{column}`: `{text}` is not a finite number; correct it")
    return value
