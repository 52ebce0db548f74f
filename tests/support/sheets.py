"""Small procedures, corridors and recordings that the tests of this folder share."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from certkit.definitions.corridor_set import CorridorSet
from certkit.definitions.loading.channel_tables import default_channels
from certkit.definitions.procedure import Criterion, Procedure
from certkit.definitions.reference import Reference
from certkit.documents.result import Provenance
from certkit.grading import GradingTerms, LaboratoryTerms, SimulatedTerms, evaluate, measure_all
from certkit.reasons import Reason
from certkit.reporting.language import worded
from certkit.signals import Channel, Recording

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Result
    from certkit.signals.recording import RecordingKind

Floats = NDArray[np.float64]

KINDS = default_channels().kinds

TIME = np.arange(2001) * 1e-4
PROVENANCE = Provenance(certkit="0", inputs=[], packages={})
ORIGIN = {"source": "made up for this test", "confidence": "verified"}


def bump(peak: float, *, at: float = 0.05) -> Floats:
    """Return a smooth hill of height `peak` at a time, 40 ms wide."""
    return np.where(np.abs(TIME - at) < 0.02, peak * np.cos(np.pi * (TIME - at) / 0.04) ** 2, 0.0)


def recording(
    values: dict[str, ArrayLike], *, time: Floats = TIME, kind: RecordingKind = "simulated"
) -> Recording:
    channels = {
        name: Channel(
            name,
            KINDS[name].title,
            KINDS[name].dimension,
            np.asarray(v, dtype=float),
        )
        for name, v in values.items()
    }
    return Recording(kind, time, channels, source="test.csv")


def criterion(**fields: object) -> Criterion:
    return Criterion.model_validate({"id": "T1", "title": "Tibia moment 1", "measure": "max", **fields})


def procedure(*criteria: dict[str, Any], rig: dict[str, Any] | None = None, **more: object) -> Procedure:
    """Return a procedure with the given criteria; without a rig it is a plain recording from contact on."""
    listed = [{"title": c["id"], "measure": "max", "channel": c["id"], **c} for c in criteria]
    return Procedure.model_validate(
        {
            "procedure": "sheet",
            "title": "A test sheet",
            "method": {"document": "made up", "confidence": "verified"},
            "rig": rig or {},
            "criteria": [{k: v for k, v in c.items() if v is not None} for c in listed],
            **more,
        }
    )


def corridor_set(name: str = "set", **groups: object) -> dict[str, CorridorSet]:
    given = {"corridors": name, "title": name, "origin": ORIGIN, **groups}
    return {name: CorridorSet.model_validate(given)}


def grade(
    sheet: Procedure,
    corridors: dict[str, CorridorSet],
    rec: Recording,
    *,
    lenient: bool = False,
    reference: Reference | None = None,
    notes: Sequence[str] = (),
    **more: Any,  # noqa: ANN401  # fields of what a laboratory or a simulated run brings
) -> Result:
    """Grade by a made-up sheet; `quality=`, `decision=` and the like go where they belong."""
    own = set(SimulatedTerms.__struct_fields__)
    result = evaluate(
        measure_all(sheet, rec, lenient=lenient),
        GradingTerms(corridors, PROVENANCE, reference),
        simulated=SimulatedTerms(**{k: v for k, v in more.items() if k in own}),
        laboratory=LaboratoryTerms(**{k: v for k, v in more.items() if k not in own}),
        notes=[Reason.words(note) for note in notes],
    )
    return worded(result)


def only(result: Result) -> CriterionResult:
    (found,) = result.criteria
    return found
