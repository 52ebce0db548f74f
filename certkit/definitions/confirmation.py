"""The confirmation of a definition: a person held its numbers against a text that lay on the desk."""

import re
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from certkit.definitions.base import Document
from certkit.definitions.loading.faults import Faults

SHA256 = re.compile(r"[0-9a-f]{64}")
DAY = re.compile(r"\d{4}-\d\d-\d\d")
SHOWN = 12
"""Digits of a text's hash that a source shows; the file has all 64."""


def _matching(pattern: re.Pattern[str], message: str) -> AfterValidator:
    def check(text: str) -> str:
        if pattern.fullmatch(text) is None:
            raise ValueError(f"`{text}` {message}")
        return text

    return AfterValidator(check)


Day = Annotated[str, _matching(DAY, "is no day; write 2026-03-31")]


class ReadText(Document):
    """The text that was read: title and edition, and the hash of the file where it was one."""

    title: Annotated[str, Field(min_length=3, description="Text and edition: `UN R127, 02 series`.")]
    file: str = ""
    sha256: Annotated[str, _matching(SHA256, "is no SHA-256 of 64 hexadecimal digits")] | None = None


class Signature(Document):
    """Who, and when."""

    by: Annotated[str, Field(min_length=2, max_length=200)]
    day: Day


class ConfirmedNumber(Document):
    """One number, or corridor, as it was held against the text."""

    answer: Annotated[
        Literal["yes", "no"],
        Field(description="Whether the text says so."),
    ]
    value: Annotated[str, Field(description="The number that was asked about; another one is not confirmed.")]
    place: Annotated[str, Field(description="Page or clause.")] = ""
    by: Annotated[str, Field(min_length=2, max_length=200)]
    day: Day
    countersigned: Signature | None = None

    @model_validator(mode="after")
    def _two_persons(self) -> Self:
        other = self.countersigned
        if other is not None and other.by.strip().casefold() == self.by.strip().casefold():
            raise Faults([(("countersigned", "by"), f"`{other.by}` read it; another person countersigns")])
        return self


class Confirmation(Document):
    """The numbers of one definition that were held against a text."""

    confirmation: Annotated[str, Field(description="Kind and name: `corridors-r127-pendulum`.")]
    text: ReadText
    numbers: Annotated[dict[str, ConfirmedNumber], Field(max_length=10_000)] = {}

    def source(self, number: ConfirmedNumber) -> str:
        """Return a confirmed number's source, as verdicts and lists show it."""
        place = f", {number.place}" if number.place else ""
        file = f" (SHA-256 {self.text.sha256[:SHOWN]}…)" if self.text.sha256 else ""
        second = number.countersigned
        also = f", countersigned by {second.by} on {second.day}" if second else ""
        return f"{self.text.title}{place}{file}; read by {number.by} on {number.day}{also}"
