"""The laboratory file `lab.yaml`: who tested what, when, with which sensors, and by which decision rule.

It fills the header that ISO/IEC 17025:2017, 7.8.2, asks of a report.
"""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from certkit.definitions.base import Document
from certkit.definitions.loading.channel_tables import channels_in, default_channels
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import parse_quantity

if TYPE_CHECKING:
    from certkit.definitions.channels import ChannelTable

Words = Annotated[str, Field(min_length=1, max_length=2_000)]


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
    """When it was tested, and under which number."""

    performed: date
    number: Words | None = None
    issued: date | None = None
    method_deviations: Words | None = None


class Person(Document):
    """Somebody who answers for the test."""

    name: Words
    role: Annotated[Words, Field(description="`performed the test`, `authorised the report`.")]


class Sensor(Document):
    """A sensor with its calibration."""

    channel: str
    serial: Words
    type: Words | None = None
    calibrated: date
    expires: date


class LaboratoryDecision(Document):
    """How a value near its limit is decided (ILAC-G8:09/2019)."""

    rule: Literal["simple acceptance", "guard band"] = "simple acceptance"
    r: Annotated[float, Field(gt=0, le=3, description="Guard band w = r·U; r = 1 is the usual one.")] = 1.0


class Laboratory(Document):
    """Everything a report says about the laboratory and its test."""

    laboratory: Annotated[Words, Field(description="Its name.")]
    place: Words
    contact: Words | None = None
    accreditation: Words | None = None
    logo: Annotated[str | None, Field(description="PNG or JPEG beside this file.")] = None
    customer: Customer | None = None
    item: Item
    test: TestDetails
    persons: Annotated[list[Person], Field(max_length=50)] = []
    sensors: Annotated[list[Sensor], Field(max_length=200)] = []
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
            (("sensors", index, "expires"), f"expires {sensor.expires}, before it was calibrated")
            for index, sensor in enumerate(self.sensors)
            if sensor.expires < sensor.calibrated
        ]
        faults += self._uncertainty_faults(channels)
        if self.decision.rule == "guard band" and not self.uncertainties:
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
                    faults.append((("uncertainties", name), "an expanded uncertainty is greater than zero"))
            except ValueError as error:
                faults.append((("uncertainties", name), str(error)))
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

    @property
    def expired_sensors(self) -> list[Sensor]:
        """Sensors whose calibration did not cover the day of the test."""
        day = self.test.performed
        return [sensor for sensor in self.sensors if not sensor.calibrated <= day <= sensor.expires]

    def header(self, logo: str | None = None) -> dict[str, Any]:
        """Return what the report's header shows, as plain data; `logo` is an embedded picture."""
        entries: dict[str, Any] = {
            "laboratory": self.laboratory,
            "place": self.place,
            "contact": self.contact,
            "accreditation": self.accreditation,
            "logo": logo,
        }
        for name, part in (("customer", self.customer), ("item", self.item), ("test", self.test)):
            entries[name] = part.model_dump(mode="json", exclude_none=True) if part else None
        entries["persons"] = [person.model_dump(mode="json") for person in self.persons]
        entries["sensors"] = [sensor.model_dump(mode="json", exclude_none=True) for sensor in self.sensors]
        return {name: entry for name, entry in entries.items() if entry not in (None, [])}
