"""The formula stands twice, in NumPy and in field.glsl: both must say the same, spicy arguments included."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from hqmodel.field import Terms, first_hits, log_gradient, log_ratio, region, shaping_strip, value
from hqmodel.gpu import field_values
from hqmodel.gpu.packing import Frame
from hqmodel.model import Scene, Shape, Strip

from ..cases import NAMES, case
from ..strategies import scenes
from .scenes import ball, random_rays, random_scene, solid

Array = NDArray[np.float64]
# How far apart, in units of the region (and of the way out to a far point), float32 may put one and the same value of h.
_APART = 4e-5
# Beyond this float32's own ceilings show.
_CEILING = 1e28


def _tolerance(terms: Terms, points: Array, frame: Frame) -> Array:
    """What a shift of the point by float32's rounding changes in L, and rounding of L itself."""
    shift = _APART * (frame.scale + np.linalg.norm(points - frame.centre, axis=1))
    here = log_ratio(terms, points)
    change = np.zeros(len(points))
    for step in np.concatenate([np.eye(3), -np.eye(3), [[0.6, -0.5, 0.62], [-0.5, 0.6, 0.62]]]):
        with np.errstate(invalid="ignore"):
            moved = np.abs(log_ratio(terms, points + shift[:, None] * step) - here)
        change = np.maximum(change, np.nan_to_num(moved, nan=np.inf))
    result: Array = 2 * change + 2e-5 * (1 + np.abs(here))
    return result


def _assert_agreement(ctx: moderngl.Context, scene: Scene, points: Array) -> None:
    terms = Terms.of(scene)
    frame = Frame.of(region(scene, terms))
    expected, got = log_ratio(terms, points), field_values(ctx, scene, points).log_ratio
    assert np.all(np.isfinite(got))
    tame = np.abs(expected) < _CEILING
    off = np.abs(got - np.where(tame, expected, 0.0))
    allowed = _tolerance(terms, points, frame)
    worst = np.argmax(np.where(tame, off / allowed, 0.0))
    assert off[worst] <= allowed[worst] or not tame[worst], (points[worst], expected[worst], got[worst])
    beyond = np.flatnonzero(~tame & (np.abs(expected) < 1e290))
    assert np.array_equal(np.sign(got[beyond]), np.sign(expected[beyond]))


def _points(scene: Scene, rng: np.random.Generator, count: int) -> Array:
    """In the region, on its axes and faces, and far out."""
    where = region(scene)
    inside = rng.uniform(where.low, where.high, size=(count, 3))
    special = inside.copy()
    special[np.arange(count), rng.integers(0, 3, count)] = 0.0
    far = where.centre + np.exp(rng.uniform(0, 14, size=(count, 1))) * rng.normal(size=(count, 3)) * where.size
    return np.concatenate([inside, special, far])


@pytest.mark.parametrize("seed", range(40))
def test_random_scenes(ctx: moderngl.Context, seed: int) -> None:
    rng = np.random.default_rng(seed)
    scene = random_scene(rng, int(rng.integers(1, 7)))
    _assert_agreement(ctx, scene, _points(scene, rng, 100))


@settings(max_examples=60)
@given(scene=scenes(), seed=st.integers(0, 1000))
def test_whatever_the_format_permits(_context: moderngl.Context, scene: Scene, seed: int) -> None:
    points = _points(scene, np.random.default_rng(seed), 20)
    with _context:
        got = field_values(_context, scene, points)
        assert _context.error == "GL_NO_ERROR"
    for column in got:
        assert np.all(np.isfinite(column))


@pytest.mark.parametrize("name", NAMES)
def test_reference_values(ctx: moderngl.Context, name: str) -> None:
    here = case(name)
    expected = here.rows("samples", "value")
    got = field_values(ctx, here.scene, here.rows("samples", "point")).value
    assert np.max(np.abs(got - expected) / (1 + np.abs(expected))) < 2e-5


@pytest.mark.parametrize("name", NAMES)
def test_reference_normals_and_curvature(ctx: moderngl.Context, name: str) -> None:
    here = case(name)
    points, slope = here.rows("surface_points", "point"), here.rows("surface_points", "gradient")
    got = field_values(ctx, here.scene, points)
    np.testing.assert_allclose(got.normal, -slope / np.linalg.norm(slope, axis=1, keepdims=True), atol=2e-5)
    curvature = here.rows("surface_points", "gaussian_curvature")
    np.testing.assert_allclose(got.curvature, curvature, rtol=1e-3, atol=1e-3)
    assert np.array_equal(got.strip, shaping_strip(Terms.of(here.scene), points))


@pytest.mark.parametrize("signs", [False, True])
def test_normals_of_random_scenes(ctx: moderngl.Context, signs: bool) -> None:
    met = 0
    for seed in range(12):
        rng = np.random.default_rng(100 + seed)
        scene = random_scene(rng, 4, exponents=(1.0, 1.5, 2.0, 4.0, 20.0), signs=signs)
        terms, where = Terms.of(scene), region(scene)
        origins, directions = random_rays(rng, where.low, where.high, 60)
        distance = first_hits(terms, where, origins, directions)
        hit = np.isfinite(distance)
        points = origins[hit] + distance[hit, None] * directions[hit]
        ratio, slope = log_gradient(terms, points)
        surface = np.abs(ratio) < 1e-9  # not on a cap
        outwards = -slope[surface] / np.linalg.norm(slope[surface], axis=1, keepdims=True)
        np.testing.assert_allclose(field_values(ctx, scene, points[surface]).normal, outwards, atol=1e-3)
        met += int(np.count_nonzero(surface))
    assert met > 100


@pytest.mark.parametrize("place", [(0.0, 0.0, 0.0), (1e4, -2e4, 3e4)])
@pytest.mark.parametrize("radius", [1e-4, 1.0, 1e4])
def test_a_sphere_of_any_size_anywhere(ctx: moderngl.Context, place: tuple[float, float, float], radius: float) -> None:
    outwards = np.random.default_rng(5).normal(size=(100, 3))
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    got = field_values(ctx, ball(place, radius), place + radius * outwards)
    np.testing.assert_allclose(got.log_ratio, 0.0, atol=5e-6)
    np.testing.assert_allclose(got.normal, outwards, atol=5e-6)
    np.testing.assert_allclose(got.curvature * radius**2, 1.0, rtol=1e-4)


@pytest.mark.parametrize("gamma", [0.05, 0.3, 1.0, 2.0, 60.0, 1000.0])
def test_exponents_from_end_to_end(ctx: moderngl.Context, gamma: float) -> None:
    scene = solid(gamma)
    x = np.linspace(-1.3, 1.3, 101)
    points = np.stack([x, 0.3 * x, np.zeros_like(x)], axis=1)
    _assert_agreement(ctx, scene, points)
    assert np.array_equal(np.sign(field_values(ctx, scene, points).value), np.sign(value(Terms.of(scene), points)))


@pytest.mark.parametrize("level", [0.0, -0.5, 2.0])
def test_levels_of_either_sign(ctx: moderngl.Context, level: float) -> None:
    one = ball().shapes[0]
    scene = Scene(shapes=(one, one.changed(coefficient=-0.7, hardness=3.0)), level=level, bounds=((-2, -2, -2), (2, 2, 2)))
    _assert_agreement(ctx, scene, np.random.default_rng(9).uniform(-2, 2, size=(300, 3)))


def test_opposite_powers_that_both_overflow(ctx: moderngl.Context) -> None:
    """|x|^300 - |z|^300: their logarithms decide."""
    strips = (Strip(normal=(1, 0, 0), gamma=300.0, half_width=0.1), Strip(normal=(0, 0, 1), gamma=300.0, half_width=0.1, sign=-1))
    scene = Scene(shapes=(Shape(strips=strips),), bounds=((-1, -1, -1), (1, 1, 1)))
    points = np.random.default_rng(2).uniform(-1, 1, size=(500, 3))
    inside = field_values(ctx, scene, points).log_ratio > 0
    assert np.array_equal(inside, np.abs(points[:, 0]) < np.maximum(np.abs(points[:, 2]), 0.1))


def test_an_empty_scene_is_outside_everywhere(ctx: moderngl.Context) -> None:
    got = field_values(ctx, Scene(shapes=()), np.zeros((3, 3)))
    assert np.all(got.log_ratio < -1e30)
    assert np.all(got.value == -1.0)
    assert np.all(got.strip == -1)
