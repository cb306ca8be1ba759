"""The lattice and the grown sphere, against the volume, the surface and each other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.random import default_rng

from hqmodel.field import (
    Terms,
    lattice_search,
    log_ratio,
    near_linear_gradient,
    normal_evolution,
    radial_solution,
    region,
)

from ..cases import case


@pytest.mark.parametrize("name", ["sphere", "composite_0", "two_holes", "thin_plate"])
def test_a_lattice_counts_the_volume_and_marks_its_rim(name: str) -> None:
    scene, truth = case(name)
    terms, where = Terms.of(scene), region(scene)
    found = lattice_search(terms, where, 60)
    cell = where.size / 60
    assert np.all(log_ratio(terms, found.points) > 0)
    assert len(found.points) * np.prod(cell) == pytest.approx(truth["volume"], rel=0.06)
    steps = np.concatenate([np.diag(cell), -np.diag(cell)])
    around = log_ratio(terms, found.points[:, None] + steps) > 0
    clear = np.all(np.abs(log_ratio(terms, found.points[:, None] + steps)) > 1e-9, axis=1)
    assert np.array_equal(found.outermost[clear], ~np.all(around, axis=1)[clear])


@pytest.mark.parametrize("name", ["sphere", "convex_1", "two_holes", "composite_1", "truncated_tetrahedron"])
def test_a_sphere_grown_along_the_normals_ends_on_the_surface(name: str) -> None:
    scene = case(name).scene
    terms, where = Terms.of(scene), region(scene)
    found = normal_evolution(terms, where, default_rng(5).normal(size=(300, 3)))
    assert found.converged.all()
    linear, slope = near_linear_gradient(terms, found.points)
    assert np.max(np.abs(linear) / np.linalg.norm(slope, axis=1)) < 1e-11 * np.max(where.size)
    assert found.iterations.max() < 60


def test_all_three_solve_the_ball_alike() -> None:
    scene = case("tetra_sphere").scene
    terms, where = Terms.of(scene), region(scene)
    directions = default_rng(6).normal(size=(100, 3))
    radius = radial_solution(terms, where, (0, 0, 0), directions).radius
    grown = np.linalg.norm(normal_evolution(terms, where, directions).points, axis=1)
    np.testing.assert_allclose(grown, radius, atol=1e-12)
    lattice = lattice_search(terms, where, 30)
    rim = np.linalg.norm(lattice.points[lattice.outermost], axis=1)
    assert np.all((rim < radius.min() + 1e-12) & (rim > radius.max() - np.linalg.norm(where.size / 30)))
