"""The landscape of a round hill, whose sections are circles, and the lines that bound strips."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.field import Terms, bounding_lines, landscape, value
from hqmodel.files import load
from hqmodel.model import Scene, Shape, Strip

# exp(-(x^2 + y^2))
HILL = Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)), Strip(normal=(0, 1, 0))), constant=0.0),), dimension=2, level=0.4)


def test_heights_are_those_of_the_sum_whatever_the_level() -> None:
    land = landscape(HILL, 40)
    assert land.heights == pytest.approx(np.exp(-np.sum(land.points[..., :2] ** 2, axis=-1)), abs=1e-12)
    scene = load("fig18-hill-less-hill")
    found = landscape(scene, 40, land.low, land.high)
    assert value(Terms.of(scene), found.points * [1, 1, 0]) == pytest.approx(found.heights - scene.level, abs=1e-12)


def test_it_reaches_to_where_the_land_is_flat() -> None:
    land = landscape(HILL, 64)
    rim = np.concatenate([land.heights[[0, -1]].ravel(), land.heights[:, [0, -1]].ravel()])
    assert np.all(rim < 0.02)
    assert land.low == pytest.approx(-land.high)
    assert np.all(land.high > np.sqrt(-np.log(0.4)))


@pytest.mark.parametrize("level", [0.1, 0.4, 0.9])
def test_the_section_is_a_closed_circle_at_its_height(level: float) -> None:
    land = landscape(HILL, 64)
    pieces = land.section(level)
    assert pieces[..., 2] == pytest.approx(level)
    assert np.linalg.norm(pieces[..., :2], axis=-1) == pytest.approx(np.sqrt(-np.log(level)), rel=0.02)
    _, count = np.unique(np.round(pieces.reshape(-1, 3), 9), axis=0, return_counts=True)
    assert np.all(count == 2), "each end of a piece is one of another piece"
    length = float(np.sum(np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=-1)))
    assert length == pytest.approx(2 * np.pi * np.sqrt(-np.log(level)), rel=0.01)


def test_above_the_top_there_is_no_section() -> None:
    assert landscape(HILL, 16).section(1.5).shape == (0, 2, 3)


def test_squares_tile_the_rectangle() -> None:
    land = landscape(HILL, 8)
    a, b, c, d = (land.squares()[:, i, :2] for i in range(4))
    (x, y), (u, v) = (c - a).T, (d - b).T
    areas = (x * v - y * u) / 2
    assert np.all(areas > 0)
    assert np.sum(areas) == pytest.approx(np.prod(land.high - land.low))


def test_without_a_shape_the_land_is_flat() -> None:
    assert not np.any(landscape(Scene(shapes=(), dimension=2), 8).heights)


def test_bounding_lines_lie_at_one_and_minus_one_about_a_middle() -> None:
    normal, offset, middle = np.array([1.5, -0.4]), 0.3, np.array([2.0, 1.0])
    lines = bounding_lines(normal, offset, middle, far=3.0)
    assert lines @ normal + offset == pytest.approx(np.array([[-1.0, -1.0], [1.0, 1.0]]))
    assert np.linalg.norm(lines[:, 1] - lines[:, 0], axis=-1) == pytest.approx(6.0)
    apart = np.mean(lines, axis=1) - middle
    assert apart @ [normal[1], -normal[0]] == pytest.approx(0.0, abs=1e-12), "the middles are the nearest points"
