"""Numbers of a document whose sign or size is known before anything is computed with them.

A length may be negative where it is a place, and may not where it is the size of a thing: a run with it
would give numbers all the same, as with friction that drives or flesh that gives back more than it took.
"""

from typing import Annotated

from certkit.definitions.provenance import Number, QuantityDimension

LengthAboveZero = Annotated[Number, QuantityDimension("length", "above zero")]
LengthFromZero = Annotated[Number, QuantityDimension("length", "zero or above")]
RatioAboveZero = Annotated[Number, QuantityDimension("ratio", "above zero")]
RatioFromZero = Annotated[Number, QuantityDimension("ratio", "zero or above")]
RatioToOne = Annotated[Number, QuantityDimension("ratio", "from 0 to 1")]
TimeAboveZero = Annotated[Number, QuantityDimension("time", "above zero")]
TimeFromZero = Annotated[Number, QuantityDimension("time", "zero or above")]
AngleFromZero = Annotated[Number, QuantityDimension("angle", "zero or above")]
AngleWithinQuarterTurn = Annotated[Number, QuantityDimension("angle", "within 90 deg")]
SpeedAboveZero = Annotated[Number, QuantityDimension("speed", "above zero")]
ForceAboveZero = Annotated[Number, QuantityDimension("force", "above zero")]
ForceFromZero = Annotated[Number, QuantityDimension("force", "zero or above")]
StiffnessAboveZero = Annotated[Number, QuantityDimension("stiffness", "above zero")]
