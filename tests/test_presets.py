"""The presets that come with the program, as an artist meets them: valid, described, bounded, closed, written canonically."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from hqmodel.field import Region, region
from hqmodel.files import Builtin, builtin, dumps, load
from hqmodel.mesh import polygonize, report
from hqmodel.model import Scene
from hqmodel.resources import folder

PRESETS = builtin()
STARTERS = [preset for preset in PRESETS if preset.collection == "starters"]
RESOLUTION = 40
# Starters are made by hand and of a size: they all fit the same grid, snapping steps and light.
SMALLEST, LARGEST = 1.5, 3.3

each = pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
each_starter = pytest.mark.parametrize("preset", STARTERS, ids=lambda preset: preset.name)


@cache
def scene(path: Path) -> Scene:
    return load(path)


@cache
def place(path: Path) -> Region:
    return region(scene(path))


@each
def test_is_valid_by_the_shipped_schema(preset: Builtin) -> None:
    schema = json.loads((folder("presets") / "hqmodel-1.schema.json").read_text(encoding="utf-8"))
    tree = json.loads(preset.path.read_text(encoding="utf-8"))
    assert [error.message for error in Draft202012Validator(schema).iter_errors(tree)] == []


@each
def test_says_what_it_is_and_may_be_used_freely(preset: Builtin) -> None:
    it = scene(preset.path)
    assert it.name == it.name.strip() != ""
    assert it.description.endswith(".")
    assert it.author == "hqmodel"
    assert it.license == "CC0-1.0"


@each
def test_its_parts_have_names_of_their_own(preset: Builtin) -> None:
    names = [shape.name for shape in scene(preset.path).shapes]
    assert all(names)
    assert len(set(names)) == len(names)


@each
def test_its_file_is_what_saving_would_write(preset: Builtin) -> None:
    assert preset.path.read_text(encoding="utf-8") == dumps(scene(preset.path))


@each
def test_has_a_body_with_an_end(preset: Builtin) -> None:
    where = place(preset.path)
    assert where.bounded
    assert not where.empty


@each
def test_its_mesh_is_closed_and_stays_in_its_box(preset: Builtin) -> None:
    mesh = polygonize(scene(preset.path), RESOLUTION)
    measured = report(mesh)
    assert measured["watertight"]
    assert measured["volume"] > 0
    slack = 7e-5 * np.max(place(preset.path).size)
    assert np.all(mesh.vertices >= place(preset.path).low - slack)
    assert np.all(mesh.vertices <= place(preset.path).high + slack)


def test_names_are_unique() -> None:
    assert len(PRESETS) > 0
    assert len({preset.title.casefold() for preset in PRESETS}) == len(PRESETS)
    assert len({preset.name.casefold() for preset in PRESETS}) == len(PRESETS)


def test_starters_show_the_range_of_the_format() -> None:
    shapes = [shape for preset in STARTERS for shape in scene(preset.path).shapes]
    strips = [strip for shape in shapes for strip in shape.strips]
    assert {scene(preset.path).dimension for preset in STARTERS} == {2, 3}
    assert {axis for shape in shapes for axis in shape.mirror} == {"x", "y", "z"}
    assert {strip.sign for strip in strips} == {1, -1}
    assert any(shape.groups for shape in shapes)
    assert any(shape.coefficient < 0 for shape in shapes)
    assert any(strip.slice for strip in strips)
    assert min(strip.gamma for strip in strips) < 1 < 100 < max(strip.gamma for strip in strips)


@each_starter
def test_starter_is_of_a_handy_size_about_the_origin(preset: Builtin) -> None:
    where = place(preset.path)
    assert SMALLEST <= np.max(where.size) <= LARGEST
    assert np.all(where.low <= 0.05)
    assert np.all(where.high > 0)
