"""What the hand does to the camera."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.app.navigation import Button, Motion, Pointer, motion, navigated
from hqmodel.model import Camera

SIZE = (800, 600)
CAMERA = Camera((0.5, -0.2, 0.1), 6.0, 30.0, 20.0)


@pytest.mark.parametrize(
    ("button", "modifier", "expected"),
    [
        ("middle", "", "orbit"),
        ("middle", "shift", "pan"),
        ("left", "", "orbit"),
        ("left", "shift", "pan"),
        ("left", "ctrl", "zoom"),
        ("right", "", "pan"),
        ("left", "alt", "orbit"),
        ("middle", "alt", "pan"),
        ("right", "alt", "zoom"),
        (None, "", None),
    ],
)
def test_blenders_and_mayas_buttons_and_the_left_one_alone(button: Button | None, modifier: str, expected: Motion | None) -> None:
    assert motion(button, modifier) == expected


def test_nothing_moved_is_the_very_same_camera() -> None:
    assert navigated(CAMERA, Pointer((10, 10)), SIZE) is CAMERA
    assert navigated(CAMERA, Pointer((10, 10), (0, 0), "left"), SIZE) is CAMERA
    assert navigated(CAMERA, Pointer((10, 10), (5, 5)), SIZE) is CAMERA


def test_orbiting_keeps_target_and_distance() -> None:
    camera = navigated(CAMERA, Pointer((0, 0), (30, -10), "middle"), SIZE)
    assert camera == CAMERA.orbited(30, -10)
    assert (camera.target, camera.distance) == (CAMERA.target, CAMERA.distance)


def test_a_panned_point_stays_under_the_hand() -> None:
    camera = navigated(CAMERA, Pointer((0, 0), (40, 25), "right"), SIZE)
    before = CAMERA.project(CAMERA.target, SIZE)
    assert np.allclose(camera.project(CAMERA.target, SIZE), before + np.array([40, 25]))


def test_the_wheel_zooms_to_the_cursor() -> None:
    pixel = (620.0, 140.0)
    right, up, _ = CAMERA.axes()
    scale = 2 * CAMERA.half_height() / SIZE[1]
    point = np.asarray(CAMERA.target) + right * (pixel[0] - 400) * scale + up * (300 - pixel[1]) * scale
    camera = navigated(CAMERA, Pointer(pixel, wheel=(0, 2)), SIZE)
    assert camera.distance < CAMERA.distance
    assert np.allclose(camera.project(point, SIZE), pixel)


def test_dragging_up_with_ctrl_comes_nearer() -> None:
    assert navigated(CAMERA, Pointer((0, 0), (0, -40), "left", "ctrl"), SIZE).distance < CAMERA.distance
    assert navigated(CAMERA, Pointer((0, 0), (0, 40), "left", "ctrl"), SIZE).distance > CAMERA.distance


def test_two_fingers_sideways_orbit_and_with_shift_pan() -> None:
    assert navigated(CAMERA, Pointer((0, 0), wheel=(1, 0)), SIZE).azimuth != CAMERA.azimuth
    panned = navigated(CAMERA, Pointer((0, 0), modifier="shift", wheel=(1, 1)), SIZE)
    assert panned.target != CAMERA.target
    assert panned.distance == CAMERA.distance
