"""Presets read: what is good comes through whole, what is bad is told by place, expected and got."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.files import PresetError, dumps, load, parse
from hqmodel.model import Scene
from tests.strategies import presets

GOOD = '{"format": "hqmodel", "version": 1, "shapes": [{"strips": [{"normal": [1, 0, 0]}]}]}'


def preset(**changes: Any) -> dict[str, Any]:
    return {**json.loads(GOOD), **changes}


def strip(**changes: Any) -> dict[str, Any]:
    return preset(shapes=[{"strips": [{"normal": [1, 0, 0], **changes}]}])


def shape(**changes: Any) -> dict[str, Any]:
    return preset(shapes=[{"strips": [{"normal": [1, 0, 0]}], **changes}])


def problems(data: bytes | dict[str, Any]) -> list[str]:
    with pytest.raises(PresetError) as caught:
        parse(data if isinstance(data, bytes) else json.dumps(data).encode(), "a.json")
    error = caught.value
    assert str(error).splitlines() == [f"a.json: {problem}" for problem in error.problems]
    assert len(error.headline.splitlines()) == 1
    return error.problems


def test_the_smallest_preset_has_the_defaults_of_the_format() -> None:
    scene = parse(GOOD.encode(), "a.json")
    (only,) = scene.shapes
    assert (scene.slice, scene.level, scene.dimension, scene.bounds) == (0.0, 1.0, 3, None)
    assert (only.coefficient, only.hardness, only.constant, only.visible, only.mirror) == (1.0, 1.0, 1.0, True, ())
    assert (only.transform.translation, only.transform.rotation) == ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    assert only.transform.scale == (1.0, 1.0, 1.0)
    (strip_,) = only.strips
    assert (strip_.slice, strip_.offset, strip_.half_width, strip_.gamma) == (0.0, 0.0, 1.0, 2.0)
    assert (strip_.sign, strip_.group) == (1, None)


@given(presets())
def test_every_valid_preset_loads(tree: dict[str, Any]) -> None:
    assert parse(json.dumps(tree).encode(), "a.json") == Scene.model_validate(tree)


def test_a_byte_order_mark_is_tolerated() -> None:
    assert parse(b"\xef\xbb\xbf" + GOOD.encode(), "a.json") == parse(GOOD.encode(), "a.json")


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"", "expected a preset, got an empty file"),
        (b" \n", "expected a preset, got an empty file"),
        (b"\xff\xfe{\x00}\x00", "byte 0: expected text in UTF-8, got 0xff"),
        (b'{"a": "\xe4"}', "byte 7: expected text in UTF-8, got 0xe4"),
        (b'{"a": 1,\n "b" 2}', "line 2, column 6: expected valid JSON, got '2}' (Expecting ':' delimiter)"),
        (b'{"a": 1', "line 1, column 8: expected valid JSON, got the end of the file (Expecting ',' delimiter)"),
        (GOOD.encode() + b"}", "line 1, column 85: expected valid JSON, got '}' (Extra data)"),
        (
            b"solid ball\n facet normal 0 0 1",
            "line 1, column 1: expected valid JSON, got 'solid ball\\n facet no' (Expecting value)",
        ),
        (b"[1, 2]", "expected an object at the top, got a list"),
        (b"null", "expected an object at the top, got null"),
        (b'"hqmodel"', "expected an object at the top, got 'hqmodel'"),
        (b"{}", 'format: expected "hqmodel", got nothing'),
        (b'{"asset": {"version": "2.0"}}', 'format: expected "hqmodel", got nothing'),
        (b'{"format": "hqmodel", "format": "hqmodel"}', "format: expected each key once, got it twice"),
        (b'{"a": [{"b": {"c": 1, "c": 2}}]}', "a[0].b.c: expected each key once, got it twice"),
        (b'{"a": [1, NaN]}', "a[1]: expected a finite number, got nan"),
        (b'{"a": -Infinity}', "a: expected a finite number, got -inf"),
        (b'{"a": 1e999}', "a: expected a finite number, got inf"),
        (b'{"a": ' + b"7" * 5000 + b"}", "a: expected a finite number, got inf"),
        (b'{"a": "\\udc00"}', "a: expected Unicode text, got '\\udc00'"),
        (b'{"\\udc00": 1}', "top: expected keys of Unicode text, got '\\udc00'"),
        (b'{"a": ' + b"[" * 70 + b"]" * 70 + b"}", "a[0][0]: expected at most 64 levels of nesting, got more"),
        (b"[" * 100_000, "expected at most 64 levels of nesting, got more"),
        (b'{"a":' * 100_000, "expected at most 64 levels of nesting, got more"),
        (b" " * (4 << 20) + b"{}", "expected a file of at most 4 MiB, got a larger one"),
    ],
    ids=lambda value: repr(value[:24]) if isinstance(value, bytes) else "",
)
def test_what_is_no_preset_is_told_in_one_line(data: bytes, problem: str) -> None:
    assert problems(data) == [problem]


@pytest.mark.parametrize(
    ("tree", "problem"),
    [
        (preset(format="gltf"), "format: expected \"hqmodel\", got 'gltf'"),
        ({"format": "hqmodel", "shapes": []}, "version: expected 1, got nothing"),
        (preset(version=2), "version: expected at most 1, got 2: a newer hqmodel saved this preset, update to open it"),
        (preset(version=0), "version: expected 1, got 0"),
        (preset(version=True), "version: expected 1, got true"),
        (preset(version="1"), "version: expected 1, got '1'"),
        (preset(version=1.5), "version: expected 1, got 1.5"),
        ({"format": "hqmodel", "version": 1}, "shapes: expected a list, got nothing"),
        (preset(shapes={}), "shapes: expected a list, got an object"),
        (preset(shapes=[1]), "shapes[0]: expected an object, got 1"),
        (preset(shapes=[{}]), "shapes[0].strips: expected a list, got nothing"),
        (shape(strips=[]), "shapes[0].strips: expected at least one strip, got []"),
        (shape(strips=[{}]), "shapes[0].strips[0].normal: expected a list of 3 numbers, got nothing"),
        (preset(shapes=[{}] * 257), "shapes: expected at most 256 shapes, got 257"),
        (
            preset(shapes=json.loads(GOOD)["shapes"] * 2 + [{"strips": [{}] * 1023}]),
            "shapes: expected at most 1024 strips in all, got 1025",
        ),
        (shape(mirror=["x"] * 4), "shapes[0].mirror: expected each axis once, got a list of 4"),
        (shape(mirror=["x", "x"]), "shapes[0].mirror: expected each axis once, got ['x', 'x']"),
        (shape(mirror=["w"]), 'shapes[0].mirror[0]: expected "x", "y" or "z", got \'w\''),
        (shape(visible=1), "shapes[0].visible: expected true or false, got 1"),
        (shape(name=None), "shapes[0].name: expected text, got null"),
        (shape(hardness=0), "shapes[0].hardness: expected a number above 0, got 0"),
        (shape(hardness="2"), "shapes[0].hardness: expected a number above 0, got '2'"),
        (shape(color=[0, 0.5, 1.5]), "shapes[0].color[2]: expected a number from 0 to 1, got 1.5"),
        (shape(color=[0, 0.5]), "shapes[0].color: expected a list of 3 numbers, got [0, 0.5]"),
        (shape(transform={"scale": [1, 0, 1]}), "shapes[0].transform.scale[1]: expected a number above 0, got 0"),
        (
            shape(transform={"rotation": [0, 0, 0, 2]}),
            "shapes[0].transform.rotation: expected a unit quaternion [x, y, z, w], got [0.0, 0.0, 0.0, 2.0]",
        ),
        (strip(gamma=-3), "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got -3"),
        (strip(gamma=1000.1), "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got 1000.1"),
        (strip(gamma=True), "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got true"),
        (strip(gamma=None), "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got null"),
        (strip(half_width=0.0), "shapes[0].strips[0].half_width: expected a number above 0, got 0.0"),
        (strip(normal=[0, 0, 0]), "shapes[0].strips[0].normal: expected a normal that is not zero, got [0.0, 0.0, 0.0]"),
        (strip(normal=[1, 0]), "shapes[0].strips[0].normal: expected a list of 3 numbers, got [1, 0]"),
        (strip(sign=0), "shapes[0].strips[0].sign: expected 1 or -1, got 0"),
        (strip(sign=True), "shapes[0].strips[0].sign: expected a whole number, got true"),
        (
            strip(group="rim"),
            "shapes[0].strips[0].group: expected the name of a group of this shape (but this shape has none), got 'rim'",
        ),
        (preset(bounds=[[0, 0, 0], [1, 0, 1]]), "bounds[1][1]: expected a number above 0, got 0.0"),
        (preset(dimension=4), "dimension: expected 2 or 3, got 4"),
        (preset(slice="t"), "slice: expected a finite number, got 't'"),
        (preset(animations=[{}, 5]), "animations[1]: expected an object, got 5"),
        (preset(view=[]), "view: expected an object, got []"),
        (
            {**strip(normal=[1, 0, 0.5]), "dimension": 2},
            "shapes[0].strips[0].normal[2]: expected 0 in two dimensions, got 0.5",
        ),
    ],
    ids=lambda value: value.partition(":")[0] if isinstance(value, str) else "",
)
def test_what_is_wrong_is_told_by_place_expected_and_got(tree: dict[str, Any], problem: str) -> None:
    assert problems(tree) == [problem]


def test_a_groups_strips_share_their_exponent_and_have_no_sign_of_their_own() -> None:
    def grouped(**second: Any) -> dict[str, Any]:
        members = [{"normal": [1, 0, 0], "group": "rim"}, {"normal": [0, 1, 0], "group": "rim", **second}]
        return shape(groups={"rim": {"gamma": 8}}, strips=members)

    assert parse(json.dumps(grouped()).encode(), "").shapes[0].groups["rim"].gamma == 8
    assert problems(grouped(gamma=3)) == ["shapes[0].strips[1].gamma: expected 2 like the group's other strips, got 3.0"]
    assert problems(grouped(sign=-1)) == [
        "shapes[0].strips[1].sign: expected 1 in a group (the group has a sign of its own), got -1"
    ]


def test_many_problems_are_listed_to_twenty_and_counted() -> None:
    found = problems(shape(strips=[{"normal": [1, 0, 0], "gamma": 0}] * 100))
    assert len(found) == 21
    assert found[19].startswith("shapes[0].strips[19].gamma: expected")
    assert found[20] == "and 80 more problems"


@pytest.mark.parametrize(
    "fill",
    [
        b'{"strips":[%s{}]}',
        b'{"mirror":[%s{}]}',
        b'{"groups":[%s{}]}',
        b'{"strips":[{"normal":[%s{}]}]}',
        b'{"transform":{"scale":[%s{}]}}',
    ],
)
def test_four_mebibytes_of_rubbish_are_a_short_complaint(fill: bytes) -> None:
    data = b'{"format":"hqmodel","version":1,"shapes":[' + fill % (b"{}," * 1_300_000) + b"]}"
    assert len(data) < 4 << 20
    assert sum(map(len, problems(data))) < 4000


@given(st.binary(max_size=200))
def test_any_bytes_are_a_preset_or_a_complaint(data: bytes) -> None:
    try:
        parse(data, "a.json")
    except PresetError as error:
        assert error.problems


@given(presets(), st.data())
def test_a_damaged_preset_is_a_preset_or_a_complaint(tree: dict[str, Any], data: st.DataObject) -> None:
    whole = bytearray(json.dumps(tree).encode())
    for _ in range(data.draw(st.integers(1, 4))):
        whole[data.draw(st.integers(0, len(whole) - 1))] = data.draw(st.integers(0, 255))
    try:
        scene = parse(bytes(whole), "a.json")
    except PresetError as error:
        assert all(len(problem.splitlines()) == 1 for problem in error.problems)
    else:
        assert parse(dumps(scene).encode(), "a.json") == scene


def test_files_that_cannot_be_read_say_why(tmp_path: Path) -> None:
    def told(path: Path) -> str:
        with pytest.raises(PresetError) as caught:
            load(path)
        return str(caught.value)

    assert told(tmp_path / "qqqq.json") == f"{tmp_path / 'qqqq.json'}: expected a file, got nothing of that name"
    assert told(tmp_path) == f"{tmp_path}: expected a file, got a folder"
    assert (
        told(tmp_path / "a\nb.json") == f"{str(tmp_path / 'a') + chr(10) + 'b.json'!r}: expected a file, got nothing of that name"
    )


def test_a_file_is_loaded_by_its_path(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(GOOD)
    assert load(tmp_path / "a.json") == load(str(tmp_path / "a.json")) == parse(GOOD.encode(), "")
