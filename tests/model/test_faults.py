"""Values refuse what the format does, in one line that says where, what was expected and what came."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest
from pydantic import ValidationError

from hqmodel.model import FIELDS, Scene, Shape, Strip, faults, pattern, place, shown

PRESET = {"format": "hqmodel", "version": 1, "shapes": [{"strips": [{"normal": [1, 0, 0]}]}]}
STRIP = ("shapes", 0, "strips", 0)


def fault(path: tuple[str | int, ...], value: Any) -> list[str]:
    tree: Any = deepcopy(PRESET)
    here = tree
    for step in path[:-1]:
        here = here[step]
    here[path[-1]] = value
    with pytest.raises(ValidationError) as caught:
        Scene.model_validate(tree)
    return faults(caught.value)


@pytest.mark.parametrize(
    ("path", "value", "line"),
    [
        ((*STRIP, "gamma"), -3, "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got -3"),
        ((*STRIP, "gamma"), "2", "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got '2'"),
        ((*STRIP, "gamma"), True, "shapes[0].strips[0].gamma: expected a number from 0.05 to 1000, got true"),
        ((*STRIP, "normal"), [0, 0, 0], "shapes[0].strips[0].normal: expected a normal that is not zero, got [0.0, 0.0, 0.0]"),
        ((*STRIP, "normal"), [1, 2], "shapes[0].strips[0].normal: expected a list of 3 numbers, got [1, 2]"),
        ((*STRIP, "normal"), [1, "a", 2], "shapes[0].strips[0].normal[1]: expected a finite number, got 'a'"),
        ((*STRIP, "sign"), 0, "shapes[0].strips[0].sign: expected 1 or -1, got 0"),
        ((*STRIP, "half_width"), 0, "shapes[0].strips[0].half_width: expected a number above 0, got 0"),
        (("shapes", 0, "strips"), [], "shapes[0].strips: expected at least one strip, got []"),
        (("shapes", 0, "mirror"), ["x", "x"], "shapes[0].mirror: expected each axis once, got ['x', 'x']"),
        (("shapes", 0, "visible"), 1, "shapes[0].visible: expected true or false, got 1"),
        (("shapes", 0, "color"), [0, 0, 2], "shapes[0].color[2]: expected a number from 0 to 1, got 2"),
        (("shapes", 0, "groups"), {"a": {"gamma": 0}}, "shapes[0].groups.a.gamma: expected a number from 0.05 to 1000, got 0"),
        (("bounds",), [[0, 0, 0], [1, 0, 1]], "bounds[1][1]: expected a number above 0, got 0.0"),
        (("bounds",), [], "bounds: expected two lists of 3 numbers, got []"),
        (("bounds",), [[0, 0, 0]], "bounds: expected two lists of 3 numbers, got [[0, 0, 0]]"),
        (("shapes", 0, "strips"), [{}], "shapes[0].strips[0].normal: expected a list of 3 numbers, got nothing"),
        (("dimension",), 4, "dimension: expected 2 or 3, got 4"),
    ],
)
def test_one_line_each(path: tuple[str | int, ...], value: Any, line: str) -> None:
    assert fault(path, value) == [line]


def test_a_quaternion_that_is_none() -> None:
    line = "shapes[0].transform.rotation: expected a unit quaternion [x, y, z, w], got [1.0, 1.0, 1.0, 1.0]"
    assert fault(("shapes", 0, "transform"), {"rotation": [1, 1, 1, 1]}) == [line]


@pytest.mark.parametrize(
    ("strips", "line"),
    [
        (
            [{"gamma": 2, "group": "g"}, {"gamma": 3, "group": "g"}],
            "strips[1].gamma: expected 2 like the group's other strips, got 3.0",
        ),
        ([{"sign": -1, "group": "g"}], "strips[0].sign: expected 1 in a group (the group has a sign of its own), got -1"),
        ([{"group": "h"}], "strips[0].group: expected the name of a group of this shape ('g'), got 'h'"),
    ],
)
def test_groups_agree(strips: list[dict[str, Any]], line: str) -> None:
    with pytest.raises(ValidationError) as caught:
        Shape.model_validate({"groups": {"g": {"gamma": 4}}, "strips": [{"normal": [1, 0, 0], **strip} for strip in strips]})
    assert faults(caught.value) == [line]


def test_limits_of_count() -> None:
    shape = Shape(strips=(Strip(normal=(1, 0, 0)),) * 4)
    assert Scene(shapes=(shape,) * 256).strip_count == 1024
    with pytest.raises(ValidationError) as caught:
        Scene(shapes=(shape,) * 257)
    assert faults(caught.value) == ["shapes: expected a list of at most 256, got a list of 257"]
    with pytest.raises(ValidationError) as caught:
        Scene(shapes=(*(shape,) * 255, shape.changed(strips=shape.strips * 2)))
    assert faults(caught.value) == ["shapes: expected at most 1024 strips in all, got 1028"]


def test_changed_values_are_validated_and_keep_what_they_do_not_know() -> None:
    strip = Strip.model_validate({"normal": [1, 0, 0], "note": "mine"})
    assert strip.changed(gamma=5.0).model_extra == {"note": "mine"}
    with pytest.raises(ValidationError):
        strip.changed(gamma=0.0)
    with pytest.raises(ValidationError):
        strip.gamma = 3.0  # type: ignore[misc]  # what is tested


def test_every_number_of_the_format_is_in_the_table() -> None:
    shape = Shape.model_validate({"groups": {"g": {"gamma": 2}}, "strips": [{"normal": [1, 0, 0]}]})
    tree = Scene(shapes=(shape,), bounds=((-1, -1, -1), (1, 1, 1))).model_dump(mode="json")
    found: set[str] = set()

    def walk(value: Any, location: tuple[str | int, ...]) -> None:
        if isinstance(value, dict):
            for key, part in value.items():
                walk(part, (*location, key))
        elif isinstance(value, list):
            for index, part in enumerate(value):
                walk(part, (*location, index))
        elif isinstance(value, float):
            found.add(pattern(location))

    walk(tree, ())
    assert found == set(FIELDS)


def test_defaults_and_sliders_are_permitted() -> None:
    for number in FIELDS.values():
        defaults = number.default if isinstance(number.default, tuple) else (number.default,)
        assert all(number.permits(value) for value in (*number.slider, *(value for value in defaults if value is not None)))
        assert number.help.endswith(".")


def test_hostile_names_stay_on_one_short_line() -> None:
    assert place(("shapes", 0, "groups", "a\nb" * 50, "gamma")).count("\n") == 0
    assert len(place(("shapes", 0, "groups", "x" * 10_000, "gamma"))) < 90
    assert len(shown("y" * 10_000)) <= 60
