"""The flesh of a legform as a foam under a skin, each number with its origin."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Section
from certkit.definitions.bounded_numbers import (
    LengthAboveZero,
    LengthFromZero,
    RatioAboveZero,
    RatioToOne,
    SpeedAboveZero,
)
from certkit.definitions.loading.faults import Faults
from certkit.definitions.provenance import Length, Pressure, Ratio


class FleshFoam(Section):
    """Flesh as a tabulated foam under a skin, in place of compression, wall and resilience."""

    width: Annotated[LengthAboveZero, Field(description="Across the impact.")]
    stress: Annotated[
        list[tuple[Ratio, Pressure]],
        Field(min_length=2, max_length=500, description="Over strain, from (0, 0); last slope beyond."),
    ]
    hysteresis: Annotated[
        RatioToOne, Field(description="Share of the loading stress left at the end of springing back.")
    ]
    shape: Annotated[
        RatioAboveZero, Field(description="Exponent of the energy's share, by which the stress falls to it.")
    ]
    loss: Annotated[
        RatioToOne | None,
        Field(
            description="Share that internal friction adds while it is pressed, and takes while it is let go."
        ),
    ] = None
    reversal_speed: Annotated[
        SpeedAboveZero | None, Field(description="At which that friction turns; 1 m/s when missing.")
    ] = None
    recovery: Annotated[
        LengthAboveZero | None,
        Field(description="Way of new loading over which it forgets its memory; never when missing."),
    ] = None
    elastic_modulus: Annotated[
        Pressure | None,
        Field(
            description="By which its stress goes from loading to springing back; where it is given, foam "
            "and skin bend beside the bones, and no gauge feels them."
        ),
    ] = None
    element: Annotated[
        Length | None,
        Field(
            description="Length of a finite-element leg's elements along it: it meets faces in strips as "
            "long, since no dent in them is sharper."
        ),
    ] = None
    shear_modulus: Annotated[Pressure, Field(description="By which places take their surroundings along.")]
    skin_modulus: Annotated[Pressure, Field(description="Young's modulus of the skin.")]
    skin_thickness: LengthFromZero

    @model_validator(mode="after")
    def _begins_at_zero_and_rises(self) -> Self:
        points = [(float(strain), float(stress)) for strain, stress in self.stress]
        if points[0] != (0.0, 0.0):
            raise Faults([(("stress", 0), "the foam's curve has to begin at strain 0 and stress 0")])
        for index, (here, last) in enumerate(zip(points[1:], points, strict=False), 1):
            if here[0] <= last[0] or here[1] < last[1]:
                message = "strains have to rise from point to point, and stresses must not fall"
                raise Faults([(("stress", index), message)])
        if self.elastic_modulus is not None and float(self.elastic_modulus) <= self.first_modulus:
            slope = f"{self.first_modulus * 1e-6:.4g} MPa"
            message = f"`elastic modulus` has to be more than the curve's first slope, {slope}"
            raise Faults([(("elastic_modulus",), message)])
        if self.element is not None and not 2e-3 <= float(self.element) <= 0.05:
            raise Faults([(("element",), "an element of a leg's foam is 2 to 50 mm long")])
        return self

    @property
    def first_modulus(self) -> float:
        """Return the slope with which its curve begins, Pa."""
        strain, stress = self.stress[1]
        return float(stress) / float(strain)
