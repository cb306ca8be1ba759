"""The preview's intersection: no ray missed, none that hits where there is nothing."""

from __future__ import annotations

import moderngl
import numpy as np
import pytest
from numpy.typing import NDArray

from hqmodel.field import Region, Terms, first_hits, log_ratio, region
from hqmodel.gpu import raycast, tracing
from hqmodel.model import Scene, Shape, Strip, Transform

from ..cases import NAMES, case
from .scenes import ball, random_rays, random_scene, solid

Array = NDArray[np.float64]
# The shortest way through the body, as a share of the region's diagonal, that the intersection promises to see.
_SEEN = 1e-5
BLOCK = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def _grazing(terms: Terms, where: Region, points: Array, directions: Array) -> NDArray[np.bool_]:
    """Whether rays that enter at the points leave the body again too soon to be promised."""
    way = _SEEN * float(np.linalg.norm(where.size)) * np.linspace(0.02, 1, 50)
    along = points[:, None] + way[:, None] * directions[:, None]
    left: NDArray[np.bool_] = np.any(log_ratio(terms, along) <= 0, axis=1)
    return left


def _compared(ctx: moderngl.Context, scene: Scene, count: int, seed: int) -> tuple[int, int]:
    """Rays that hit and rays that graze; all others agree with the reference."""
    terms, where = Terms.of(scene), region(scene)
    origins, directions = random_rays(np.random.default_rng(seed), where.low, where.high, count)
    expected = first_hits(terms, where, origins, directions)
    got = raycast(scene, origins, directions, ctx)
    size = float(np.max(where.size))
    same = np.isnan(expected) & np.isnan(got)
    same |= np.abs(np.nan_to_num(got, nan=np.inf) - np.nan_to_num(expected, nan=-np.inf)) < 1e-4 * size
    off = np.flatnonzero(~same)
    assert np.all(np.isfinite(expected[off])), "phantoms"
    graze = _grazing(terms, where, origins[off] + expected[off, None] * directions[off], directions[off])
    assert np.all(graze), (origins[off[~graze]], directions[off[~graze]], expected[off[~graze]], got[off[~graze]])
    return int(np.count_nonzero(np.isfinite(expected))), len(off)


@pytest.mark.parametrize("name", NAMES)
def test_reference_rays(ctx: moderngl.Context, name: str) -> None:
    here = case(name)
    expected = here.rows("rays", "distance")
    got = raycast(here.scene, here.rows("rays", "origin"), here.rows("rays", "direction"), ctx)
    assert np.array_equal(np.isnan(got), np.isnan(expected))
    np.testing.assert_allclose(got, expected, atol=1e-5)


@pytest.mark.parametrize("seed", range(10))
def test_random_scenes_that_only_add(ctx: moderngl.Context, seed: int) -> None:
    rng = np.random.default_rng(seed)
    hits, grazing = _compared(ctx, random_scene(rng, int(rng.integers(1, 6)), signs=False), 200, seed)
    assert hits > 5
    assert grazing <= 5


@pytest.mark.parametrize("seed", [1, 2, 3, 6, 8, 9, 10, 14, 15, 17, 20, 24])
def test_random_scenes_of_any_sign(ctx: moderngl.Context, seed: int) -> None:
    rng = np.random.default_rng(seed)
    hits, grazing = _compared(ctx, random_scene(rng, int(rng.integers(1, 6))), 200, seed)
    assert hits > 0
    assert grazing <= 5


@pytest.mark.parametrize("gamma", [0.3, 0.6, 1.0, 60.0, 400.0, 1000.0])
@pytest.mark.parametrize("half_width", [0.02, 0.001])
def test_thin_plates_at_any_exponent(ctx: moderngl.Context, gamma: float, half_width: float) -> None:
    strips = tuple(Strip(normal=n, gamma=gamma, half_width=w) for n, w in zip(BLOCK, (1.0, 1.0, half_width), strict=True))
    turned = Transform(rotation=(0.2, 0.4, 0.4, 0.8))
    hits, grazing = _compared(ctx, Scene(shapes=(Shape(strips=strips, transform=turned),)), 300, 7)
    assert hits > 5
    assert grazing <= (3 if gamma >= 1 else 10)


def test_rays_from_afar_keep_their_precision(ctx: moderngl.Context) -> None:
    place, radius = np.array([4e3, -7e3, 2e3]), 1e-2
    scene = ball((4e3, -7e3, 2e3), radius)
    towards = np.random.default_rng(4).normal(size=(50, 3))
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    got = raycast(scene, place - 5e3 * towards, towards, ctx)
    np.testing.assert_allclose(got, 5e3 - radius, atol=1e-6 * radius + 1e-11 * 5e3)


def test_the_length_of_a_direction_does_not_count(ctx: moderngl.Context) -> None:
    directions = np.outer([1e-200, 1e-3, 1.0, 1e250], [0.0, 0.0, -1.0])
    np.testing.assert_allclose(raycast(ball(), np.tile([0.1, 0.0, 3.0], (4, 1)), directions, ctx), 3 - np.sqrt(0.99), atol=1e-6)


def test_rays_that_are_none_miss(ctx: moderngl.Context) -> None:
    origins = np.array([[0.0, 0, 3], [np.nan, 0, 0], [0, 0, np.inf], [0, 0, 3]])
    directions = np.array([[0.0, 0, 0], [0, 0, 1], [0, 0, -1], [np.nan, 0, -1]])
    assert np.all(np.isnan(raycast(ball(), origins, directions, ctx)))
    assert raycast(ball(), np.empty((0, 3)), np.empty((0, 3)), ctx).shape == (0,)


@pytest.mark.parametrize("scene", [ball(), solid(0.6), solid(60.0)], ids=["convex", "lone", "hard"])
def test_inside_is_at_distance_0(ctx: moderngl.Context, scene: Scene) -> None:
    directions = np.random.default_rng(1).normal(size=(20, 3))
    assert np.all(raycast(scene, np.full((20, 3), 0.05), directions, ctx) == 0.0)


def test_caps_are_hit(ctx: moderngl.Context) -> None:
    strips = (Strip(normal=(1, 0, 0)), Strip(normal=(0, 1, 0)), Strip(normal=(0, 0, 1), sign=-1))
    scene = Scene(shapes=(Shape(strips=strips),), bounds=((-3, -3, -1.5), (3, 3, 1.5)))
    got = raycast(scene, [[0.2, 0.3, 4.0], [1.7, 0.0, 4.0], [1.9, 0.0, 4.0]], [[0.0, 0.0, -1.0]] * 3, ctx)
    np.testing.assert_allclose(got, [2.5, 2.5, np.nan], atol=1e-5)


def test_flat_scenes_are_plates(ctx: moderngl.Context) -> None:
    scene = Scene(dimension=2, shapes=(Shape(strips=(Strip(normal=(1, 0, 0)), Strip(normal=(0, 1, 0)))),))
    top = region(scene).high[2]
    got = raycast(scene, [[0.5, 0.5, 2.0], [0.9, 0.9, 2.0], [-3.0, 0.0, 0.0]], [[0, 0, -1], [0, 0, -1], [1, 0, 0]], ctx)
    np.testing.assert_allclose(got, [2 - top, np.nan, 2.0], atol=1e-5)


def test_nothing_is_hit_in_an_empty_scene(ctx: moderngl.Context) -> None:
    assert np.isnan(raycast(Scene(shapes=()), [[0.0, 0.0, 3.0]], [[0.0, 0.0, -1.0]], ctx)[0])


def _many(count: int, mirrored: bool) -> Scene:
    rng = np.random.default_rng(count)
    shapes = [
        Shape(
            strips=tuple(Strip(normal=n, gamma=4.0) for n in (*BLOCK, (1.0, 1.0, 1.0))),
            hardness=6.0,
            mirror=("x", "y", "z") if mirrored else (),
            transform=Transform(translation=tuple(rng.uniform(-3, 3, 3)), scale=(0.3, 0.3, 0.3)),
        )
        for _ in range(count)
    ]
    return Scene(shapes=tuple(shapes))


@pytest.mark.parametrize(("count", "mirrored"), [(256, False), (40, True)])
def test_many_shapes_take_several_draws(ctx: moderngl.Context, count: int, mirrored: bool) -> None:
    """More turns of loops than a shader may take at once."""
    scene = _many(count, mirrored)
    terms = Terms.of(scene)
    assert tracing.MOST_STEPS * (len(terms) + len(terms.inner)) > 10 * tracing.TURNS
    hits, grazing = _compared(ctx, scene, 64, 3)
    assert hits > 10
    assert grazing == 0


def _crowd(seed: int) -> Scene:
    """64 boxes, balls, cusps and plates at exponents from 0.3 to 400; every fifth carves, every tenth as a hyperboloid."""
    rng = np.random.default_rng(seed)
    shapes = []
    for number in range(64):
        carves, tapers = number % 5 == 4, number % 10 == 9
        widths = (1.0, 1.0, float(rng.choice([1.0, 0.02])) if not carves else 1.0)
        gammas = [2.0] * 3 if tapers else [float(rng.choice([0.3, 0.7, 1.0, 2.0, 8.0, 60.0, 400.0]))] * 3
        signs = (1, 1, -1 if tapers else 1)
        strips = (Strip(normal=n, gamma=g, half_width=w, sign=s) for n, g, w, s in zip(BLOCK, gammas, widths, signs, strict=True))
        x, y, z, w = (float(part) for part in rng.normal(size=4))
        length = float(np.linalg.norm([x, y, z, w]))
        size = float(rng.uniform(0.1, 0.2 if tapers else 0.6))
        transform = Transform(
            translation=tuple(rng.uniform(-1.5, 1.5, 3)),
            rotation=(x / length, y / length, z / length, w / length),
            scale=(size, size, size),
        )
        shapes.append(Shape(strips=tuple(strips), coefficient=-2.0 if carves else 1.0, hardness=12.0, transform=transform))
    return Scene(shapes=tuple(shapes))


@pytest.mark.parametrize("seed", range(3))
def test_a_crowd_with_holes(ctx: moderngl.Context, seed: int) -> None:
    hits, grazing = _compared(ctx, _crowd(seed), 120, seed)
    assert hits > 10
    assert grazing <= 2
