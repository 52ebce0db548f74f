"""The JSON Schemas accept what certkit accepts, so that an editor's opinion can be trusted."""

from __future__ import annotations

from typing import Any

import jsonschema
import pytest

from certkit.definitions.loading.catalogue import catalogue
from certkit.definitions.loading.json_schema import DIALECT, schema_of
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import find
from certkit.definitions.loading.yaml_reader import read_tree

ENTRIES = [(entry.kind, entry.name) for entry in catalogue()]


def data(kind: str, name: str) -> dict[str, Any]:
    found = find(KINDS[kind], name)
    return read_tree(found.data, found.file).data


def errors(kind: str, document: object) -> list[str]:
    checker = jsonschema.Draft202012Validator(schema_of(KINDS[kind]))
    return [error.message for error in checker.iter_errors(document)]


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_a_schema_with_title_and_description(kind: str):
    schema = schema_of(KINDS[kind])
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["$schema"] == DIALECT
    assert schema["title"].startswith("certkit ")
    assert schema["description"]
    assert kind in schema["properties"]


@pytest.mark.parametrize(("kind", "name"), ENTRIES)
def test_every_shipped_file_fits_its_schema(kind: str, name: str):
    assert errors(kind, data(kind, name)) == []


def test_a_misspelt_key_and_a_wrong_choice_do_not_fit():
    document = data("procedure", "pendulum")
    assert errors("procedure", document | {"tittle": "x"})
    assert errors("procedure", document | {"specimen": {"flesh": "on"}})


def test_a_word_may_look_like_a_number():
    document = data("procedure", "pendulum")
    assert errors("procedure", document | {"method": {"document": "UN R127", "annex": 6}}) == []


def test_keys_are_described_for_whoever_hovers_over_them():
    properties = schema_of(KINDS["legform"])["$defs"]["Bone"]["properties"]
    assert properties["centre of gravity"]["description"] == "From the top of the part."
