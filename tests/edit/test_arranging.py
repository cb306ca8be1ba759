"""Shapes moved, turned, scaled and repeated: the field goes along with them."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.edit import (
    about,
    add_shape,
    carve,
    move_shapes,
    new_scene,
    new_shape,
    repeat_around,
    scale_exponents,
    scale_shapes,
    set_group,
    stretch_shapes,
    turn_shapes,
)
from hqmodel.field import Terms, rotation_matrix, value
from hqmodel.model import Scene

POINTS = np.random.default_rng(1).uniform(-2, 2, (300, 3))
PIVOT = np.array([0.4, -0.3, 0.2])


def scene() -> Scene:
    return add_shape(new_scene(), new_shape("taper"))


def field(scene: Scene, points: np.ndarray) -> np.ndarray:
    return value(Terms.of(scene), points)


def test_moved_turned_and_scaled_fields_are_the_old_one_looked_up_elsewhere() -> None:
    start, turn = scene(), about((1, 2, 3), 50)
    matrix = rotation_matrix(turn)
    assert np.allclose(field(move_shapes(start, [0, 1], PIVOT), POINTS + PIVOT), field(start, POINTS))
    assert np.allclose(field(turn_shapes(start, [0, 1], turn, PIVOT), (POINTS - PIVOT) @ matrix.T + PIVOT), field(start, POINTS))
    assert np.allclose(field(scale_shapes(start, [0, 1], 1.7, PIVOT), (POINTS - PIVOT) * 1.7 + PIVOT), field(start, POINTS))
    stretched = (POINTS - PIVOT) * (1.0, 2.0, 1.0) + PIVOT
    assert np.allclose(field(stretch_shapes(start, [0, 1], (0, 1, 0), 2.0, PIVOT), stretched), field(start, POINTS))


def test_only_the_chosen_shapes_move() -> None:
    assert move_shapes(scene(), [1], (1, 0, 0)).shapes[0] == scene().shapes[0]


def test_a_flat_scene_stays_in_its_plane() -> None:
    flat = Scene(shapes=(new_shape("block", 2),), dimension=2)
    assert move_shapes(flat, [0], (1, 2, 3)).shapes[0].transform.translation == (1, 2, 0)


def test_repeated_around_an_axis_the_body_looks_the_same_from_each() -> None:
    start = move_shapes(new_scene(), [0], (2, 0, 0))
    ring = repeat_around(start, 0, (0, 0, 1), 5)
    assert [shape.name for shape in ring.shapes] == ["Ball", "Ball 2", "Ball 3", "Ball 4", "Ball 5"]
    turned = POINTS @ rotation_matrix(about((0, 0, 1), 72)).T
    assert np.allclose(field(ring, turned), field(ring, POINTS))


def test_carving_and_back() -> None:
    assert carve(scene(), [1], True).shapes[1].coefficient == -1.0
    assert carve(carve(scene(), [0, 1], True), [0, 1], False) == scene()


def test_exponents_go_up_and_down_together_within_what_is_permitted() -> None:
    start = add_shape(new_scene(), new_shape("cylinder"))
    sharper = scale_exponents(start, 1, 3.0)
    assert [strip.gamma for strip in sharper.shapes[1].strips] == [6.0, 6.0, 60.0]
    assert sharper.shapes[1].groups["side"].gamma == 60.0
    assert sharper.shapes[0] == start.shapes[0]
    assert [strip.gamma for strip in scale_exponents(start, 0, 4.0, [1]).shapes[0].strips] == [2.0, 8.0, 2.0]
    assert {strip.gamma for strip in scale_exponents(start, 0, 1e9).shapes[0].strips} == {1000.0}
    assert {strip.gamma for strip in scale_exponents(start, 0, 1e-9).shapes[0].strips} == {0.05}


def test_a_group_goes_with_any_of_its_strips() -> None:
    grouped = set_group(new_scene(), 0, [0, 1], "rim")
    assert [strip.gamma for strip in scale_exponents(grouped, 0, 2.0, [0]).shapes[0].strips] == [4.0, 4.0, 2.0]


def test_about_takes_an_axis_of_any_length() -> None:
    assert about((0, 0, 5), 180) == pytest.approx((0, 0, 1, 0))
