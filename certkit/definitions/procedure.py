"""The procedure document: a test sheet with a rig's fixtures, its criteria and its preconditions."""

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Document, Section, Sourced
from certkit.definitions.bounded_numbers import TimeAboveZero
from certkit.definitions.filters import Filter
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.measures import MEASURES
from certkit.definitions.provenance import Confidence
from certkit.definitions.rig import Rig
from certkit.definitions.units import UNITS, parse_quantity

if TYPE_CHECKING:
    from certkit.definitions.fixtures.fixture import TestKind


class Method(Document):
    """The text a procedure follows."""

    document: str
    annex: str | None = None
    clause: str | None = None
    edition: str | None = None
    confidence: Annotated[Confidence, Field(description="How far the procedure's numbers were checked.")] = (
        "recalled"
    )

    @property
    def words(self) -> str:
        """Return `UN R127, annex 6, clause 1.2 (01 series)`."""
        parts = [self.document]
        parts += [f"annex {self.annex}"] if self.annex else []
        parts += [f"clause {self.clause}"] if self.clause else []
        return ", ".join(parts) + (f" ({self.edition})" if self.edition else "")


class Specimen(Document):
    """What is put on the rig."""

    legform: str = "flex-pli-gtr"
    part: Annotated[
        str, Field(description="`leg` for all of it, `knee`, or a part such as `femur` or `tibia`.")
    ] = "leg"
    flesh: Literal["fitted", "off"] = "off"


class Run(Section):
    """How long is simulated and recorded."""

    until: Annotated[TimeAboveZero | None, Field(description="After first contact.")] = None
    time_step: TimeAboveZero | None = None


class Curve(Document):
    """Two channels drawn against each other."""

    x: str
    y: str


class At(Document):
    """The instant at which `value at` is read: when a channel first reaches a value."""

    channel: str
    equals: str


if TYPE_CHECKING:
    Measure = str
else:
    Measure = Literal[tuple(MEASURES)]


class Criterion(Document):
    """One thing that is measured on the recording and held against a corridor.

    Without a corridor, or with one that its set still awaits, a criterion is informative: shown, not graded.
    """

    id: str
    title: str
    channel: Annotated[str | None, Field(description="Short name or words of a channel.")] = None
    curve: Curve | None = None
    filter: Filter = "none"
    measure: Measure
    at: At | None = None
    interval: Literal["whole", "assessment interval"] = "whole"
    corridor: Annotated[str | None, Field(description="`set/entry`.")] = None
    note: Annotated[str | None, Field(description="What a reader should know about it.")] = None


class Precondition(Sourced):
    """A condition the test must have been done under, else it is not evaluated."""

    quantity: str
    dimension: str
    within: Annotated[list[str], Field(min_length=2, max_length=2)]
    applies_to: Annotated[
        Literal["measured", "simulated", "virtual", "both"],
        Field(
            description="`virtual`: a finite-element run, of which `measured` is asked too, except the "
            "room's temperature, humidity and soak time."
        ),
    ] = "measured"
    required: Annotated[bool, Field(description="False: checked when it was recorded, else only named.")] = (
        True
    )

    @model_validator(mode="after")
    def _has_order(self) -> Self:
        if self.dimension not in UNITS:
            message = f"`{self.dimension}` is no dimension; {suggestion(self.dimension, list(UNITS))}"
            raise Faults([(("dimension",), message)])
        faults: list[Fault] = []
        values = []
        for index, text in enumerate(self.within):
            try:
                values.append(parse_quantity(text, self.dimension))
            except ValueError as error:
                faults.append((("within", index), str(error)))
        if not faults and values[0] > values[1]:
            faults.append((("within",), f"{self.within[0]} lies above {self.within[1]}; exchange them"))
        if faults:
            raise Faults(faults)
        return self

    def lines(self) -> dict[str, str]:
        """Return `18 °C to 22 °C`."""
        return {"": f"{self.within[0]} to {self.within[1]}"}


class Procedure(Section):
    """A test: specimen, rig, run, criteria, preconditions, reference."""

    procedure: Annotated[str, Field(description="Its name.")]
    title: str
    method: Method
    specimen: Specimen = Specimen()
    vehicle: Annotated[str | None, Field(description="Name of the vehicle that is hit.")] = None
    rig: Rig
    run: Run = Run()
    criteria: Annotated[list[Criterion], Field(min_length=1, max_length=200)]
    preconditions: list[Precondition] = []
    reference: str | None = None
    score: Annotated[str | None, Field(description="Corridor set whose scores are shown.")] = None
    notes: list[str] = []

    origin_keys: ClassVar[frozenset[str]] = frozenset({"origin", "method"})

    @property
    def test_kind(self) -> "TestKind":
        """Return `static`, `dynamic` or `flight`, as its rig's fixtures say."""
        return self.rig.test_kind

    @property
    def corridor_sets(self) -> set[str]:
        """Return the names of the corridor sets that its criteria are held against."""
        return {c.corridor.partition("/")[0] for c in self.criteria if c.corridor}

    @model_validator(mode="before")
    @classmethod
    def _origin_from_method(cls, data: Any) -> Any:  # noqa: ANN401  # raw YAML data
        """Let bare numbers of rig and run come from the text that the procedure follows."""
        if not isinstance(data, dict) or "origin" in data or not isinstance(data.get("method"), dict):
            return data
        try:
            method = Method.model_validate(data["method"])
        except ValueError:
            # The method's faults are reported where they stand; numbers without an origin are no news then.
            return {**data, "origin": {"source": "a method that cannot be read", "confidence": "estimated"}}
        return {**data, "origin": {"source": method.words, "confidence": method.confidence}}
