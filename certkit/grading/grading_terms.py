"""What a test is graded by, beside its recording: definitions, the laboratory's terms, the simulated run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msgspec import Struct, field

from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.reference import Reference
    from certkit.documents.result import (
        Front,
        Histories,
        InputFile,
        Parameter,
        PreconditionResult,
        Provenance,
        Quality,
    )
    from certkit.documents.rig_motion import Motion
    from certkit.reasons import Reason


class GradingTerms(Struct, frozen=True):
    """The definitions that a procedure is graded by, and their origins.

    Parameters
    ----------
    corridors : mapping of str to CorridorSet
        By name; a set that is not there makes its criteria `not evaluated`.
    provenance : Provenance
        Files and programs that the result rests on.
    reference : Reference, optional
        For the error table.
    parameters : sequence of Parameter
        Numbers that went in, with their origins.
    """

    corridors: Mapping[str, CorridorSet]
    provenance: Provenance
    reference: Reference | None = None
    parameters: Sequence[Parameter] = ()


class LaboratoryTerms(Struct, frozen=True):
    """What a laboratory's file adds to a grading.

    Parameters
    ----------
    header : dict, optional
        For the report.
    checks : tuple of PreconditionResult
        One row a sensor: whether its calibration covers the day of the test.
    decision : DecisionRule
        Simple acceptance or a guard band.
    uncertainties : dict of str to float
        Expanded uncertainty U (k = 2) by channel, SI.
    conditions : dict of str to float
        Conditions of the test, SI.
    specimen : dict of str to str
        The legform on the rig: its name and serial number.
    inputs : tuple of InputFile
        The file itself.
    """

    header: dict[str, Any] | None = None
    checks: tuple[PreconditionResult, ...] = ()
    decision: DecisionRule = SIMPLE_ACCEPTANCE
    uncertainties: Mapping[str, float] = field(default_factory=dict)
    conditions: Mapping[str, float] = field(default_factory=dict)
    specimen: Mapping[str, str] = field(default_factory=dict)
    inputs: tuple[InputFile, ...] = ()


NO_LABORATORY = LaboratoryTerms()


class SimulatedTerms(Struct, frozen=True):
    """What a simulated run brings beside its recording.

    Parameters
    ----------
    quality : Quality, optional
        Whether it can be trusted, from `certkit.grading.quality_gate`.
    numerical : mapping of str to float
        Numerical uncertainty by criterion id, in the criterion's unit (`certkit.grading.refinement`).
    legform : str
        Title of the simulated leg; the procedure's own words when empty.
    motion : Motion, optional
        Outlines and poses over time.
    energies : Histories, optional
        Energy over time.
    front : Front, optional
        What the vehicle's front did.
    fitted, bounds : tuple of Reason
        Fits that aimed at what the procedure grades by, and fitted values that stand on a bound.
    """

    quality: Quality | None = None
    numerical: Mapping[str, float] = field(default_factory=dict)
    legform: str = ""
    motion: Motion | None = None
    energies: Histories | None = None
    front: Front | None = None
    fitted: tuple[Reason, ...] = ()
    bounds: tuple[Reason, ...] = ()


NOT_SIMULATED = SimulatedTerms()
