"""The distances that fits are made by: what they are of known bodies, and their derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from hqmodel.field import Terms, log_ratio
from hqmodel.fit.bodies import Bodies, joined
from hqmodel.fit.cloud import Frame
from hqmodel.fit.distance import FARTHEST, Measured, distances, normals
from hqmodel.fit.scene import scene_of

AXES = np.eye(3)


def lone(half: float, gamma: float) -> Bodies:
    return Bodies.lone(AXES / half, np.zeros(3), np.full(3, gamma))


def blend(mirrored: bool) -> Bodies:
    """Two bodies that add and one that carves, strips askew."""
    rng = np.random.default_rng(3)
    mirror = np.array([False, mirrored, mirrored])
    owner, signs = np.repeat([0, 1, 2], 3), np.array([1.0, 1.0, -1.0])
    normal, offset, gamma = rng.normal(size=(9, 3)) * 2, rng.normal(size=9) * 0.2, rng.uniform(1.2, 8, 9)
    return Bodies(normal, offset, gamma, owner, np.array([2.0, 3.0, 2.5]), signs, mirror)


def framed() -> Bodies:
    """Two bodies at right angles, the second a pair and with a fourth strip askew."""
    turn = Rotation.from_rotvec([0.3, -0.8, 0.4]).as_matrix()
    normal = np.concatenate([AXES / [[0.3], [0.2], [0.25]], turn / [[0.15], [0.2], [0.3]], [[2.0, -1.0, 2.5]]])
    owner, mirrored = np.repeat([0, 1], [3, 4]), np.array([False, True])
    gamma, offset = np.linspace(2, 8, 7), np.array([0.1, 0, 0.2, -1.0, 0.4, 0.3, -0.2])
    return Bodies(normal, offset, gamma, owner, np.array([3.0, 4.0]), np.ones(2), mirrored, np.ones((2, 3)))


def with_group() -> Bodies:
    """A body of four strips askew, two of them a group."""
    rng = np.random.default_rng(5)
    normal = rng.normal(size=(4, 3)) * 3
    return Bodies.lone(normal, rng.normal(size=4) * 0.3, np.array([4.0, 3.0, 1.4, 6.0])).with_group(np.arange(4) % 3 == 0)


def on_surface(bodies: Bodies, count: int = 2000) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    points = np.random.default_rng(0).normal(size=(count, 3)) * 0.3
    for _ in range(60):
        points = points - np.clip(distances(bodies, points), -0.1, 0.1)[:, None] * normals(bodies, points)
    return points[np.abs(distances(bodies, points)) < 1e-9]


def test_a_ball_is_as_far_as_it_is() -> None:
    points = np.random.default_rng(1).normal(size=(500, 3))
    away = np.linalg.norm(points, axis=1) - 0.4
    assert np.allclose(distances(lone(0.4, 2.0), points), np.clip(away, -FARTHEST, FARTHEST), atol=1e-9)


def test_a_sharp_box_is_as_far_beyond_its_edges_and_from_its_middle_as_they_are() -> None:
    points = np.array([(0.4, 0.4, 0.0), (0.4, 0.0, 0.0), (0.1, 0.25, 0.0), (0.0, 0.0, 0.31), (1e-3, 1e-5, 0.0)])
    expected = [0.1 * 2**0.5, 0.1, -0.05, 0.01, -0.299]
    assert np.allclose(distances(lone(0.3, 200.0), points), expected, atol=5e-3)


@pytest.mark.parametrize(
    "bodies", [lone(0.3, 3.0), blend(mirrored=False), blend(mirrored=True), framed(), with_group(), with_group().squared()]
)
def test_the_derivatives_are_those_of_the_distance(bodies: Bodies) -> None:
    points = on_surface(bodies)
    assert len(points) > 1000
    rows = Measured(bodies, points).rows()
    assert len(rows) == bodies.size
    for number, row in enumerate(rows):
        step = np.zeros(bodies.size)
        step[number] = 1e-6
        ahead, behind = distances(bodies.moved(step), points), distances(bodies.moved(-step), points)
        error = np.abs((ahead - behind) / 2e-6 - row)
        assert np.quantile(error, 0.9) < 1e-4 * (1 + np.abs(row).max()), number


def test_several_bodies_are_no_further_than_the_nearest_of_them() -> None:
    soft, hard = (
        replace(lone(half, 2.0), offset=np.array([at, 0.0, 0.0]), hardness=np.array([hardness]), widest=np.ones((1, 3)))
        for half, at, hardness in ((0.3, 1.0, 1.0), (0.2, -1.2, 30.0))
    )
    points = np.random.default_rng(1).uniform(-0.8, 0.8, size=(1000, 3))
    nearest = np.minimum(distances(soft, points), distances(hard, points))
    outside = nearest > 0.0
    assert np.all(distances(joined([soft, hard]), points)[outside] < nearest[outside] + 1e-6)


def test_a_group_of_like_exponents_changes_nothing() -> None:
    points = np.random.default_rng(1).normal(size=(500, 3))
    alone = lone(0.4, 3.0)
    assert np.allclose(distances(alone.with_group(np.array([True, False, True])), points), distances(alone, points), atol=1e-9)


@pytest.mark.parametrize("bodies", [lone(0.3, 3.0), blend(mirrored=False), blend(mirrored=True), with_group()])
@pytest.mark.parametrize("axis", [None, 0, 1])
def test_the_scene_has_the_same_surface(bodies: Bodies, axis: int | None) -> None:
    rotation = np.roll(AXES, axis, axis=1) if axis else np.eye(3)
    frame = Frame(np.zeros(3) if axis is not None else np.array([1.0, 2.0, -3.0]), 5.0, rotation, axis)
    points = on_surface(bodies)
    slope = distances(bodies, points + 1e-4 * normals(bodies, points))
    assert np.all(slope > 0)
    terms = Terms.of(scene_of(bodies, frame))
    inside, outside = (
        (points + step * normals(bodies, points)) @ frame.rotation * frame.size + frame.centre for step in (-1e-5, 1e-5)
    )
    assert np.all(log_ratio(terms, inside) > 0)
    assert np.all(log_ratio(terms, outside) < 0)


@pytest.mark.parametrize("body", [0, 1])
def test_the_numbers_of_a_body_move_it_and_no_other(body: int) -> None:
    before = framed()
    chosen = np.arange(2) == body
    after = before.moved(np.where(before.numbers(chosen), 0.05, 0.0))
    moved = chosen[before.owner]
    assert np.all(after.gamma[moved] != before.gamma[moved])
    assert np.all(np.any(after.normal[moved] != before.normal[moved], axis=1))
    assert np.allclose(after.normal[~moved], before.normal[~moved], atol=1e-12)
    assert np.allclose(after.offset[~moved], before.offset[~moved], atol=1e-12)
    assert np.array_equal(after.hardness != before.hardness, chosen)
    assert before.only(body).numbers(np.ones(1, dtype=bool)).size == before.only(body).size
