"""The JSON Schema: the shipped file is the generated one, holds the presets, and agrees with the loader."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from hqmodel.files import PresetError, builtin, dumps, parse, schema, schema_text
from hqmodel.model import Scene
from hqmodel.resources import folder
from tests.strategies import presets, scenes

VALIDATOR = Draft202012Validator(schema())
REFERENCE = sorted((Path(__file__).parents[1] / "reference").glob("*.json"))

# What a schema cannot say, in the loader's words.
UNSAYABLE = (
    "expected a unit quaternion",
    "expected a number above",  # of bounds, which are compared with each other
    "expected the name of a group",
    "like the group's other strips",
    "1 in a group",
    "expected at most 1024 groups",
    "strips in all",
)


def wrong(tree: Any) -> list[str]:
    return [error.message for error in VALIDATOR.iter_errors(tree)]


def complaints(tree: Any) -> list[str]:
    try:
        parse(json.dumps(tree).encode(), "a.json")
    except PresetError as error:
        return error.problems
    return []


def test_the_shipped_file_is_what_the_values_say() -> None:
    Draft202012Validator.check_schema(schema())
    assert (folder("presets") / "hqmodel-1.schema.json").read_text() == schema_text()


@pytest.mark.parametrize("path", [preset.path for preset in builtin()], ids=lambda path: path.stem)
def test_built_in_presets_are_valid(path: Path) -> None:
    assert wrong(json.loads(path.read_text())) == []


@pytest.mark.parametrize("path", REFERENCE, ids=lambda path: path.stem)
def test_reference_presets_are_valid(path: Path) -> None:
    tree = json.loads(path.read_text())["preset"]
    assert wrong(tree) == []
    assert complaints(tree) == []


@given(presets())
def test_what_loads_is_valid(tree: dict[str, Any]) -> None:
    assert complaints(tree) == []
    assert wrong(tree) == []


@given(scenes())
def test_what_is_saved_is_valid(scene: Scene) -> None:
    assert wrong(json.loads(dumps(scene))) == []


SCALARS: list[Any] = [None, True, False, 0, -1, 1, 2, 3, 1.5, 1e7, 0.05, 1000.5, "", "x", "rim"]
CONTAINERS: list[Any] = [[], {}, [1], [0, 0, 0], [1, 2], [1, 1, 1], [0, 0, 0, 1], [{}]]
JUNK = st.sampled_from(SCALARS + CONTAINERS)


def places(value: Any) -> list[tuple[Any, Any]]:
    """Every container in a tree with every key or index in it that the format knows."""
    if isinstance(value, dict):
        known = [key for key in value if not key.startswith("x-")]
        return [(value, key) for key in known] + [place for key in known for place in places(value[key])]
    if isinstance(value, list):
        return [(value, index) for index in range(len(value))] + [place for item in value for place in places(item)]
    return []


@given(presets(), st.data())
def test_what_the_schema_refuses_the_loader_refuses_and_back(tree: dict[str, Any], data: st.DataObject) -> None:
    container, key = data.draw(st.sampled_from(places(tree)))
    if data.draw(st.booleans()):
        container[key] = data.draw(JUNK)
    else:
        del container[key]
    found = complaints(tree)
    sayable = [problem for problem in found if not any(phrase in problem for phrase in UNSAYABLE)]
    assert bool(wrong(tree)) >= bool(sayable), sayable
    assert bool(found) >= bool(wrong(tree)), wrong(tree)
