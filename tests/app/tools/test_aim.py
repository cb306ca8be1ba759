"""What is pulled stays under the pointer."""

from __future__ import annotations

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.app.tools.aim import Aim
from hqmodel.model import Camera

Spot = tuple[float, float, float]

cameras = st.builds(
    Camera,
    target=st.tuples(*[st.floats(-3, 3)] * 3),
    distance=st.floats(2, 30),
    azimuth=st.floats(0, 360),
    elevation=st.floats(-90, 90),
    orthographic=st.booleans(),
)
aims = st.builds(Aim, cameras, st.tuples(st.integers(200, 2000), st.integers(200, 1500)))
spots = st.tuples(*[st.floats(-0.5, 0.5)] * 3)
directions = spots.filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: np.array(v) / np.linalg.norm(v))
pixels = st.tuples(st.floats(-40, 40), st.floats(-40, 40))


@given(aims, spots, directions, st.floats(-0.3, 0.3))
def test_pulled_along_a_line_to_where_the_pointer_shows(aim: Aim, spot: Spot, direction: np.ndarray, far: float) -> None:
    point = np.array(aim.camera.target) + spot
    if aim.end_on(point, direction):
        return
    moved = aim.pixel(point + far * direction) - aim.pixel(point)
    assert aim.along(point, direction, (float(moved[0]), float(moved[1]))) == pytest.approx(far, abs=1e-6)


@given(aims, spots, pixels)
def test_pulled_in_the_picture_it_stays_under_the_pointer(aim: Aim, spot: Spot, moved: tuple[float, float]) -> None:
    point = np.array(aim.camera.target) + spot
    after = aim.pixel(point + aim.across(point, moved)) - aim.pixel(point)
    assert np.allclose(after, moved, atol=1e-6 * hypot(*aim.size))


@given(aims, st.floats(-170, 170), st.floats(0.2, 5))
def test_turning_and_spreading_are_polar_coordinates_about_the_pivot(aim: Aim, angle: float, factor: float) -> None:
    pivot = aim.camera.target
    x, y = aim.pixel(pivot)
    turn = np.radians(angle)
    moved = (100 * factor * np.cos(turn) - 100, -100 * factor * np.sin(turn))
    assert aim.turned(pivot, (x + 100, y), moved) == pytest.approx(angle, abs=1e-6)
    assert aim.spread(pivot, (x + 100, y), moved) == pytest.approx(factor)


def test_end_on_up_is_forwards() -> None:
    camera = Camera(azimuth=0, elevation=0, distance=5)
    aim = Aim(camera, (800, 600))
    assert aim.end_on((0, 0, 0), (0, -1, 0))
    assert aim.along((0, 0, 0), (0, -1, 0), (0, -30)) == pytest.approx(30 * aim.per_pixel((0, 0, 0)))


@given(aims)
def test_steps_are_round_and_of_a_size_to_aim_at(aim: Aim) -> None:
    step = aim.step
    mantissa = step / 10 ** np.floor(np.log10(step) + 1e-9)
    assert min(abs(mantissa - k) for k in (1, 2, 5)) < 1e-6
    assert replace(aim, grid=0.3).step == 0.3
    assert 10 < step / aim.per_pixel(aim.camera.target) < 32
