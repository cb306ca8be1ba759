"""Shapes added, removed, copied and moved."""

from __future__ import annotations

import pytest

from hqmodel.edit import EditError, add_shape, duplicate_shape, move_shape, new_shape, remove_shapes, rename_shapes
from hqmodel.model import MAX_SHAPES, Scene

SCENE = Scene(shapes=(new_shape("ball"), new_shape("block"), new_shape("cylinder")), name="three")


def names(scene: Scene) -> list[str]:
    return [shape.name for shape in scene.shapes]


def test_added_shapes_come_last_under_a_name_of_their_own() -> None:
    scene = add_shape(add_shape(SCENE, new_shape("ball")), new_shape("ball"))
    assert names(scene) == ["Ball", "Block", "Cylinder", "Ball 2", "Ball 3"]
    assert scene.shapes[:3] == SCENE.shapes
    assert scene.name == "three"


def test_removed_shapes_are_gone_and_the_others_stay() -> None:
    assert names(remove_shapes(SCENE, [2, 0])) == ["Block"]
    assert remove_shapes(SCENE, []) == SCENE


def test_a_copy_follows_its_original() -> None:
    scene = duplicate_shape(SCENE, 1)
    assert names(scene) == ["Ball", "Block", "Block 2", "Cylinder"]
    assert scene.shapes[2].strips == scene.shapes[1].strips


def test_several_shapes_are_named_and_numbered_in_their_order() -> None:
    scene = Scene(shapes=tuple(new_shape("ball").changed(name=name) for name in ("A", "Leg 2", "B", "C")))
    assert names(rename_shapes(scene, [3, 0, 2], "Leg")) == ["Leg 1", "Leg 2", "Leg 3", "Leg 4"]
    assert names(rename_shapes(scene, [2], "Leg")) == ["A", "Leg 2", "Leg", "C"]
    assert names(rename_shapes(scene, [0, 3], "")) == ["", "Leg 2", "B", ""]
    with pytest.raises(EditError, match=r"^shapes\[4\]"):
        rename_shapes(scene, [0, 4], "Leg")


@pytest.mark.parametrize(("index", "to", "expected"), [(0, 2, "BCA"), (2, 0, "CAB"), (1, 1, "ABC"), (0, 1, "BAC")])
def test_a_moved_shape_has_the_index_it_was_sent_to(index: int, to: int, expected: str) -> None:
    scene = Scene(shapes=tuple(new_shape("ball").changed(name=name) for name in "ABC"))
    assert "".join(names(move_shape(scene, index, to))) == expected


def test_there_is_room_for_256_shapes_and_no_more() -> None:
    full = Scene(shapes=(new_shape("ball"),) * MAX_SHAPES)
    with pytest.raises(EditError, match=r"^shapes: expected a list of at most 256, got a list of 257$"):
        add_shape(full, new_shape("ball"))


def test_flat_scenes_take_flat_shapes_only() -> None:
    flat = Scene(shapes=(), dimension=2)
    assert names(add_shape(flat, new_shape("block", dimension=2))) == ["Block"]
    with pytest.raises(EditError, match=r"^shapes\[0\].strips\[2\].normal\[2\]: expected 0 in two dimensions, got 1.0$"):
        add_shape(flat, new_shape("block"))


def test_an_index_that_is_not_there_is_told() -> None:
    message = r"^shapes\[3\]: expected an index from 0 to 2, got 3$"
    with pytest.raises(EditError, match=message):
        remove_shapes(SCENE, [0, 3])
    with pytest.raises(EditError, match=message):
        duplicate_shape(SCENE, 3)
    with pytest.raises(EditError, match=message):
        move_shape(SCENE, 0, 3)
