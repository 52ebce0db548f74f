"""Numbers that know where they come from.

Every corridor, limit and model parameter is a `Number`: a float in SI units that also carries the words it
was written in, its source and how far that source can be trusted. Code that calculates uses it like any
float.
"""

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self, cast, get_args

from pydantic import BaseModel, ConfigDict, Field
from pydantic_core import core_schema

from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import UNITS, parse_quantity

Confidence = Literal["verified", "secondary", "recalled", "derived", "calibrated", "estimated"]
"""`verified`: read in the named text, or in a faithful copy of it that is named; `secondary`: read in an
account of that text; `recalled`: named text not read; `derived`: follows by arithmetic; `calibrated`: fitted,
the fit is named; `estimated`: a judgement."""

CONFIDENCES: tuple[str, ...] = get_args(Confidence)

NEVER_ZERO = frozenset({"mass", "inertia", "bending stiffness"})
NEVER_NEGATIVE = NEVER_ZERO | {
    "damping",
    "foundation stiffness",
    "frequency",
    "line load",
    "pressure",
    "rotational damping",
    "rotational stiffness",
    "stiffness",
}

Bound = Literal["above zero", "zero or above", "from 0 to 1", "within 90 deg"]
"""What a number has to keep where its field says so, whatever its dimension allows elsewhere."""

MIN_SOURCE = 3  # letters; less names nothing


class Origin(BaseModel):
    """Where a number comes from, and how far that can be trusted."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    source: Annotated[
        str, Field(min_length=MIN_SOURCE, description="Text, test or fit that the number comes from.")
    ]
    confidence: Confidence


def readable(origin: Mapping[str, Any]) -> dict[str, Any]:
    """Return an origin that the numbers under it can inherit, whatever is wrong with it.

    What is wrong is reported once, where the origin stands, and not again at each number.
    """
    source, confidence = origin.get("source"), origin.get("confidence")
    named = isinstance(source, str) and len(source) >= MIN_SOURCE
    return {
        "source": source if named else "an origin that cannot be read",
        "confidence": confidence if confidence in CONFIDENCES else "estimated",
    }


def within(number: float, bound: Bound | None) -> bool:
    """Tell whether a number keeps a bound."""
    if bound is None:
        return True
    if bound == "above zero":
        return number > 0.0
    if bound == "within 90 deg":
        return abs(number) <= math.radians(90) * (1 + 1e-12)
    return number >= 0.0 and (bound == "zero or above" or number <= 1.0)


class Number(float):
    """A float in SI units that carries its origin and the words it was written in."""

    text: str
    source: str
    confidence: Confidence

    def __new__(cls, value: float, text: str, source: str, confidence: Confidence) -> Self:
        """Make a number; `text` is how it was written, with its unit."""
        number = super().__new__(cls, value)
        number.text, number.source, number.confidence = text, source, confidence
        return number

    def __reduce__(self) -> "tuple[type[Number], tuple[float, str, str, str]]":
        """Pickle with the origin."""
        return (Number, (float(self), self.text, self.source, self.confidence))


class QuantityDimension:
    """Makes pydantic read a `Number` of one dimension: `Annotated[Number, QuantityDimension("length")]`.

    In YAML the number is a mapping `{value: 25 mm, source: …, confidence: …}`, or just `25 mm` inside a
    section whose `origin` covers it (`certkit.definitions.base.Section` fills that in before validation).
    """

    def __init__(self, name: str, bound: Bound | None = None) -> None:
        """Name a key of `certkit.definitions.units.UNITS`, and what the number has to keep."""
        self.name, self.bound = name, bound

    def _read(self, given: Any) -> Number:  # noqa: ANN401  # raw YAML data
        if isinstance(given, Number):
            return given
        if not isinstance(given, Mapping):
            parse_quantity(given, self.name)  # a wrong unit is the more useful message
            message = (
                f"`{given}` has no origin; write {{value: {given}, source: …, confidence: …}} "
                "or give the section an `origin`"
            )
            raise Faults([((), message)])
        faults: list[Fault] = [
            ((key,), f"`{key}` is not known here; a number has value, source and confidence")
            for key in given
            if key not in {"value", "source", "confidence"}
        ]
        value, source, confidence = given.get("value"), given.get("source"), given.get("confidence")
        number = 0.0
        if "value" not in given:
            faults.append(((), "`value` is missing; write the number with its unit"))
        else:
            try:
                number = parse_quantity(value, self.name)
            except ValueError as error:
                faults.append((("value",), str(error)))
            else:
                faults += [(("value",), said) for said in self._beyond(number, value)]
        if not isinstance(source, str) or len(source) < MIN_SOURCE:
            faults.append(
                (("source",), "`source` has to name the text, test or fit that the number comes from")
            )
        if confidence not in CONFIDENCES:
            message = f"`{confidence}` is no confidence" if confidence else "`confidence` is missing"
            faults.append((("confidence",), f"{message}; write one of {', '.join(CONFIDENCES)}"))
        if faults:
            raise Faults(faults)
        return Number(number, str(value), str(source), cast("Confidence", confidence))

    def _beyond(self, number: float, value: object) -> list[str]:
        """Say which bound a number, written as `value`, is beyond."""
        if number < 0 and self.name in NEVER_NEGATIVE:
            return [f"`{value}` is negative; a {self.name} is not"]
        if number == 0 and self.name in NEVER_ZERO:
            return [f"`{value}`: a {self.name} is greater than zero"]
        return [] if within(number, self.bound) else [f"`{value}`: this {self.name} has to be {self.bound}"]

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:  # noqa: ANN401  # pydantic's own signature
        """Read with `_read`; write as the mapping of value, source and confidence."""
        return core_schema.no_info_plain_validator_function(
            self._read,
            serialization=core_schema.plain_serializer_function_ser_schema(
                lambda n: {"value": n.text, "source": n.source, "confidence": n.confidence}
            ),
        )

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:  # noqa: ANN401  # pydantic's own signature
        """Describe both ways of writing the number for editors."""
        units = [u for u in UNITS[self.name] if u]
        example = f"1 {units[0]}" if units else 1
        said = f"A {self.name} {self.bound}." if self.bound else f"A {self.name}."
        plain = {"type": ["string", "number"], "description": said, "examples": [example]}
        return {
            "anyOf": [
                plain,
                {
                    "type": "object",
                    "properties": {
                        "value": plain,
                        "source": {"type": "string"},
                        "confidence": {"enum": list(CONFIDENCES)},
                    },
                    "required": ["value"],
                    "additionalProperties": False,
                },
            ]
        }


Length = Annotated[Number, QuantityDimension("length")]
Mass = Annotated[Number, QuantityDimension("mass")]
Time = Annotated[Number, QuantityDimension("time")]
Angle = Annotated[Number, QuantityDimension("angle")]
Speed = Annotated[Number, QuantityDimension("speed")]
Acceleration = Annotated[Number, QuantityDimension("acceleration")]
Force = Annotated[Number, QuantityDimension("force")]
Stiffness = Annotated[Number, QuantityDimension("stiffness")]
Damping = Annotated[Number, QuantityDimension("damping")]
RotationalStiffness = Annotated[Number, QuantityDimension("rotational stiffness")]
BendingStiffness = Annotated[Number, QuantityDimension("bending stiffness")]
Inertia = Annotated[Number, QuantityDimension("inertia")]
Pressure = Annotated[Number, QuantityDimension("pressure")]
FoundationStiffness = Annotated[Number, QuantityDimension("foundation stiffness")]
Frequency = Annotated[Number, QuantityDimension("frequency")]
Ratio = Annotated[Number, QuantityDimension("ratio")]
