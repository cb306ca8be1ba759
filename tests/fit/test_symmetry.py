"""Mirror planes of clouds: found where there is one, wherever it lies, and only there."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from benchmarks.fit_clouds import true_points
from hqmodel.fit.cloud import prepared
from hqmodel.fit.symmetry import mirrored_frame

from ..cases import case

Array = NDArray[np.float64]
FLIP = np.array([-1.0, 1.0, 1.0])


def half(seed: int) -> Array:
    """A body without symmetry, beside the plane x = 0."""
    return true_points(case("convex_1").scene, 2000, np.random.default_rng(seed)) + np.array([1.3, 0.4, 0.0])


@pytest.fixture(scope="module")
def pair() -> Array:
    return np.concatenate([half(1), half(2) * FLIP])


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_plane_of_the_world_is_found(pair: Array, axis: int) -> None:
    frame = mirrored_frame(prepared(np.roll(pair, axis, axis=1), None, np.random.default_rng(0)))
    assert frame is not None
    assert frame.mirror_axis == axis
    assert frame.centre[axis] == 0
    assert np.array_equal(frame.rotation[0], np.eye(3)[axis])
    assert np.linalg.det(frame.rotation) == pytest.approx(1)


def test_a_plane_askew_is_found(pair: Array) -> None:
    turn = Rotation.from_rotvec([0.4, -0.3, 0.9]).as_matrix()
    frame = mirrored_frame(prepared(pair @ turn.T + np.array([3.0, 1.0, -2.0]), None, np.random.default_rng(0)))
    assert frame is not None
    assert frame.mirror_axis is None
    assert abs(frame.rotation[0] @ turn[:, 0]) > np.cos(np.radians(1))
    assert (frame.centre - (3.0, 1.0, -2.0)) @ turn[:, 0] == pytest.approx(0, abs=0.03)
    assert frame.rotation @ frame.rotation.T == pytest.approx(np.eye(3))


def test_where_there_is_none_none_is_found() -> None:
    assert mirrored_frame(prepared(half(3), None, np.random.default_rng(0))) is None
