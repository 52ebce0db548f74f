"""The base of all documents: schema, JSON text, reading with clear errors, seven digits, and the id.

A document holds no objects, only words, numbers and lists, so that everything can be rendered from its JSON
alone. A kind of document is a subclass of `OutputDocument` in a file of its own, and a line in
`certkit.documents.document_kinds`. For what its files do not import from `__future__` see
`certkit.definitions.base`.
"""

import hashlib
import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Annotated, Any, ClassVar, Final, Self, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from certkit.documents.no_document import refuse_papers
from certkit.documents.wording import without_words
from certkit.errors import DataError
from certkit.files import write_whole
from certkit.files.bounded import read_bounded
from certkit.files.limits import MAX_DOCUMENT_BYTES, MAX_DOCUMENT_VALUES, MAX_DOCUMENT_WORDS
from certkit.plain_text import odd_character_in_json
from certkit.reasons import Reason

NOT_IN_ID: Final = object()
"""Marks a field (`Annotated[…, NOT_IN_ID]`) that depends on clock or machine: no id covers it."""

ID_LENGTH = 16
ID_GROUP = 4

MOST_FAULTS = 1000
"""Faults of a document that are looked at one by one."""

_DIGITS = bytes.maketrans(b"-123456789", b"0" * 10)
"""Makes one sign of all that a number can begin with, so that numbers are counted in one go."""

_LINE = re.compile(r"(.*?) at line (\d+) column (\d+)")


class Part(BaseModel):
    """Base of all parts of a document: no unknown fields, no NaN, never changed after it is made.

    Numbers are `Figure`, `Figures` and so on of `certkit.documents.rounding`: seven digits in the JSON and in
    the id, whatever the last bits of a machine are.
    """

    model_config = ConfigDict(
        extra="forbid",
        defer_build=True,  # a part is built with the document that holds it, not once for itself
        frozen=True,
        populate_by_name=True,
        serialize_by_alias=True,
        allow_inf_nan=False,
    )


class OutputDocument(Part):
    """What certkit writes: one JSON file with a schema and an id."""

    noun: ClassVar[str]
    """What it is called in messages: `result`, `comparison`, …"""

    file_name: ClassVar[str]
    """The file it is written to."""

    made_by: ClassVar[str]
    """The command that writes it."""

    schema_: Annotated[str, Field(alias="schema")]
    id: Annotated[str, Field(description="Certificate id: from the hash of the document's content.")] = ""

    @classmethod
    def schema_word(cls) -> str:
        """Return the schema's name and version, such as `certkit-result/1`."""
        return str(cls.model_fields["schema_"].default)

    def to_json(self) -> str:
        """Return the document as JSON text, in the schema's order, ending with a line feed.

        Numbers carry seven significant digits. Lists of parts have one part a line, every other field one
        line, so that the text can be read, searched and compared line by line though it holds whole
        channels. The same content gives the same bytes.
        """
        lines = []
        for name in type(self).model_fields:
            value = getattr(self, name)
            if isinstance(value, list | tuple) and value and isinstance(value[0], Part):
                rows = ",\n".join(f"    {row.model_dump_json()}" for row in value)
                lines.append(f'  "{name}": [\n{rows}\n  ]')
            else:
                lines.append(f"  {self.model_dump_json(include={name})[1:-1]}")
        return "{\n" + ",\n".join(lines) + "\n}\n"

    @classmethod
    def from_json(cls, content: str | bytes, name: str | None = None) -> Self:
        """Read the document from its JSON.

        Parameters
        ----------
        content : str or bytes
        name : str, optional
            The file, for messages; the usual name of such a document when missing.

        Raises
        ------
        DataError
            When it is too large, no JSON, or no document of this schema: says what and where.
        """
        name = name or cls.file_name
        check_size(content, name)
        text = content if isinstance(content, str) else content.decode("utf-8", errors="replace")
        refuse_papers(text, name)
        if odd := odd_character_in_json(text):
            raise DataError(
                f"{name}: holds the control character U+{ord(odd):04X}; certkit writes none"
                "; make the document again"
            )
        try:
            return cls.model_validate_json(content)
        except ValidationError as error:
            raise DataError(_refusal(error, name, cls)) from error

    @classmethod
    def file_at(cls, path: Path) -> Path:
        """Return the file that a path names: itself, or where the document stands in a folder."""
        return path / cls.file_name if path.is_dir() else path

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read the document from a file.

        Raises
        ------
        DataError
            When it is missing, cannot be read, or is damaged.
        """
        return cls.from_json(content_of(path, f"{cls.file_name} that `{cls.made_by}` wrote"), str(path))

    def write(self, path: Path) -> None:
        """Write the document; nobody ever sees half of it.

        Raises
        ------
        DataError
            When it is so large that nobody could read it back.
        """
        write_whole(path, self.readable_json())

    def readable_json(self) -> str:
        """Return `to_json`, if it may be read back.

        Raises
        ------
        DataError
            When it is larger than what `from_json` takes.
        """
        text = self.to_json()
        try:
            check_size(text, self.file_name)
        except DataError as error:
            raise DataError(f"{error}; nothing was written: take less into one {self.noun}") from error
        return text

    def as_written(self) -> Self:
        """Return the document with the digits that its JSON keeps.

        A report made in a run and one made later from the file then have the same bytes.
        """
        return self.model_validate_json(self.to_json())

    def content_id(self) -> str:
        """Return the id that the content makes, such as `3F9A-1C07-8B2E-44D1`: 64 bits of a SHA-256.

        It covers all fields but itself and those marked `NOT_IN_ID`, which depend on clock or machine, and
        not the words of coded reasons, which depend on the language. Numbers count with the seven digits of
        the file. Fields with their default value are left out too, so that a later certkit, whose document
        has more fields, comes to the same id.
        """
        left_out = {"id": True, **_outside(type(self))}
        counted = without_words(self).model_dump_json(exclude=left_out, exclude_defaults=True)
        digest = hashlib.sha256(counted.encode()).hexdigest()[:ID_LENGTH].upper()
        return "-".join(digest[i : i + ID_GROUP] for i in range(0, ID_LENGTH, ID_GROUP))

    def check_id(self, name: str) -> None:
        """Refuse a document whose content was changed since it got its id.

        Raises
        ------
        DataError
            When the id is not the one that the content makes; one without an id is unfinished, and told so.
        """
        made = self.content_id()
        if made != self.id:
            said = f"it says {self.id}, its content makes {made}" if self.id else "it has no id"
            raise DataError(
                f"{name}: its content was changed since certkit wrote it: {said}; `certkit verify` tells "
                "more, `--unverified` goes on nevertheless and says so on everything that is made of it"
            )

    def with_id(self) -> Self:
        """Return the document with its id filled in."""
        return self.model_copy(update={"id": self.content_id()})


def content_of(path: Path, wanted: str) -> bytes:
    """Read a document's file, if it is not too large.

    Parameters
    ----------
    path : Path
    wanted : str
        What should be named instead, for the message.

    Raises
    ------
    DataError
        When it is missing, cannot be read, or is too large.
    """
    try:
        return read_bounded(path, largest=MAX_DOCUMENT_BYTES)
    except DataError as error:
        raise DataError(f"{error}; name a {wanted}") from error


def check_size(content: str | bytes, name: str) -> None:
    """Refuse what no document can be, before anything is made of it.

    Raises
    ------
    DataError
        Above `MAX_DOCUMENT_BYTES`, or `MAX_DOCUMENT_VALUES`.
    """
    if len(content) > MAX_DOCUMENT_BYTES:
        raise DataError(
            f"{name}: {len(content)} bytes are more than a document can have ({MAX_DOCUMENT_BYTES})"
            "; make it again with less data"
        )
    data = content.encode() if isinstance(content, str) else content
    mappings = data.count(b"{")
    values = data.count(b",") + data.count(b"[") + mappings
    numbers = data.translate(_DIGITS).count(b",0")
    # A mapping takes the memory of two words, and more where each is told as a fault.
    if values > MAX_DOCUMENT_VALUES or values + mappings - numbers > MAX_DOCUMENT_WORDS:
        raise DataError(
            f"{name}: more values than a document can have ({MAX_DOCUMENT_VALUES})"
            "; make it again with less data"
        )


def _refusal(error: ValidationError, name: str, wanted: type[OutputDocument]) -> str:
    if error.error_count() > MOST_FAULTS:
        # Python would make a kilobyte of each.
        return (
            f"{name}: not a certkit {wanted.noun}: {error.error_count()} values are not what they should be"
        )
    first = error.errors(include_url=False, include_input=False)[0]
    if first["type"] == "json_invalid":
        found = _LINE.fullmatch(first["msg"])
        said, place = (found[1], f"{name}:{found[2]}:{found[3]}") if found else (first["msg"], name)
        return f"{place}: damaged: {said}; make it again with `{wanted.made_by}`"
    place = ".".join(str(step) for step in first["loc"]) or "the document"
    more = f" (and {error.error_count() - 1} more)" if error.error_count() > 1 else ""
    return f"{name}: not a certkit {wanted.noun}: {place}: {first['msg']}{more}"


@cache
def _outside(model: type[BaseModel]) -> dict[str, Any]:
    """Return the marked fields of a part and of the parts in it, as pydantic takes them to be excluded."""
    found: dict[str, Any] = {}
    for name, info in model.model_fields.items():
        if any(mark is NOT_IN_ID for mark in info.metadata):
            found[name] = True
        elif inner := _outside_of(info.annotation):
            found[name] = inner
    return found


def _outside_of(annotation: Any) -> dict[str, Any]:  # noqa: ANN401  # any type annotation
    if annotation is Reason:
        return {}  # its words are taken away before; reasons may hold reasons without end
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return _outside(annotation)
    found: dict[str, Any] = {}
    for inner in get_args(annotation):
        found |= _outside_of(inner)
    origin = get_origin(annotation)
    several = isinstance(origin, type) and issubclass(origin, list | tuple | dict)
    return {"__all__": found} if found and several else found


def listed_json(documents: Iterable[OutputDocument]) -> str:
    """Return several documents as one JSON list, which `certkit report` and `verify` read too."""
    return "[\n" + ",\n".join(each.to_json().rstrip("\n") for each in documents) + "\n]\n"
