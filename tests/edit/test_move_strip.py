"""A strip put elsewhere in its shape."""

from __future__ import annotations

import pytest

from hqmodel.edit import EditError, move_strip, new_shape
from hqmodel.model import Scene

SCENE = Scene(shapes=(new_shape("cylinder"), new_shape("ball")))


def test_the_strip_lands_where_it_was_sent_and_the_others_close_up() -> None:
    strips = SCENE.shapes[0].strips
    assert move_strip(SCENE, 0, 2, 0).shapes[0].strips == (strips[2], strips[0], strips[1])
    assert move_strip(SCENE, 0, 0, 1).shapes[0].strips == (strips[1], strips[0], strips[2])
    assert move_strip(SCENE, 0, 2, 0).shapes[1] == SCENE.shapes[1]


def test_groups_stay_as_they_were() -> None:
    assert move_strip(SCENE, 0, 2, 0).shapes[0].groups == SCENE.shapes[0].groups


@pytest.mark.parametrize(("index", "to"), [(3, 0), (0, 3)])
def test_places_that_are_not_there_are_errors(index: int, to: int) -> None:
    with pytest.raises(EditError, match=r"shapes\[0\]\.strips\[3\]: expected an index from 0 to 2"):
        move_strip(SCENE, 0, index, to)
