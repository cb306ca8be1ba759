"""Strips added, removed, copied, grouped and ungrouped."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.edit import EditError, add_strip, duplicate_strip, new_shape, put, remove_strip, set_group, ungroup
from hqmodel.field import Terms, value
from hqmodel.model import Scene, Strip

SCENE = Scene(shapes=(new_shape("ball"), new_shape("cylinder")))
POINTS = np.random.default_rng(7).uniform(-1.5, 1.5, (50, 3))


def field(scene: Scene) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return value(Terms.of(scene), POINTS)


def test_an_added_strip_is_the_last() -> None:
    strip = Strip(normal=(1.0, 1.0, 0.0), gamma=8.0)
    scene = add_strip(SCENE, 0, strip)
    assert scene.shapes[0].strips == (*SCENE.shapes[0].strips, strip)
    assert scene.shapes[1] == SCENE.shapes[1]


def test_a_removed_strip_takes_the_group_it_was_the_last_of() -> None:
    once = remove_strip(SCENE, 1, 0)
    assert list(once.shapes[1].groups) == ["side"]
    assert remove_strip(once, 1, 0).shapes[1].groups == {}


def test_a_group_that_never_had_strips_is_left_alone() -> None:
    shape = {"groups": {"empty": {"gamma": 3.0}}, "strips": [{"normal": [1, 0, 0]}, {"normal": [0, 1, 0]}]}
    scene = Scene.model_validate({"shapes": [shape]})
    assert list(remove_strip(scene, 0, 0).shapes[0].groups) == ["empty"]


def test_a_copied_strip_stays_in_its_group() -> None:
    strips = duplicate_strip(SCENE, 1, 0).shapes[1].strips
    assert strips[0] == strips[1]
    assert [strip.group for strip in strips] == ["side", "side", "side", None]


def test_grouping_equal_strips_keeps_the_shape() -> None:
    grouped = set_group(SCENE, 0, [0, 2])
    assert [strip.group for strip in grouped.shapes[0].strips] == ["group", None, "group"]
    assert np.allclose(field(grouped), field(SCENE), rtol=1e-12)
    assert ungroup(grouped, 0, [0, 2]) == SCENE


def test_a_strip_that_joins_takes_the_inner_exponent() -> None:
    joined = set_group(SCENE, 1, [2], "side").shapes[1]
    assert [strip.gamma for strip in joined.strips] == [2.0, 2.0, 2.0]
    assert joined.groups == SCENE.shapes[1].groups


def test_the_sign_goes_to_the_group_and_comes_back() -> None:
    negative = put(put(SCENE, "shapes[0].strips[0].sign", -1), "shapes[0].strips[1].sign", -1)
    grouped = set_group(negative, 0, [0, 1], "neck")
    assert grouped.shapes[0].groups["neck"].sign == -1
    assert np.allclose(field(grouped), field(negative), rtol=1e-12)
    assert ungroup(grouped, 0, [0, 1]) == negative


def test_strips_of_both_signs_do_not_group() -> None:
    mixed = put(SCENE, "shapes[0].strips[0].sign", -1)
    with pytest.raises(EditError, match=r"^shapes\[0\].strips\[0\].sign: expected strips of one sign, got both$"):
        set_group(mixed, 0, [0, 1])


def test_a_shape_keeps_at_least_one_strip() -> None:
    single = Scene(shapes=(new_shape("ball").changed(strips=(Strip(normal=(1.0, 0.0, 0.0)),)),))
    with pytest.raises(EditError, match=r"^shapes\[0\].strips: expected at least one strip"):
        remove_strip(single, 0, 0)


def test_an_index_that_is_not_there_is_told() -> None:
    message = r"^shapes\[0\].strips\[5\]: expected an index from 0 to 2, got 5$"
    with pytest.raises(EditError, match=message):
        remove_strip(SCENE, 0, 5)
    with pytest.raises(EditError, match=message):
        set_group(SCENE, 0, [5])
    with pytest.raises(EditError, match=message):
        ungroup(SCENE, 0, [5])
    with pytest.raises(EditError, match=r"^shapes\[2\]: expected an index from 0 to 1, got 2$"):
        add_strip(SCENE, 2, Strip(normal=(1.0, 0.0, 0.0)))
