"""Any value by its path: what is put is there and nothing else has changed; what can't be is told in one line."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.edit import EditError, get, locations, new_shape, parse, put, reset
from hqmodel.model import FIELDS, Scene, pattern, place
from tests.strategies import numbers, scenes

SCENE = Scene(shapes=(new_shape("cylinder"), new_shape("ball")), slice=0.25)


def number_paths(scene: Scene) -> list[tuple[str | int, ...]]:
    """Where in the scene the table of fields has a number, those of vectors' components included."""
    found: list[tuple[str | int, ...]] = []

    def visit(value: Any, where: tuple[str | int, ...]) -> None:
        if isinstance(value, tuple):
            for index, item in enumerate(value):
                visit(item, (*where, index))
        elif isinstance(value, dict):
            for key, item in value.items():
                visit(item, (*where, key))
        elif hasattr(value, "changed"):
            for name in type(value).model_fields:
                visit(getattr(value, name), (*where, name))
        elif pattern(where) in FIELDS and not isinstance(value, bool):
            found.append(where)

    visit(scene, ())
    return found


def test_every_number_of_the_table_is_reached() -> None:
    scene = put(SCENE, "bounds", [[-1, -1, -1], [1, 1, 1]])
    assert {pattern(path) for path in number_paths(scene)} == set(FIELDS)


@given(scenes(), st.data())
def test_what_is_put_is_there_and_the_rest_as_it_was(scene: Scene, data: st.DataObject) -> None:
    path = data.draw(st.sampled_from(number_paths(scene)))
    if pattern(path) in ("bounds[][]", "shapes[].transform.rotation[]", "shapes[].strips[].normal[]"):
        value = get(scene, path)  # these depend on their neighbours
    else:
        value = data.draw(numbers(FIELDS[pattern(path)]))
    before = get(scene, path)
    after = put(scene, path, value)
    assert get(after, path) == value
    assert put(after, path, before) == scene


@given(scenes(), st.data())
def test_a_place_as_errors_give_it_is_a_path(scene: Scene, data: st.DataObject) -> None:
    path = data.draw(st.sampled_from(number_paths(scene)))
    assert parse(place(path)) == path
    assert get(scene, place(path)) == get(scene, path)


def test_quoted_names_are_steps_too() -> None:
    assert parse("shapes[0].groups['my rim'].gamma") == ("shapes", 0, "groups", "my rim", "gamma")
    assert parse('a["it\'s"]') == ("a", "it's")


def test_a_field_of_strips_alone_means_every_strips() -> None:
    assert len(locations(SCENE, "gamma")) == SCENE.strip_count
    assert {strip.gamma for shape in put(SCENE, "gamma", 7).shapes for strip in shape.strips} == {7.0}
    assert {strip.normal[2] for shape in put(SCENE, "normal[2]", 0.5).shapes for strip in shape.strips} == {0.5}


def test_a_field_of_shapes_alone_means_every_shapes() -> None:
    assert [shape.hardness for shape in put(SCENE, "hardness", 3).shapes] == [3.0, 3.0]
    assert [shape.transform.scale for shape in put(SCENE, "transform.scale[1]", 2).shapes] == [(1.0, 2.0, 1.0)] * 2


def test_what_the_scene_has_itself_comes_first() -> None:
    changed = put(SCENE, "slice", 0.5)
    assert changed.slice == 0.5
    assert changed.shapes == SCENE.shapes


def test_strips_of_a_group_share_their_exponent() -> None:
    changed = put(SCENE, "shapes[0].strips[0].gamma", 3)
    assert [strip.gamma for strip in changed.shapes[0].strips] == [3.0, 3.0, SCENE.shapes[0].strips[2].gamma]


@pytest.mark.parametrize("gamma", [0.05, 1000])
def test_the_limits_are_permitted(gamma: float) -> None:
    assert get(put(SCENE, "gamma", gamma), "gamma") == gamma


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("shapes[1].strips[2].gamma", -3, "shapes[1].strips[2].gamma: expected a number from 0.05 to 1000, got -3"),
        ("shapes[1].strips[2].gamma", float("nan"), "shapes[1].strips[2].gamma: expected a number from 0.05 to 1000, got nan"),
        ("shapes[1].strips[2].gamma", True, "shapes[1].strips[2].gamma: expected a number from 0.05 to 1000, got true"),
        ("shapes[1].strips[0].half_width", 0, "shapes[1].strips[0].half_width: expected a number above 0, got 0"),
        ("shapes[0].color[1]", 1.5, "shapes[0].color[1]: expected a number from 0 to 1, got 1.5"),
        ("shapes[0].name", 5, "shapes[0].name: expected text, got 5"),
        ("slice", 10**400, "slice: expected a finite number, got 1" + "0" * 56 + "..."),
        ("shapes[1].strips[9].gamma", 2, "shapes[1].strips[9]: expected an index from 0 to 2, got 9"),
        ("shapes[1].strips.gamma", 2, "shapes[1].strips.gamma: expected an index from 0 to 2, got 'gamma'"),
        ("shapes[0].groups.side.power", 2, "shapes[0].groups.side.power: expected gamma or sign, got 'power'"),
        ("shapes[0].groups.rim.gamma", 2, "shapes[0].groups.rim: expected side, got 'rim'"),
        ("shapes[1].groups.rim.gamma", 2, "shapes[1].groups.rim: expected a name that is there (none is), got 'rim'"),
        ("level[0]", 2, "level: has no parts, got 0"),
        ("gama", 2, "gama: expected a field of the scene, its shapes or strips, got 'gama'"),
        ("a b", 2, "a b: expected a path such as shapes[0].strips[1].gamma, got ' b'"),
        ("shapes[-1].name", "", "shapes[-1].name: expected a path such as shapes[0].strips[1].gamma, got '[-1].name'"),
        ("[0]", 2, "[0]: expected a path such as shapes[0].strips[1].gamma, got '[0]'"),
        ("", 2, "expected a path such as shapes[0].strips[1].gamma, got nothing"),
    ],
)
def test_what_cannot_be_put_is_told_in_one_line(path: str, value: object, message: str) -> None:
    with pytest.raises(EditError) as caught:
        put(SCENE, path, value)
    assert str(caught.value) == message


@given(st.text(max_size=30))
def test_any_text_is_a_path_or_a_single_line_of_complaint(text: str) -> None:
    try:
        get(SCENE, text)
    except EditError as error:
        assert len(str(error).splitlines()) == 1


def test_an_empty_scene_has_no_strips_to_mean() -> None:
    with pytest.raises(EditError, match="gamma: expected a scene with shapes, got none"):
        put(Scene(shapes=()), "gamma", 2)


def test_unknown_keys_stay_where_they_are() -> None:
    strip = {"normal": [1, 0, 0], "note": {"by": "me"}}
    scene = Scene.model_validate({"shapes": [{"strips": [strip], "tag": 1}], "extra": [1]})
    changed = put(scene, "shapes[0].strips[0].gamma", 4)
    assert changed.model_extra == {"extra": [1]}
    assert changed.shapes[0].model_extra == {"tag": 1}
    assert changed.shapes[0].strips[0].model_extra == {"note": {"by": "me"}}


def test_reset_gives_what_a_preset_that_says_nothing_has() -> None:
    changed = put(put(SCENE, "gamma", 9), "transform.translation", [1, 2, 3])
    assert {strip.gamma for strip in reset(changed, "gamma").shapes[0].strips} == {2.0}
    assert reset(changed, "shapes[0].transform.translation[1]").shapes[0].transform.translation == (1.0, 0.0, 3.0)
    assert reset(changed, "shapes[1].transform").shapes[1].transform.translation == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("path", ["shapes[0].strips[0].normal", "shapes[0].groups.side.gamma"])
def test_what_has_no_default_cannot_be_reset(path: str) -> None:
    with pytest.raises(EditError, match="has no default"):
        reset(SCENE, path)
