"""Angles to quaternions and back, against scipy's rotations."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hqmodel.edit import angles, quaternion

ANGLE = st.floats(-720, 720)


@given(ANGLE, ANGLE, ANGLE)
def test_turns_are_about_the_worlds_axes_one_after_the_other(x: float, y: float, z: float) -> None:
    ours = Rotation.from_quat(quaternion(x, y, z))
    theirs = Rotation.from_euler("xyz", (x, y, z), degrees=True)
    assert (ours * theirs.inv()).magnitude() < 1e-7


@given(ANGLE, ANGLE, ANGLE)
def test_angles_give_the_same_rotation_back(x: float, y: float, z: float) -> None:
    rotation = quaternion(x, y, z)
    again = quaternion(*angles(rotation))
    assert (Rotation.from_quat(rotation) * Rotation.from_quat(again).inv()).magnitude() < 1e-5


@pytest.mark.parametrize("y", [90.0, -90.0])
def test_where_two_axes_fall_together_x_has_it_all(y: float) -> None:
    for x, z in [(30, 0), (-50, 20), (10, 170), (180, 0)]:
        found = angles(quaternion(x, y, z))
        assert found[1:] == (y, 0.0)
        theirs = Rotation.from_euler("xyz", (x, y, z), degrees=True)
        assert (Rotation.from_euler("xyz", found, degrees=True) * theirs.inv()).magnitude() < 1e-5


def test_no_turn_is_no_angles() -> None:
    assert angles((0.0, 0.0, 0.0, 1.0)) == (0.0, 0.0, 0.0)
    assert np.allclose(quaternion(0, 0, 0), (0, 0, 0, 1))
