"""JSON Schemas of the definitions, with which editors complete and check the YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic.json_schema import GenerateJsonSchema

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic.json_schema import JsonSchemaValue
    from pydantic_core import core_schema

    from certkit.definitions.loading.kinds import Kind

DIALECT = "https://json-schema.org/draft/2020-12/schema"


class _Yaml(GenerateJsonSchema):
    """Describes documents as they are written: a word may look like a number (`annex: 6`)."""

    def str_schema(self, schema: core_schema.StringSchema) -> JsonSchemaValue:
        described = super().str_schema(schema)
        return described | {"type": ["string", "number"]}


def schema_of(kind: Kind) -> dict[str, Any]:
    """Return the JSON Schema of one kind of definition."""
    return described(kind.model, f"certkit {kind.noun}", f"A certkit {kind.noun}: {kind.title}.")


def described(model: type[BaseModel], title: str, description: str) -> dict[str, Any]:
    """Return the JSON Schema of a document's class, with its own title and description."""
    schema = model.model_json_schema(by_alias=True, schema_generator=_Yaml)
    return {"$schema": DIALECT, **schema, "title": title, "description": description}
