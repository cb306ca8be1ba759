"""The shapes a scene is started from are what they are called."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.edit import PRIMITIVES, new_scene, new_shape
from hqmodel.field import Terms, value
from hqmodel.model import Scene


def inside(kind: str, *point: float) -> bool:
    scene = Scene(shapes=(new_shape(kind),))
    return bool(value(Terms.of(scene), np.array([point]))[0] > 0)


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_each_reaches_one_unit_along_every_axis(kind: str) -> None:
    for axis in np.vstack([np.eye(3), -np.eye(3)]):
        assert inside(kind, *(0.99 * axis))
        assert not inside(kind, *(1.01 * axis))


def test_only_the_block_has_its_corners_and_only_the_ball_no_rim() -> None:
    corner, rim = (0.9, 0.9, 0.9), (0.6, 0.6, 0.9)
    assert [inside(kind, *corner) for kind in PRIMITIVES] == [False, True, False]
    assert [inside(kind, *rim) for kind in PRIMITIVES] == [False, True, True]


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_each_has_an_outline_in_two_dimensions(kind: str) -> None:
    flat = Scene(shapes=(new_shape(kind, dimension=2),), dimension=2)
    assert flat.strip_count == 2


def test_a_new_scene_is_a_ball() -> None:
    assert new_scene().shapes == (new_shape("ball"),)
