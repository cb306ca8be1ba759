"""Patting brings the surface to where it is pressed and touches nothing behind; chopping leaves what is before the plane."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.edit import EditError, chop, clay_at, duplicate_shape, move_shapes, new_scene, new_shape, pat, put
from hqmodel.field import Terms, first_hits, region, value
from hqmodel.model import Scene, Shape, Strip


def entry(scene: Scene, origin: np.ndarray, direction: np.ndarray) -> float:
    return float(first_hits(Terms.of(scene), region(scene), origin, direction)[0])


def blended() -> Scene:
    """Two softly blended balls and a third that carves."""
    scene = duplicate_shape(put(new_scene(), "hardness", 3.0), 0)
    scene = move_shapes(duplicate_shape(scene, 1), [1], (0.9, 0.3, 0.0))
    return put(move_shapes(scene, [2], (0.0, 0.0, 1.4)), "shapes[2].coefficient", -1.0)


MIRRORED = put(move_shapes(new_scene(), [0], (-2.5, 0.0, 0.0)), "mirror", ["x"])


@pytest.mark.parametrize("scene", [new_scene(), blended(), MIRRORED], ids=["ball", "blended", "mirrored"])
@pytest.mark.parametrize("depth", [0.01, 0.1, 0.35])
@pytest.mark.parametrize("gamma", [6.0, 16.0, 60.0])
def test_the_surface_follows_the_hand(scene: Scene, depth: float, gamma: float) -> None:
    out = np.array([-0.6, -0.64, -0.48])
    middle = np.array(scene.shapes[0].transform.translation)
    start = middle + 5 * out
    point = start - entry(scene, start, -out) * out
    shape, image = clay_at(scene, point)
    assert np.all(image == 1)
    patted = pat(scene, shape, point, out, depth, gamma)
    assert patted.shapes[shape].strips[-1].gamma == gamma
    assert abs(float(value(Terms.of(patted), point - depth * out))) < 1e-6
    behind = middle + np.array([[0.5, 0.5, 0.4], [0.2, 0.6, 0.1]])
    assert np.allclose(value(Terms.of(patted), behind), value(Terms.of(scene), behind), rtol=1e-3)


def test_a_touch_changes_next_to_nothing() -> None:
    scene = new_scene()
    touched = pat(scene, 0, (0, 0, 1), (0, 0, 1), 1e-6)
    points = np.random.default_rng(3).uniform(-0.57, 0.57, (500, 3))
    assert np.allclose(value(Terms.of(touched), points), value(Terms.of(scene), points), atol=1e-5)


def test_pressing_harder_only_takes_away() -> None:
    points = np.random.default_rng(4).uniform(-1.1, 1.1, (4000, 3))
    inside = [value(Terms.of(pat(new_scene(), 0, (0, 0, 1), (0, 0, 1), depth)), points) > 0 for depth in (0.05, 0.2, 0.5)]
    assert np.all(inside[0] >= inside[1])
    assert np.all(inside[1] >= inside[2])
    assert inside[2].sum() < inside[0].sum()


def test_chop_cuts_at_the_plane_and_only_what_it_reaches() -> None:
    scene = move_shapes(duplicate_shape(new_scene(), 0), [1], (4.0, 0.0, 0.0))
    cut = chop(scene, [0, 1], (0.3, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert [len(shape.strips) for shape in cut.shapes] == [4, 3], "the second ball lies wholly beyond the plane"
    lone = cut.changed(shapes=cut.shapes[:1])
    assert entry(lone, np.array([5.0, 0, 0]), np.array([-1.0, 0, 0])) == pytest.approx(4.7, abs=0.01)
    assert entry(lone, np.array([-5.0, 0, 0]), np.array([1.0, 0, 0])) == pytest.approx(4.0, abs=1e-3)


def test_flat_scenes_are_cut_in_their_plane() -> None:
    flat = Scene(shapes=(new_shape("ball", 2),), dimension=2)
    cut = chop(flat, [0], (0.2, 0.0, 0.0), (1.0, 0.0, 0.5))
    assert cut.shapes[0].strips[-1].normal == (1.0, 0.0, 0.0)
    with pytest.raises(EditError, match="outline"):
        pat(flat, 0, (0, 0, 0.01), (0, 0, 1), 0.1)


def test_clay_is_what_adds() -> None:
    scene = blended()
    assert clay_at(scene, (0, 0, 0.6))[0] == 0, "the carving ball shapes the surface there, but is not clay"
    assert clay_at(scene, (1.8, 0.3, 0))[0] == 1
    _, image = clay_at(put(move_shapes(new_scene(), [0], (2, 0, 0)), "mirror", ["x", "z"]), (-2.9, 0, 0))
    assert image[0] == -1
    with pytest.raises(EditError, match="expected a visible shape that adds"):
        clay_at(Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)),), coefficient=-1.0),)), (0, 0, 0))
