"""Faces are where the planes are, and their polygons those of the polytope."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.edit import about, new_shape, put
from hqmodel.field import face, image_at, rotation_matrix
from hqmodel.model import Scene, Shape, Strip, Transform


@pytest.mark.parametrize(
    ("kind", "corners"), [("block", 4), ("tetrahedron", 3), ("octahedron", 3), ("dodecahedron", 5), ("icosahedron", 3)]
)
def test_polygons_of_the_solids(kind: str, corners: int) -> None:
    shape = new_shape(kind)
    for strip in range(len(shape.strips)):
        found = face(shape, 0.0, strip, 1)
        assert len(np.unique(np.round(found.polygon, 9), axis=0)) == corners
        assert np.allclose((found.polygon - found.middle) @ found.normal, 0)
        assert found.normal @ found.middle > 0


def test_it_goes_along_with_the_transform_the_slice_and_the_image() -> None:
    turn = about((1, 1, 0), 40)
    strips = (Strip(normal=(1, 0, 0), slice=1.0), Strip(normal=(0, 1, 0)), Strip(normal=(0, 0, 1)))
    shape = Shape(strips=strips, mirror=("x",), transform=Transform(translation=(3, 0, 0), rotation=turn, scale=(2, 1, 1)))
    found = face(shape, 0.25, 0, -1, (-1, 1, 1))
    middle = np.array([3, 0, 0]) + rotation_matrix(turn) @ np.array([2 * -1.25, 0, 0])
    assert np.allclose(found.middle, middle * (-1, 1, 1))
    assert found.thickness == pytest.approx(4.0)
    assert np.allclose(image_at(shape, 0.25, found.middle), (-1, 1, 1))
    assert np.allclose(image_at(shape, 0.25, middle), (1, 1, 1))


def test_a_plane_out_of_the_way_has_no_polygon() -> None:
    shape = new_shape("block")
    far = shape.changed(strips=(*shape.strips, Strip(normal=(1, 0, 0), half_width=5.0)))
    assert face(far, 0.0, 3, 1).polygon.shape == (0, 3)


def test_hyperbolic_strips_bound_nothing() -> None:
    scene = put(Scene(shapes=(new_shape("block"),)), "shapes[0].strips[1].sign", -1)
    assert np.ptp(face(scene.shapes[0], 0.0, 0, 1).polygon[:, 1]) > 4
