"""Mirror planes are found where they are exact, and nowhere else."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.field import Terms, log_ratio, mirror_axes, region

from ..cases import NAMES, case

EXPECTED = {
    "sphere": (0, 1, 2), "cuboctahedron": (0, 1, 2), "dodecahedron": (0, 1, 2), "mirrored": (0, 1), "tetrahedron": (),
    "two_holes": (0, 1, 2), "convex_0": (), "composite_1": (),
}  # fmt: skip


@pytest.mark.parametrize("name", EXPECTED)
def test_known_planes(name: str) -> None:
    scene = case(name).scene
    assert mirror_axes(Terms.of(scene), region(scene)) == EXPECTED[name]


@pytest.mark.parametrize("name", NAMES)
def test_a_plane_found_is_one(name: str) -> None:
    scene = case(name).scene
    terms = Terms.of(scene)
    points = np.random.default_rng(8).uniform(-1, 1, (500, 3))
    for axis in mirror_axes(terms, region(scene)):
        image = points.copy()
        image[:, axis] *= -1
        np.testing.assert_allclose(log_ratio(terms, image), log_ratio(terms, points), rtol=1e-12, atol=1e-12)


def test_a_cut_that_is_not_symmetric_counts() -> None:
    scene = case("sphere").scene.changed(bounds=((-0.5, -2, -2), (2, 2, 2)))
    assert mirror_axes(Terms.of(scene), region(scene)) == (1, 2)
