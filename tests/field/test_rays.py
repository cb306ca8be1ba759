"""Ray casting against closed forms and against brute force: thin parts, caps, origins inside."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.random import default_rng

from hqmodel.field import Terms, first_hits, log_ratio, region
from hqmodel.model import Scene, Shape, Strip

from ..cases import case
from ..gpu.scenes import random_rays, random_scene

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def cast(scene: Scene, origins: object, directions: object) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return first_hits(Terms.of(scene), region(scene), np.array(origins, dtype=float), np.array(directions, dtype=float))


def test_a_sphere_in_closed_form() -> None:
    origins, directions = random_rays(default_rng(6), -np.ones(3), np.ones(3), 2000)
    b = np.einsum("ij,ij->i", origins, directions)
    square = b * b - np.einsum("ij,ij->i", origins, origins) + 1
    expected = np.where(square > 0, -b - np.sqrt(np.maximum(square, 0)), np.nan)
    clear = np.abs(square) > 1e-10
    np.testing.assert_allclose(cast(case("sphere").scene, origins, directions)[clear], expected[clear], atol=1e-11)


def test_directions_of_any_length_give_world_distances() -> None:
    ball = case("sphere").scene
    got = cast(ball, [(-3, 0, 0)] * 4, [(1e-200, 0, 0), (5, 0, 0), (1e300, 0, 0), (1, 0, 0)])
    np.testing.assert_allclose(got, 2.0, rtol=1e-12)


def test_what_is_no_ray_misses() -> None:
    got = cast(case("sphere").scene, [(-3, 0, 0), (np.nan, 0, 0), (-3, 0, 0)], [(0, 0, 0), (1, 0, 0), (np.inf, 0, 0)])
    assert np.all(np.isnan(got))


def test_inside_is_at_distance_zero() -> None:
    assert cast(case("sphere").scene, [(0.2, 0, 0)], [(1, 0, 0)])[0] == 0


def test_a_leaf_a_millionth_thick_is_not_missed() -> None:
    leaf = Strip(normal=Z, half_width=1e-6, gamma=60.0)
    scene = Scene(shapes=(Shape(strips=(Strip(normal=X, gamma=60.0), Strip(normal=Y, gamma=60.0), leaf)),))
    rng = default_rng(7)
    origins = np.column_stack([rng.uniform(-0.5, 0.5, (500, 2)), rng.uniform(1, 2, 500)])
    targets = np.column_stack([rng.uniform(-0.8, 0.8, (500, 2)), np.zeros(500)])
    got = cast(scene, origins, targets - origins)
    np.testing.assert_allclose(got, np.linalg.norm(targets - origins, axis=1), atol=1e-5)


def test_a_cut_body_is_entered_through_its_caps() -> None:
    pipe = Scene(shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),), bounds=((-2, -2, -1), (2, 2, 1.5)))
    got = cast(pipe, [(0.3, 0.2, 5), (0.3, 0.2, -5), (3, 0, 0), (3, 0, 1.6)], [(0, 0, -1), (0, 0, 1), (-1, 0, 0), (-1, 0, 0)])
    np.testing.assert_allclose(got, [3.5, 4, 2, np.nan], atol=1e-11)


@pytest.mark.parametrize("seed", range(12))
def test_random_scenes_against_brute_force(seed: int) -> None:
    """No sample along a ray lies inside before its hit; the hit itself lies on the surface."""
    rng = default_rng(seed)
    scene = random_scene(rng, shapes=1 + seed % 4, exponents=(0.3, 0.6, 1.0, 2.0, 8.0, 40.0, 400.0))
    terms, where = Terms.of(scene), region(scene)
    if where.empty:
        return
    origins, directions = random_rays(rng, where.low, where.high, 60)
    got = first_hits(terms, where, origins, directions)
    steps = np.linspace(0, 4 * float(np.linalg.norm(where.size)), 4001)
    points = origins[:, None] + steps[:, None] * directions[:, None]
    inside = (log_ratio(terms, points) > 0) & np.all((points > where.low) & (points < where.high), axis=2)
    assert not np.any(inside & (steps < np.where(np.isnan(got), np.inf, got - 1e-9)[:, None]))
    hit = ~np.isnan(got)
    entry = origins[hit] + got[hit, None] * directions[hit]
    around = 1e-7 * float(np.max(where.size)) * directions[hit]
    beyond = log_ratio(terms, entry + around) > 0
    on_cap = np.any((np.abs(entry - where.low) < 1e-9) | (np.abs(entry - where.high) < 1e-9), axis=1)
    just = log_ratio(terms, entry + 1e-3 * around) > 0
    assert np.mean(beyond | just | on_cap) > 0.98 if hit.any() else True
