"""Presets written: they read back equal, unknown keys and all, in a stable and readable form."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given

from hqmodel.files import PresetError, dumps, load, parse, save
from hqmodel.model import Scene, Shape, Strip
from tests.strategies import presets, scenes


@given(scenes())
def test_what_is_written_reads_back_equal_and_is_written_the_same_again(scene: Scene) -> None:
    text = dumps(scene)
    again = parse(text.encode(), "a.json")
    assert again == scene
    assert dumps(again) == text


@given(presets())
def test_unknown_keys_are_written_where_they_were(tree: dict[str, Any]) -> None:
    written = json.loads(dumps(parse(json.dumps(tree).encode(), "a.json")))

    def unknown(data: dict[str, Any]) -> dict[str, Any]:
        return {key: value for key, value in data.items() if key.startswith("x-")}

    assert unknown(written) == unknown(tree)
    for new, old in zip(written["shapes"], tree["shapes"], strict=True):
        assert unknown(new) == unknown(old)
        for new_strip, old_strip in zip(new["strips"], old["strips"], strict=True):
            assert unknown(new_strip) == unknown(old_strip)


def test_the_text_is_for_people_too() -> None:
    strip = {"normal": [1, 0, 0], "gamma": 40, "group": "rim", "tag": "side"}
    tree = {
        "shapes": [{"strips": [strip, {"normal": [0, 0, 1]}], "groups": {"rim": {"gamma": 40}}, "name": "Böden"}],
        "maker": {"tool": [1, 2.5]},
    }
    assert dumps(Scene.model_validate(tree)) == (
        "{\n"
        '  "format": "hqmodel",\n'
        '  "version": 1,\n'
        '  "name": "",\n'
        '  "description": "",\n'
        '  "author": "",\n'
        '  "license": "",\n'
        '  "dimension": 3,\n'
        '  "slice": 0.0,\n'
        '  "level": 1.0,\n'
        '  "shapes": [\n'
        "    {\n"
        '      "name": "Böden",\n'
        '      "coefficient": 1.0,\n'
        '      "hardness": 1.0,\n'
        '      "constant": 1.0,\n'
        '      "color": [0.78, 0.55, 0.42],\n'
        '      "visible": true,\n'
        '      "mirror": [],\n'
        '      "transform": {"translation": [0.0, 0.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0], "scale": [1.0, 1.0, 1.0]},\n'
        '      "groups": {"rim": {"gamma": 40.0}},\n'
        '      "strips": [\n'
        '        {"normal": [1.0, 0.0, 0.0], "gamma": 40.0, "group": "rim", "tag": "side"},\n'
        '        {"normal": [0.0, 0.0, 1.0], "gamma": 2.0}\n'
        "      ]\n"
        "    }\n"
        "  ],\n"
        '  "view": {},\n'
        '  "animations": [],\n'
        '  "maker": {"tool": [1, 2.5]}\n'
        "}\n"
    )


def test_flat_normals_have_two_components() -> None:
    scene = Scene(shapes=(Shape(strips=(Strip(normal=(1.0, 0.5, 0.0)),)),), dimension=2)
    assert '"normal": [1.0, 0.5]' in dumps(scene)
    assert parse(dumps(scene).encode(), "") == scene


def test_what_only_fits_without_blanks_is_saved_without(tmp_path: Path) -> None:
    scene = Scene.model_validate({"shapes": [], "points": [[0] * 4] * 310_000})
    assert len(dumps(scene)) > 4 << 20
    save(scene, tmp_path / "a.json")
    assert load(tmp_path / "a.json") == scene


def test_what_could_not_be_opened_again_is_not_saved(tmp_path: Path) -> None:
    scene = Scene.model_validate({"shapes": [], "points": [1.5] * 2_000_000})
    (tmp_path / "a.json").write_text("before")
    with pytest.raises(PresetError, match="expected a preset of at most 4 MiB, got 8000"):
        save(scene, tmp_path / "a.json")
    assert (tmp_path / "a.json").read_text() == "before"
