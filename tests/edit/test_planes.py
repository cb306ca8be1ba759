"""Planes pushed, slid and tilted are where the hand has put them, and the opposite ones where they were."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.edit import EditError, about, angles, composed, push_plane, quaternion, slide_strip, spread_planes, tilt_strip
from hqmodel.field import rotation_matrix, world_planes
from hqmodel.model import Scene, Shape, Strip, Transform

unit = st.floats(-1, 1)
vectors = st.tuples(unit, unit, unit).filter(lambda v: float(np.linalg.norm(v)) > 0.1)


@st.composite
def scenes(draw: st.DrawFn) -> Scene:
    """One strip among others, anyhow turned, scaled, shifted and sliced."""
    strip = Strip(
        normal=draw(vectors),
        offset=draw(unit),
        slice=draw(unit),
        half_width=draw(st.floats(0.1, 3)),
        gamma=draw(st.floats(0.5, 50)),
    )
    x, y, z = (draw(st.floats(-180, 180)) for _ in range(3))
    scale = tuple(draw(st.floats(0.2, 4)) for _ in range(3))
    transform = Transform(translation=draw(st.tuples(unit, unit, unit)), rotation=quaternion(x, y, z), scale=scale)
    return Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)), strip), transform=transform),), slice=draw(unit))


def planes(scene: Scene) -> tuple[np.ndarray, float, float]:
    """Strip 1's unit direction and where its planes h = 1 and h = -1 are along it."""
    normals, offsets = world_planes(scene.shapes[0], scene.slice)
    length = np.linalg.norm(normals[1])
    return normals[1] / length, (1 - offsets[1]) / length, (-1 - offsets[1]) / length


sides = st.sampled_from([1, -1])


@given(scenes(), sides, st.floats(-0.05, 2))
def test_push_moves_one_plane_and_leaves_the_other(scene: Scene, side: int, distance: float) -> None:
    direction, *before = planes(scene)
    after = planes(push_plane(scene, 0, 1, side, distance))
    assert np.allclose(after[0], direction, atol=1e-12)
    moved, stays = (0, 1) if side == 1 else (1, 0)
    assert after[1 + moved] == pytest.approx(before[moved] + side * distance, abs=1e-9)
    assert after[1 + stays] == pytest.approx(before[stays], abs=1e-9)


@given(scenes(), sides)
def test_a_plane_stops_short_of_its_opposite(scene: Scene, side: int) -> None:
    _, near, far = planes(scene)
    _, near_after, far_after = planes(push_plane(scene, 0, 1, side, -2 * (near - far)))
    assert 0 < near_after - far_after < 0.01 * (near - far)


@given(scenes(), st.floats(-0.02, 2))
def test_spreading_keeps_the_middle(scene: Scene, distance: float) -> None:
    _, near, far = planes(scene)
    _, near_after, far_after = planes(spread_planes(scene, 0, 1, distance))
    assert near_after + far_after == pytest.approx(near + far, abs=1e-9)
    assert near_after == pytest.approx(near + distance, abs=1e-9)


@given(scenes(), sides, st.floats(-2, 2))
def test_sliding_keeps_the_thickness(scene: Scene, side: int, distance: float) -> None:
    _, near, far = planes(scene)
    _, near_after, far_after = planes(slide_strip(scene, 0, 1, side, distance))
    assert near_after == pytest.approx(near + side * distance, abs=1e-9)
    assert near_after - far_after == pytest.approx(near - far, abs=1e-9)


@given(scenes(), vectors, st.floats(-170, 170), vectors)
def test_tilting_turns_the_planes_about_the_pivot(
    scene: Scene, axis: tuple[float, ...], angle: float, pivot: tuple[float, ...]
) -> None:
    turn = rotation_matrix(about(axis, angle))
    tilted = tilt_strip(scene, 0, 1, pivot, turn)
    (before, near, far), (after, near_after, far_after) = planes(scene), planes(tilted)
    assert np.allclose(after, turn @ before, atol=1e-9)
    assert near_after - far_after == pytest.approx(near - far, abs=1e-9)
    assert near_after - after @ pivot == pytest.approx(near - before @ pivot, abs=1e-8)
    assert np.linalg.norm(tilted.shapes[0].strips[1].normal) == pytest.approx(np.linalg.norm(scene.shapes[0].strips[1].normal))


def test_a_flat_scene_stays_flat() -> None:
    scene = Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)), Strip(normal=(0, 1, 0)))),), dimension=2)
    tilted = tilt_strip(scene, 0, 1, (0, 1, 0), rotation_matrix(about((1, 1, 1), 30)))
    assert tilted.shapes[0].strips[1].normal[2] == 0


def test_what_is_not_there_is_named() -> None:
    scene = Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)),)),))
    with pytest.raises(EditError, match=r"shapes\[0\].strips\[3\]: expected an index from 0 to 0, got 3"):
        push_plane(scene, 0, 3, 1, 0.5)


@given(st.tuples(*[st.floats(-180, 180)] * 3), vectors, st.floats(-180, 180))
def test_turns_one_after_another_are_their_matrices_product(
    first: tuple[float, float, float], axis: tuple[float, ...], angle: float
) -> None:
    a, b = quaternion(*first), about(axis, angle)
    assert np.allclose(rotation_matrix(composed(b, a)), rotation_matrix(b) @ rotation_matrix(a), atol=1e-12)
    assert angles(about((0, 0, 2), 30)) == pytest.approx((0, 0, 30))
