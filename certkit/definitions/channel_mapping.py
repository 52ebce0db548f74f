"""The mapping file: how a laboratory's columns, codes and words become certkit's channels and conditions."""

from __future__ import annotations

import re
from typing import Annotated, Any, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from certkit.definitions.base import Document
from certkit.definitions.filters import Filter
from certkit.definitions.loading.channel_tables import channels_in
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import UNITS
from certkit.definitions.virtual_test import FiniteElements, LegformModel

Sign = Literal[1, -1]


class Column(Document):
    """One column of a CSV file."""

    column: Annotated[str | int, Field(description="Its head, or its number counted from 1.")]
    unit: str
    sign: Annotated[Sign, Field(description="-1 turns the laboratory's polarity into certkit's.")] = 1
    filter: Annotated[Filter, Field(description="Filter the values have already seen.")] = "none"
    amplitude_class: Annotated[str | None, Field(description="Where the channel clips: `400 N·m`.")] = None


class TimeColumn(Document):
    """The time axis: a column with its unit, or a sampling interval with the time of the first sample."""

    column: str | int | None = None
    unit: str = "s"
    sampling_interval: Annotated[str | None, Field(description="`0.05 ms`, where no column has time.")] = None
    first_sample: Annotated[str, Field(description="Time of the first sample after contact.")] = "0 s"


class CsvLayout(Document):
    """How a CSV file is written."""

    delimiter: Literal[",", ";", "tab", "|"] = ","
    decimal: Literal[".", ","] = "."
    head: Annotated[int, Field(ge=0, le=1000, description="Number of the line with the column heads.")] = 1
    skip: Annotated[int, Field(ge=0, le=1000, description="Lines between heads and data.")] = 0
    time: TimeColumn
    columns: Annotated[dict[str, Column], Field(min_length=1, max_length=500)]

    @model_validator(mode="after")
    def _known_channels(self, info: ValidationInfo) -> Self:
        faults = _unknown("columns", self.columns, info)
        if self.delimiter == "," == self.decimal:
            faults.append(
                (("decimal",), "the comma cannot be delimiter and decimal sign; name the delimiter")
            )
        if self.time.column is None and self.time.sampling_interval is None:
            faults.append((("time",), "needs a `column`, or a `sampling interval` such as `0.05 ms`"))
        if faults:
            raise Faults(faults)
        return self


class Condition(Document):
    """A condition of the test: its word, its dimension, and the ISO-MME descriptor that carries it."""

    dimension: str
    descriptor: str | None = None
    unit: Annotated[str, Field(description="Unit of a bare number under that descriptor.")] = ""


class MmeTable(Document):
    """How ISO-MME codes and descriptors are understood."""

    codes: Annotated[
        dict[str, list[str]],
        Field(description="By channel: code patterns of 16 characters, `?` for any; the first is written."),
    ] = {}
    signs: dict[str, Sign] = {}
    conditions: dict[str, Condition] = {}

    @model_validator(mode="after")
    def _can_be_used(self, info: ValidationInfo) -> Self:
        faults = _unknown("codes", self.codes, info) + _unknown("signs", self.signs, info)
        for name, patterns in self.codes.items():
            for index, pattern in enumerate(patterns):
                if not re.fullmatch(r"[A-Z0-9?#]{16}", pattern):
                    message = f"`{pattern}` is no code of 16 characters; use A to Z, 0 to 9, and `?` for any"
                    faults.append((("codes", name, index), message))
        for word, condition in self.conditions.items():
            if condition.dimension not in UNITS:
                hint = suggestion(condition.dimension, UNITS)
                message = f"no dimension is called `{condition.dimension}`; {hint}"
                faults.append((("conditions", word, "dimension"), message))
        if faults:
            raise Faults(faults)
        return self


def _unknown(key: str, names: dict[str, Any], info: ValidationInfo) -> list[Fault]:
    """Find names that are no channels of the legform."""
    if not names:
        return []
    known = channels_in(info).kinds
    return [
        ((key, name), f"no channel is called `{name}`; {suggestion(name, known)}")
        for name in names
        if name not in known
    ]


class Mapping(Document):
    """A laboratory's way of writing its files. What it does not name stays as in certkit's own table."""

    mapping: Annotated[str, Field(description="Its name.")]
    title: str = ""
    source: str = ""
    csv: CsvLayout | None = None
    mme: MmeTable = MmeTable()
    finite_elements: Annotated[
        FiniteElements | None, Field(description="Of a finite-element run: a virtual test.")
    ] = None
    legform_model: Annotated[
        LegformModel | None, Field(description="Of a virtual test that comes as ISO-MME or CSV.")
    ] = None
    conditions: Annotated[dict[str, str], Field(description="Conditions the files do not tell.")] = {}

    @model_validator(mode="after")
    def _known_channels_of_the_run(self, info: ValidationInfo) -> Self:
        if self.finite_elements is not None:
            faults = _unknown("channels", self.finite_elements.channels, info)
            if faults:
                raise Faults([(("finite elements", *path), said) for path, said in faults])
        return self
