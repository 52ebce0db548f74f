"""Reasons as codes with parameters: what stands beside a verdict, without the words of any language.

A reason is made where it is known (`Reason.of("channel-not-recorded", channel="T1")`) and worded where it is
read: `certkit.reporting.languages` has a sentence for each code in each language. So logic compares codes,
and a document's id does not depend on its language.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from pydantic import BaseModel, ConfigDict, Field, SerializerFunctionWrapHandler, model_serializer

from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Iterable

WORDS = "words"
"""Code of a user's own words: its parameter `text` is shown as it is, in every language."""

DIGITS = 7
"""Significant digits of a number among the parameters, as many as documents keep."""

Value = str | int | float | list[str] | list["Reason"]
"""What a parameter may be; a reason within a reason is a list of one, so that it is read back as it was."""


class Reason(BaseModel):
    """Why something is as it is: a code, the values that its sentence needs, and the English sentence.

    Parameters
    ----------
    code : str
        Of the catalogue in `certkit.reporting.languages`, such as `condition-outside`.
    parameters : mapping of str to Value
        Numbers are in the unit that the sentence names; a reason within it has no text of its own.
    text : str
        The English words; empty until the document is finished. No id covers it.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    code: str = Field(pattern="^[a-z0-9]+(-[a-z0-9]+)*$")
    parameters: dict[str, Value] = Field(default_factory=dict)
    text: str = ""

    @classmethod
    def of(cls, code: str, /, **parameters: Value | Reason) -> Self:
        """Return the reason of a code; a number that is not finite is written as a word."""
        return cls(code=code, parameters={name: _kept(value) for name, value in parameters.items()})

    @classmethod
    def words(cls, text: str) -> Self:
        """Return a user's own words as a reason."""
        return cls.of(WORDS, text=text)

    def worded(self, text: str) -> Self:
        """Return the reason with its English words."""
        return self if text == self.text else self.model_copy(update={"text": text})

    def __str__(self) -> str:
        """Return the words, or the code with its parameters where there are none yet."""
        if self.text:
            return self.text
        if self.code == WORDS:
            return str(self.parameters.get("text", ""))
        told = ", ".join(f"{name}={value}" for name, value in self.parameters.items())
        return f"{self.code} ({told})" if told else self.code

    def __hash__(self) -> int:
        """Return a hash, so that reasons can be kept in sets."""
        return hash((self.code, str(self.parameters)))

    @model_serializer(mode="wrap")
    def _without_empty_text(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Leave out words that are not there, and parameters where there are none."""
        dumped: dict[str, Any] = handler(self)
        return {name: value for name, value in dumped.items() if value or name == "code"}


class UnusableError(DataError):
    """Data that cannot be used for something, with the reason as a code beside the message."""

    def __init__(self, message: str, reason: Reason) -> None:
        """Keep the reason, so that whoever goes on without the data can tell it."""
        super().__init__(message)
        self.reason = reason


def reason_of(error: DataError) -> Reason:
    """Return why data cannot be used; an error without a code is told in its own words."""
    return error.reason if isinstance(error, UnusableError) else Reason.words(str(error))


def each_once(reasons: Iterable[Reason]) -> list[Reason]:
    """Return the reasons in their order, without repetition."""
    return list(dict.fromkeys(reasons))


def _kept(value: Value | Reason) -> Value:
    """Round numbers to the digits that a document keeps; take the words off reasons; list a single one."""
    if isinstance(value, Reason):
        return [value.worded("")]
    if isinstance(value, list):
        within = [each.worded("") for each in value if isinstance(each, Reason)]
        return within or value
    if isinstance(value, float):
        shown = float(f"{value:.{DIGITS}g}")
        return shown if abs(shown) < float("inf") else str(value)
    return value
