"""The camera: what rays and projection promise each other, and what each motion keeps still."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.model import VIEWS, Camera

SIZE = (800, 600)
ANGLES = st.floats(-360, 360), st.floats(-90, 90)
cameras = st.builds(
    Camera,
    target=st.tuples(*[st.floats(-10, 10)] * 3),
    distance=st.floats(0.1, 100),
    azimuth=ANGLES[0],
    elevation=ANGLES[1],
    field_of_view=st.floats(10, 90),
    orthographic=st.booleans(),
)
pixels = st.tuples(st.floats(0, SIZE[0]), st.floats(0, SIZE[1]))


@given(cameras)
def test_axes_are_orthonormal_and_right_handed(camera: Camera) -> None:
    axes = camera.axes()
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)


@given(cameras, pixels, st.floats(0.1, 3))
def test_rays_go_where_projection_says(camera: Camera, pixel: tuple[float, float], along: float) -> None:
    origin, direction = camera.rays(pixel, SIZE)
    assert np.linalg.norm(direction) == pytest.approx(1)
    np.testing.assert_allclose(camera.project(origin + along * camera.distance * direction, SIZE), pixel, atol=1e-6)


@given(cameras, pixels)
def test_matrices_agree_with_projection(camera: Camera, pixel: tuple[float, float]) -> None:
    origin, direction = camera.rays(pixel, SIZE)
    point = origin + camera.distance * direction
    near, far = camera.distance / 100, camera.distance * 100
    clip = camera.projection_matrix(SIZE[0] / SIZE[1], near, far) @ camera.view_matrix() @ np.append(point, 1.0)
    x, y, z = clip[:3] / clip[3]
    np.testing.assert_allclose([(x + 1) / 2 * SIZE[0], (1 - y) / 2 * SIZE[1]], pixel, atol=1e-5)
    assert -1 < z < 1


@given(cameras, st.floats(-50, 50), st.floats(-50, 50))
def test_panning_moves_the_target_with_the_hand(camera: Camera, dx: float, dy: float) -> None:
    moved = camera.panned(dx, dy, SIZE[1])
    before = camera.project(camera.target, SIZE)
    np.testing.assert_allclose(moved.project(camera.target, SIZE) - before, [dx, dy], atol=1e-6)


@given(cameras, pixels, st.floats(-5, 5))
def test_zooming_keeps_what_is_under_the_cursor(camera: Camera, pixel: tuple[float, float], steps: float) -> None:
    right, up, _ = camera.axes()
    reach = camera.half_height() * 2 / SIZE[1]
    point = np.asarray(camera.target) + right * (pixel[0] - SIZE[0] / 2) * reach + up * (SIZE[1] / 2 - pixel[1]) * reach
    np.testing.assert_allclose(camera.zoomed(steps, pixel, SIZE).project(point, SIZE), pixel, atol=1e-6)


@given(cameras, st.floats(0.3, 3))
def test_framing_shows_the_whole_box_and_fills_the_picture(camera: Camera, aspect: float) -> None:
    size = (int(600 * aspect), 600)
    low, high = np.array([-1.0, -2.0, 0.5]), np.array([3.0, 2.0, 0.7])
    framed = camera.framing(low, high, size[0] / size[1])
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    share = np.abs(framed.project(corners, size) / np.array(size) * 2 - 1)
    assert np.max(share) <= 1 / 1.1 + 1e-9
    assert np.max(share) > 0.75


def test_standard_views() -> None:
    looks = {
        "front": (0, 1, 0),
        "right": (-1, 0, 0),
        "back": (0, -1, 0),
        "left": (1, 0, 0),
        "top": (0, 0, -1),
        "bottom": (0, 0, 1),
    }
    for view, towards in looks.items():
        np.testing.assert_allclose(-Camera().looking(view).axes()[2], towards, atol=1e-12)
    assert set(looks) | {"iso"} == set(VIEWS)


def test_orbiting_follows_the_hand_and_stops_at_the_poles() -> None:
    front = Camera().looking("front")
    assert front.orbited(-10, 0).position()[0] > front.position()[0]
    assert front.orbited(0, 10).position()[2] > front.position()[2]
    assert replace(front, elevation=80).orbited(0, 1000).elevation == 90
