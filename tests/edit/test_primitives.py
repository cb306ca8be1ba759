"""The shapes a scene is started from are what they are called."""

from __future__ import annotations

from math import cos, pi, sqrt

import numpy as np
import pytest
from scipy.spatial import ConvexHull, HalfspaceIntersection

from hqmodel.edit import PRIMITIVES, new_scene, new_shape, prism
from hqmodel.field import Terms, region, value, world_planes
from hqmodel.model import Scene, Shape


def inside(kind: str, *point: float) -> bool:
    scene = Scene(shapes=(new_shape(kind),))
    return bool(value(Terms.of(scene), np.array([point]))[0] > 0)


def polytope(shape: Shape) -> ConvexHull:
    """What the bounding planes enclose."""
    normals, offsets = world_planes(shape, 0.0)
    both = np.vstack([np.column_stack([s * normals, s * offsets - 1.0]) for s in (1, -1)])
    corners = HalfspaceIntersection(both, np.zeros(3)).intersections
    return ConvexHull(np.unique(np.round(corners, 9), axis=0))


@pytest.mark.parametrize("kind", ["ball", "block", "cylinder"])
def test_each_reaches_one_unit_along_every_axis(kind: str) -> None:
    for axis in np.vstack([np.eye(3), -np.eye(3)]):
        assert inside(kind, *(0.99 * axis))
        assert not inside(kind, *(1.01 * axis))


def test_only_the_block_has_its_corners_and_only_the_ball_no_rim() -> None:
    corner, rim = (0.9, 0.9, 0.9), (0.6, 0.6, 0.9)
    kinds = ("ball", "block", "cylinder")
    assert [inside(kind, *corner) for kind in kinds] == [False, True, False]
    assert [inside(kind, *rim) for kind in kinds] == [False, True, True]


# Corners, faces and volume of the regular solids whose corners are at distance 1.
SOLIDS = {
    "tetrahedron": (4, 4, 8 / (9 * sqrt(3))),
    "octahedron": (6, 8, 4 / 3),
    "dodecahedron": (20, 12, (15 + 7 * sqrt(5)) / 4 * (4 / (sqrt(3) * (1 + sqrt(5)))) ** 3),
    "icosahedron": (12, 20, 5 * (3 + sqrt(5)) / 12 * (4 / sqrt(10 + 2 * sqrt(5))) ** 3),
}


@pytest.mark.parametrize("kind", SOLIDS)
def test_the_regular_solids(kind: str) -> None:
    corners, faces, volume = SOLIDS[kind]
    hull = polytope(new_shape(kind))
    assert len(hull.vertices) == corners
    assert len(np.unique(np.round(hull.equations, 6), axis=0)) == faces
    assert np.allclose(np.linalg.norm(hull.points[hull.vertices], axis=1), 1.0, atol=1e-8)
    assert hull.volume == pytest.approx(volume, rel=1e-8)


@pytest.mark.parametrize("sides", [3, 4, 5, 6, 7, 12])
def test_prisms(sides: int) -> None:
    hull = polytope(prism(sides))
    assert len(hull.vertices) == 2 * sides
    assert hull.volume == pytest.approx(sides * np.sin(2 * pi / sides) / 2 * 2, rel=1e-9)
    assert np.min(hull.points[:, 1]) == pytest.approx(-cos(pi / sides)), "a side faces the front"


def test_a_taper_narrows_upwards() -> None:
    def width(z: float) -> float:
        xs = np.linspace(0, 3, 3001)
        filled = value(Terms.of(Scene(shapes=(new_shape("taper"),))), np.stack([xs, 0 * xs, 0 * xs + z], axis=1)) > 0
        return float(xs[filled].max(initial=0.0))

    assert width(-0.8) > 1.3 * width(0.0) > 1.5 * width(0.8) > 0


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_each_is_bounded_and_closed_around_the_origin(kind: str) -> None:
    box = region(Scene(shapes=(new_shape(kind),)))
    assert box.bounded
    assert not box.empty
    assert np.all(box.high < 2)
    assert inside(kind, 0, 0, 0)


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_each_has_an_outline_in_two_dimensions(kind: str) -> None:
    flat = Scene(shapes=(new_shape(kind, dimension=2),), dimension=2)
    assert flat.strip_count >= 2
    assert region(flat).bounded


def test_a_new_scene_is_a_ball() -> None:
    assert new_scene().shapes == (new_shape("ball"),)
