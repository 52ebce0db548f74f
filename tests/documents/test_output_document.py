"""Every document has one idiom: schema, id of its rounded content, same bytes, clear refusals."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, get_args, get_origin

import pytest
from pydantic import BaseModel, Field

from certkit.documents.document_kinds import DOCUMENTS, document_class, documents_from, read_documents
from certkit.documents.output_document import NOT_IN_ID, OutputDocument, Part, listed_json
from certkit.documents.rounding import Figure, Figures
from certkit.errors import DataError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

KINDS = [document_class(word) for word in DOCUMENTS]


class Reading(Part):
    """A part with a field that depends on the clock."""

    value: Figure
    seconds: Annotated[float, NOT_IN_ID] = 0.0


class Sheet(OutputDocument):
    """A small document."""

    noun: ClassVar = "sheet"
    file_name: ClassVar = "sheet.json"
    made_by: ClassVar = "certkit sheet"

    schema_: Annotated[Literal["certkit-sheet/1"], Field(alias="schema")] = "certkit-sheet/1"
    first: Reading
    several: list[Reading] = Field(default_factory=list)
    named: dict[str, Reading] = Field(default_factory=dict)
    perhaps: Reading | None = None
    curve: Figures = Field(default_factory=list)


def sheet(value: float = 1.25, seconds: float = 0.0, **more: object) -> Sheet:
    reading = Reading(value=value, seconds=seconds)
    return Sheet(
        first=reading, several=[reading, reading], named={"a": reading}, perhaps=reading, **more
    ).with_id()


def test_an_id_covers_values_in_every_place():
    base = sheet()
    other = Reading(value=1.5)
    for change in (
        {"first": other},
        {"several": [base.first, other]},
        {"named": {"a": other}},
        {"perhaps": other},
        {"curve": [0.5]},
    ):
        assert base.model_copy(update=change).content_id() != base.id


def test_an_id_leaves_out_what_is_marked_in_every_place():
    assert sheet(seconds=1.0).id == sheet(seconds=2.0).id


def test_an_id_is_of_rounded_values():
    assert sheet(1.25 * (1 + 1e-15)).id == sheet(1.25).id
    assert sheet(1.250001).id != sheet(1.25).id
    third = sheet(1 / 3, curve=[1 / 3, 2 / 3])
    assert third.as_written().content_id() == third.id


def test_a_document_is_read_back_as_it_was_written(tmp_path: Path):
    path = tmp_path / "deep" / "sheet.json"
    sheet(1 / 3).write(path)
    again = Sheet.read(path)
    assert again.to_json() == path.read_text(encoding="utf-8") == sheet(1 / 3).to_json()
    assert again.content_id() == again.id


def test_what_could_not_be_read_back_is_not_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    document = sheet()
    monkeypatch.setattr("certkit.documents.output_document.MAX_DOCUMENT_VALUES", 3)
    with pytest.raises(DataError, match=r"more values than a document can have.*nothing was written"):
        document.write(tmp_path / "out" / "x.json")
    assert not (tmp_path / "out").exists()


def test_damage_is_told_with_its_line_and_column():
    with pytest.raises(
        DataError, match=r"^here\.json:2:\d+: damaged: .*; make it again with `certkit sheet`"
    ):
        Sheet.from_json('{"schema":"certkit-sheet/1",\n"first": oops}', "here.json")


def test_a_fault_in_a_part_is_told_with_its_place():
    tree = json.loads(sheet().to_json())
    tree["several"][1]["value"] = "much"
    with pytest.raises(DataError, match=r"not a certkit sheet: several\.1\.value"):
        Sheet.from_json(json.dumps(tree))


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_every_kind_says_what_it_is(kind: type[OutputDocument]):
    assert kind.schema_word().startswith("certkit-")
    assert kind.file_name.endswith(".json")
    assert kind.noun
    assert kind.made_by.startswith("certkit ")
    schema = kind.model_json_schema(by_alias=True)
    assert list(schema["properties"])[:2] == ["schema", "id"]


def test_no_two_kinds_have_one_schema_or_one_file():
    for of in (OutputDocument.schema_word.__func__, lambda kind: kind.file_name, lambda kind: kind.noun):
        assert len({of(kind) for kind in KINDS}) == len(KINDS)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_every_number_of_a_document_is_written_rounded(kind: type[OutputDocument]):
    bare = [place for place in _bare_floats(kind, kind.__name__) if not place.endswith(".solver_seconds")]
    assert bare == []


def _bare_floats(model: type[BaseModel], place: str) -> Iterator[str]:
    for name, info in model.model_fields.items():
        written = [mark for mark in info.metadata if type(mark).__name__ == "PlainSerializer"]
        if not written:
            yield from _bare(info.annotation, f"{place}.{name}")


def _bare(annotation: object, place: str) -> Iterator[str]:
    if annotation is Reason:
        return  # rounds its numbers when it is made
    if annotation is float:
        yield place
    elif isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield from _bare_floats(annotation, place)
    elif get_origin(annotation) is Annotated:
        if not any(type(mark).__name__ == "PlainSerializer" for mark in get_args(annotation)):
            yield from _bare(get_args(annotation)[0], place)
    else:
        for inner in get_args(annotation):
            yield from _bare(inner, place)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no document of certkit"),
        ("{", "damaged"),
        ("\x00", "no document of certkit"),
        ("[" * 100_000, "damaged"),
        ("{}", "names no schema"),
        ("3", "names no schema"),
        ('["a"]', "item 1: no document"),
        ('{"schema": "certkit-result/9"}', "its schema is `certkit-result/9`"),
        ('{"schema": "certkit-comparison/1"}', "not a certkit comparison"),
    ],
)
def test_what_is_no_document_is_refused_in_one_line(text: str, said: str, tmp_path: Path):
    path = tmp_path / "x.json"
    path.write_text(text)
    with pytest.raises(DataError, match=said) as caught:
        read_documents(path)
    assert "\n" not in str(caught.value)
    assert str(path) in str(caught.value)


def test_a_kind_is_known_wherever_its_schema_stands_in_the_file():
    from support import synthetic_result  # noqa: PLC0415  # only here

    result = synthetic_result.static_result()
    tree = json.loads(result.to_json())
    turned = json.dumps(dict(reversed(tree.items())))
    for content in (result.to_json(), turned, listed_json([result])):
        (found,) = documents_from(content.encode(), "result.json")
        assert found.to_json() == result.to_json()
