"""The laboratory file `lab.yaml`: who tested what, when, with which sensors, and by which decision rule.

It holds what ISO/IEC 17025:2017, 7.8.2, asks of a report. What never changes may stand in a file of its own,
which each test's file names as `shared`.
"""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field, ValidationInfo, model_validator

from certkit.definitions.base import Document
from certkit.definitions.loading.channel_tables import channels_in, default_channels
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import parse_quantity

if TYPE_CHECKING:
    from certkit.definitions.channels import ChannelTable

Words = Annotated[str, Field(min_length=1, max_length=2_000)]


def _numbers_apart(pattern: str) -> str:
    """Check that a pattern makes another report number of each count."""
    try:
        made = {pattern.format(year=2026, number=count) for count in (1, 2, 10)}
    except (KeyError, ValueError, IndexError, AttributeError) as error:
        raise ValueError(f"`{pattern}` is no pattern: write `ECL-{{year}}-{{number:04}}`") from error
    if len(made) < 3:
        raise ValueError(f"`{pattern}` gives every report the same number; it needs `{{number}}`")
    return pattern


class Customer(Document):
    """Who ordered the test."""

    name: Words
    address: Words | None = None
    reference: Words | None = None


class Item(Document):
    """The legform that was tested."""

    serial: Annotated[Words, Field(description="Serial number; the logbook is kept by it.")]
    legform: Annotated[
        Words | None, Field(description="What it is; the procedure's impactor when missing.")
    ] = None
    condition: Words | None = None
    received: date | None = None


class TestDetails(Document):
    """When and where it was tested, under which number, and which earlier report it takes the place of."""

    performed: date
    number: Annotated[Words | None, Field(description="Number of the report.")] = None
    revision: Annotated[int, Field(ge=0, le=999, description="Of the report; 0 is the first.")] = 0
    issued: date | None = None
    place: Annotated[Words | None, Field(description="Where it was tested, if not at the laboratory.")] = None
    method_deviations: Words | None = None
    replaces: Annotated[
        Words | None, Field(description="Number of the report that this one replaces, or its id.")
    ] = None
    reason: Annotated[Words | None, Field(description="Why the earlier report is replaced.")] = None
    changes: Annotated[Words | None, Field(description="What is changed against the earlier report.")] = None

    @model_validator(mode="after")
    def _amends_with_a_reason(self) -> Self:
        """Refuse an amended report that does not say what it replaces, why, and what was changed (7.8.8)."""
        amended = {"replaces": self.replaces, "reason": self.reason, "changes": self.changes}
        missing = [name for name, words in amended.items() if words is None]
        if missing and (len(missing) < len(amended) or self.revision):
            said = f"an amended report names {', '.join(amended)}; `{missing[0]}` is missing"
            raise Faults([((), f"{said} (revision 0 is the first report, which replaces none)")])
        return self


class Person(Document):
    """Somebody who answers for the test."""

    name: Words
    role: Annotated[Words, Field(description="`performed the test`, `authorised the report`.")]
    signs: Annotated[
        bool, Field(description="Has a line for a signature; others get one until there are two.")
    ] = False


class Instrument(Document):
    """Something with a calibration."""

    serial: Words
    calibrated: date
    expires: date

    def covers(self, day: date) -> bool:
        """Tell whether the calibration holds on a day, its last one included."""
        return self.calibrated <= day <= self.expires


class Sensor(Instrument):
    """A sensor with its calibration."""

    channel: str
    type: Words | None = None


class Equipment(Instrument):
    """Other equipment that the result depends on: speed trap, balance, thermometer, data recorder."""

    name: Words


class Numbering(Document):
    """How report numbers are given out where a test names none."""

    pattern: Annotated[
        Words,
        Field(description="`ECL-{year}-{number:04}`; `{year}` and `{number}` are filled in."),
        AfterValidator(_numbers_apart),
    ]
    register_: Annotated[
        Words, Field(description="File beside this one that keeps which report has which number.")
    ] = "report-numbers.csv"


class LaboratoryDecision(Document):
    """How a value near its limit is decided (ILAC-G8:09/2019)."""

    rule: Literal["simple acceptance", "guard band"] = "simple acceptance"
    r: Annotated[float, Field(gt=0, le=3, description="Guard band w = r·U; r = 1 is the usual one.")] = 1.0


class Laboratory(Document):
    """Everything a report says about the laboratory and its test."""

    laboratory: Annotated[Words, Field(description="Its name.")]
    shared: Annotated[
        Words | None,
        Field(
            description="File beside this one with what is the same for every test. Lists are joined, "
            "mappings merged; anything else is taken from here."
        ),
    ] = None
    place: Words | None = None
    country: Annotated[
        str | None,
        Field(pattern="^[A-Z]{2}$", description="ISO 3166-1 code, such as DE; a DCC asks for it."),
    ] = None
    contact: Words | None = None
    accreditation: Words | None = None
    logo: Annotated[str | None, Field(description="PNG or JPEG beside this file.")] = None
    customer: Customer | None = None
    item: Item | None = None
    test: TestDetails | None = None
    numbering: Numbering | None = None
    persons: Annotated[list[Person], Field(max_length=50)] = []
    sensors: Annotated[list[Sensor], Field(max_length=200)] = []
    equipment: Annotated[list[Equipment], Field(max_length=200)] = []
    decision: LaboratoryDecision = LaboratoryDecision()
    uncertainties: Annotated[
        dict[str, str], Field(description="Expanded uncertainty U (k = 2) by channel: `T1: 4 N·m`.")
    ] = {}
    conditions: Annotated[
        dict[str, str], Field(description="Conditions of the test: `temperature: 20.4 degC`.")
    ] = {}

    @model_validator(mode="after")
    def _fits_together(self, info: ValidationInfo) -> Self:
        channels = channels_in(info)
        faults: list[Fault] = [
            (
                ("sensors", index, "channel"),
                f"no channel is called `{sensor.channel}`; {suggestion(sensor.channel, channels.kinds)}",
            )
            for index, sensor in enumerate(self.sensors)
            if sensor.channel not in channels.kinds
        ]
        faults += [
            (
                (key, index, "expires"),
                f"expires {each.expires}, before it was calibrated; correct one of the days",
            )
            for key, listed in (("sensors", self.sensors), ("equipment", self.equipment))
            for index, each in enumerate(listed)
            if each.expires < each.calibrated
        ]
        faults += self._uncertainty_faults(channels)
        faults += self._order_faults()
        whole = self.shared is None and self.item is not None and self.test is not None
        if self.shared is None and self.place is None:
            faults.append(((), "`place` is missing: where the laboratory is"))
        if self.shared is None and (self.item is None) != (self.test is None):
            missing = "item" if self.item is None else "test"
            faults.append(((), f"`{missing}` is missing; only a file that others share has neither"))
        if whole and self.decision.rule == "guard band" and not self.uncertainties:
            faults.append((("decision", "rule"), "a guard band needs `uncertainties`; give U by channel"))
        if faults:
            raise Faults(faults)
        return self

    def _uncertainty_faults(self, channels: ChannelTable) -> list[Fault]:
        faults: list[Fault] = []
        for name in self.uncertainties:
            if name not in channels.kinds:
                message = f"no channel is called `{name}`; {suggestion(name, channels.kinds)}"
                faults.append((("uncertainties", name), message))
                continue
            try:
                if self.uncertainty(name, channels) <= 0:
                    faults.append(
                        (
                            ("uncertainties", name),
                            (
                                "an expanded uncertainty is greater than zero"
                                "; leave it out where it is not known"
                            ),
                        )
                    )
            except ValueError as error:
                faults.append((("uncertainties", name), str(error)))
        return faults

    def _order_faults(self) -> list[Fault]:
        """Tell days that come in another order than receipt, test, issue."""
        if self.test is None:
            return []
        received = self.item.received if self.item else None
        faults: list[Fault] = []
        if received and received > self.test.performed:
            faults.append(
                (("item", "received"), f"received {received}, after the test; correct one of the days")
            )
        if self.test.issued and self.test.issued < self.test.performed:
            faults.append(
                (("test", "issued"), f"issued {self.test.issued}, before the test; correct one of the days")
            )
        return faults

    def uncertainty(self, channel: str, channels: ChannelTable | None = None) -> float:
        """Return the expanded uncertainty of a channel in SI units; `channels` are the legform's.

        Raises
        ------
        KeyError
            When the file names none.
        """
        kind = (channels or default_channels()).kinds[channel]
        return parse_quantity(self.uncertainties[channel], kind.dimension.quantity)

    def header(self, logo: str | None = None) -> dict[str, Any]:
        """Return what the report's header shows, as plain data; `logo` is an embedded picture."""
        entries: dict[str, Any] = {
            "laboratory": self.laboratory,
            "place": self.place,
            "country": self.country,
            "contact": self.contact,
            "accreditation": self.accreditation,
            "logo": logo,
        }
        for name, part in (("customer", self.customer), ("item", self.item), ("test", self.test)):
            entries[name] = (
                part.model_dump(mode="json", exclude_none=True, exclude_defaults=True) if part else None
            )
        entries["persons"] = [
            person.model_dump(mode="json", exclude_defaults=True) for person in self.persons
        ]
        for name in ("sensors", "equipment"):
            listed = getattr(self, name)
            entries[name] = [each.model_dump(mode="json", exclude_none=True) for each in listed]
        return {name: entry for name, entry in entries.items() if entry not in (None, [])}
