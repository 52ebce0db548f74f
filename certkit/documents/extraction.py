"""`ExtractionResult`: everything an extraction found, as plain data that a report is rendered from.

Values are SI unless a name says otherwise. Schema `certkit-extraction/1`: fields may be added, none changes
its meaning.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass, field
from typing import Any

from certkit.errors import DataError

SCHEMA = "certkit-extraction/1"
SIGNIFICANT_DIGITS = 7

Series = tuple[float, ...]


@dataclass(frozen=True)
class GroupResult:
    """A group: what it consists of, its mass and face (m, kg), and how it moved over time (N·s, m)."""

    name: str
    kind: str
    parts: tuple[str, ...]
    mass: float
    momentum: Series
    displacement: Series
    low: float | None = None
    high: float | None = None
    position: float | None = None
    slope: float | None = None


@dataclass(frozen=True)
class ClosureResult:
    """Impulse by two independent sides: largest difference and what passed (N·s), and their ratio."""

    title: str
    residual: float
    impulse: float
    percent: float


@dataclass(frozen=True)
class LawResult:
    """A path's spring law (see `certkit.identification.spring_law`) and how well it repeats the history."""

    shortening: Series
    force: Series
    unloading: float
    residual: float
    permanent_set: float
    damping: float
    tension: bool
    misfit_percent: float
    unloaded: bool


@dataclass(frozen=True)
class PathResult:
    """A load path over time: impulse (N·s), force and recorded contact force (N), shortening (m); its law."""

    name: str
    source: str
    target: str
    known_by: str
    impulse: Series
    force: Series
    shortening: Series
    recorded_force: Series | None
    force_error_percent: float | None
    closures: tuple[ClosureResult, ...]
    law: LawResult | None
    peak_force: float
    peak_time: float


@dataclass(frozen=True)
class MaterialResult:
    """Engineering stress–strain curve from a path's law, beside the material's own curve (stress in Pa)."""

    path: str
    length: float
    area: float
    strain: Series
    stress: Series
    unloading_strain: Series
    unloading_stress: Series
    reference_strain: Series
    reference_stress: Series
    strain_from: float
    rms_percent: float | None
    mean_percent: float | None
    uniform: bool
    spread_percent: float | None


@dataclass(frozen=True)
class ExtractionResult:
    """What an extraction found.

    Parameters
    ----------
    case, title : str
    start, interval, count
        The uniform time axis of all series in s.
    groups, paths : tuple
    vehicle : str or None
        Name of the vehicle document written beside it.
    material : MaterialResult or None
        None when no material was named, or when the conversion was refused (see `warnings`).
    warnings : tuple of str
        What a user has to know before using the curves.
    notes : tuple of str
        What was assumed or repaired.
    inputs : dict of str to str
        SHA-256 by file name: the case and all histories.
    """

    case: str
    title: str
    start: float
    interval: float
    count: int
    smoothing: float
    groups: tuple[GroupResult, ...]
    paths: tuple[PathResult, ...]
    vehicle: str | None
    material: MaterialResult | None
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    inputs: dict[str, str] = field(default_factory=dict)
    certkit: str = ""
    schema: str = SCHEMA

    @property
    def times(self) -> list[float]:
        """Return the time axis in s."""
        return [self.start + k * self.interval for k in range(self.count)]

    def to_json(self) -> str:
        """Return the document as JSON, the same bytes for the same content."""
        return (
            json.dumps(_rounded(asdict(self)), ensure_ascii=False, indent=1, sort_keys=True, allow_nan=False)
            + "\n"
        )

    @classmethod
    def from_json(cls, text: str) -> ExtractionResult:
        """Read a document that `to_json` wrote.

        Raises
        ------
        DataError
            When it is no such document.
        """
        try:
            data = json.loads(text)
            if data.get("schema") != SCHEMA:
                raise DataError(
                    f"the schema is {data.get('schema')!r}, not {SCHEMA}; is this an extraction result?"
                )
            return _built(cls, data)
        except (TypeError, KeyError, AttributeError, ValueError, RecursionError) as error:
            raise DataError(f"not a whole extraction result ({error})") from None


def _built(cls: type[ExtractionResult], data: dict[str, Any]) -> ExtractionResult:
    groups = tuple(GroupResult(**_tuples(g)) for g in data.pop("groups"))
    paths = []
    for path in data.pop("paths"):
        closures = tuple(ClosureResult(**c) for c in path.pop("closures"))
        law = path.pop("law")
        paths.append(
            PathResult(
                **_tuples(path), closures=closures, law=None if law is None else LawResult(**_tuples(law))
            )
        )
    material = data.pop("material")
    return cls(
        **_tuples(data),
        groups=groups,
        paths=tuple(paths),
        material=None if material is None else MaterialResult(**_tuples(material)),
    )


def _tuples(data: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in data.items()}


def _rounded(value: Any) -> Any:  # noqa: ANN401  # any plain data
    """Keep the digits that mean something, so that a platform's last bits do not show."""
    if isinstance(value, float):
        if value == 0 or not math.isfinite(value):
            return value
        return round(value, SIGNIFICANT_DIGITS - 1 - math.floor(math.log10(abs(value))))
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(item) for item in value]
    return value
