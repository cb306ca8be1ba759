"""The JSON Schema of the format, generated from the values that validate it."""

from __future__ import annotations

import json
from typing import Any

from hqmodel.model import MAX_STRIPS, Scene

SCHEMA_NAME = "hqmodel-1.schema.json"


def schema() -> dict[str, Any]:
    """The JSON Schema (2020-12) of preset format 1.

    It cannot say that rotations are unit quaternions, that bounds are in order, that groups are named and agree, and how many
    strips there may be in all; loading checks those too.
    """
    tree = Scene.model_json_schema()
    definitions = tree.pop("$defs")
    tree["required"] = ["format", "version", "shapes"]
    tree["title"] = "hqmodel preset, format 1"
    definitions["Shape"]["properties"]["strips"].update(minItems=1, maxItems=MAX_STRIPS)
    definitions["Shape"]["properties"]["mirror"].update(uniqueItems=True)
    normal = definitions["Strip"]["properties"]["normal"]
    normal.update(minItems=2, contains={"not": {"const": 0}})
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **tree, **_dimensions(), "$defs": definitions}


def schema_text() -> str:
    """The schema as its file has it."""
    return json.dumps(schema(), indent=1, ensure_ascii=False) + "\n"


def _dimensions() -> dict[str, Any]:
    """In two dimensions a normal's z component is left out or 0, in three it is required."""
    return {
        "if": {"properties": {"dimension": {"const": 2}}, "required": ["dimension"]},
        "then": _normals({"prefixItems": [True, True, {"const": 0}]}),
        "else": _normals({"minItems": 3}),
    }


def _normals(rule: dict[str, Any]) -> dict[str, Any]:
    strip = {"properties": {"normal": rule}}
    shape = {"properties": {"strips": {"items": strip}}}
    return {"properties": {"shapes": {"items": shape}}}
