"""Radii by Newton's method against ray casting and closed forms, and the point they are measured from."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import NDArray

from hqmodel.field import (
    NotStarShaped,
    Terms,
    approximate_radii,
    first_hits,
    log_ratio,
    make_frame,
    radial_solution,
    region,
    star_centre,
)
from hqmodel.model import Group, Scene, Shape, Strip, Transform

from ..cases import NAMES, case

Array = NDArray[np.float64]
# From no point inside these is all of the surface seen.
HIDDEN = {"composite_0", "composite_2", "two_holes"}
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def spread(count: int) -> Array:
    """Unit directions, the axes and diagonals among them."""
    away = default_rng(7).normal(size=(count, 3))
    away = np.concatenate([np.eye(3), -np.eye(3), np.stack(np.meshgrid(*[[-1, 1]] * 3), axis=-1).reshape(-1, 3), away])
    return away / np.linalg.norm(away, axis=1, keepdims=True)


def balls(*places: tuple[float, float, float], coefficient: float = 1.0, hardness: float = 2.0) -> tuple[Shape, ...]:
    strips = tuple(Strip(normal=axis) for axis in (X, Y, Z))
    return tuple(
        Shape(strips=strips, coefficient=coefficient, hardness=hardness, transform=Transform(translation=p)) for p in places
    )


def in_frame(frame: Array, gamma: float, t: float) -> Scene:
    strips = tuple(Strip(normal=(a, b, c), slice=d, gamma=gamma) for a, b, c, d in frame.tolist())
    return Scene(slice=t, shapes=(Shape(strips=strips),))


def judge(scene: Scene, centre: Array, directions: Array) -> NDArray[np.intp]:
    """The iterations, after all radii were found to be those of rays cast inwards."""
    terms, where = Terms.of(scene), region(scene)
    found = radial_solution(terms, where, centre, directions)
    assert found.converged.all()
    far = 2 * float(np.linalg.norm(where.size))
    cast = far - first_hits(terms, where, centre + far * directions, -directions)
    np.testing.assert_allclose(found.radius, cast, rtol=0, atol=1e-9)
    return found.iterations


@pytest.mark.parametrize("name", sorted(set(NAMES) - HIDDEN))
def test_every_direction_of_every_star_shaped_case(name: str) -> None:
    scene = case(name).scene
    iterations = judge(scene, star_centre(Terms.of(scene), region(scene)), spread(1500))
    assert iterations.min() >= 1
    assert iterations.max() <= 16
    assert iterations.mean() <= 8


@pytest.mark.parametrize("name", sorted(HIDDEN))
def test_what_is_not_star_shaped_is_told_with_the_place(name: str) -> None:
    scene = case(name).scene
    pattern = r"expected a body all seen from one point inside, got one turned away from \(.+\) at \(.+\)"
    with pytest.raises(NotStarShaped, match=pattern):
        star_centre(Terms.of(scene), region(scene))


@pytest.mark.parametrize("name", sorted(HIDDEN))
def test_from_nowhere_inside_those_is_all_seen(name: str) -> None:
    """From each of many points inside, the straight way to some of the outermost leads out of the body and in again."""
    scene = case(name).scene
    terms, where = Terms.of(scene), region(scene)
    points = default_rng(2).uniform(where.low, where.high, (20_000, 3))
    depth = log_ratio(terms, points)
    outermost = points[np.argsort(np.where(depth > 0, depth, np.inf))[:600]]
    for centre in points[depth > 0][:60]:
        ways = centre + np.linspace(0.3, 0.98, 18)[:, None, None] * (outermost - centre)
        assert np.any(log_ratio(terms, ways) < 0)


def test_at_gamma_2_an_orthonormal_frame_needs_no_iteration() -> None:
    """The approximate solution is the solution: a sphere of radius sqrt(1 - t^2)."""
    scene = in_frame(make_frame("random", 9, 4), 2.0, 0.6)
    start = approximate_radii(Terms.of(scene), np.zeros(3), spread(200))
    np.testing.assert_allclose(start, 0.8, rtol=1e-12)
    assert np.all(judge(scene, np.zeros(3), spread(200)) == 1)


@pytest.mark.parametrize("gamma", [0.5, 1.0, 5.0, 80.0])
def test_with_as_many_strips_as_axes_too(gamma: float) -> None:
    """D = N: the radius of |x|^g + |y|^g + |z|^g = 1 where the sphere's point (u, v, w) is mapped to."""
    scene = in_frame(make_frame("cube"), gamma, 0.0)
    u = spread(50)
    x = np.sign(u) * np.abs(u) ** (2 / gamma)
    np.testing.assert_allclose(approximate_radii(Terms.of(scene), np.zeros(3), u), np.linalg.norm(x, axis=1), rtol=1e-12)


@pytest.mark.parametrize(("gamma", "t"), [(1.0, 0.3), (3.0, 0.5), (60.0, 1.2), (1000.0, 1.9)])
def test_slices_off_the_middle(gamma: float, t: float) -> None:
    """Beyond |t| = 1, too, where the sphere that the approximate solution begins with is empty."""
    scene = in_frame(make_frame("hadamard4"), gamma, t)
    judge(scene, star_centre(Terms.of(scene), region(scene)), spread(300))


def test_any_point_inside_will_do_for_a_convex_body() -> None:
    scene = in_frame(make_frame("ico6"), 8.0, 0.0)
    rng = default_rng(3)
    centres = rng.uniform(-1.2, 1.2, (40, 3))
    for centre in centres[log_ratio(Terms.of(scene), centres) > 0][:6]:
        judge(scene, centre, spread(100))


def test_groups_and_transforms() -> None:
    strips = (Strip(normal=X, group="side", gamma=3.0), Strip(normal=Y, group="side", gamma=3.0), Strip(normal=Z, gamma=30.0))
    placed = Transform(translation=(5.0, -2.0, 1.0), rotation=(0.5, 0.5, 0.5, 0.5), scale=(1.0, 2.0, 0.3))
    scene = Scene(shapes=(Shape(strips=strips, groups={"side": Group(gamma=12.0)}, transform=placed),))
    centre = star_centre(Terms.of(scene), region(scene))
    np.testing.assert_allclose(centre, (5, -2, 1), atol=1e-12)
    judge(scene, centre, spread(300))


def test_a_cusp_is_seen_from_its_own_point_alone() -> None:
    strips = tuple(Strip(normal=axis, gamma=0.6) for axis in (X, Y, Z))
    scene = Scene(shapes=(Shape(strips=strips, transform=Transform(translation=(0.3, 0.1, -0.7))),))
    centre = star_centre(Terms.of(scene), region(scene))
    np.testing.assert_allclose(centre, (0.3, 0.1, -0.7), atol=1e-15)
    judge(scene, centre, spread(200))


def test_what_is_too_fine_to_be_seen_is_refused() -> None:
    """Spikes that no ray meets, and whose middle is lost to rounding."""
    strips = tuple(Strip(normal=axis, gamma=0.05, offset=0.3) for axis in (X, Y, Z, (0.3, 0.4, 0.5)))
    scene = Scene(shapes=(Shape(strips=strips),))
    with pytest.raises(NotStarShaped, match="expected a body all seen from one point inside"):
        star_centre(Terms.of(scene), region(scene))


@pytest.mark.parametrize("apart", [0.6, 0.9, 1.2, 2.0, 3.0])
def test_two_balls_that_flow_together_and_come_apart(apart: float) -> None:
    """Of two equal balls the waist is seen from the middle as long as they are one body, and not when they are two."""
    scene = Scene(shapes=balls((apart, 0, 0), (-apart, 0, 0)))
    terms, where = Terms.of(scene), region(scene)
    if log_ratio(terms, (0.0, 0.0, 0.0)) > 0:
        centre = star_centre(terms, where)
        np.testing.assert_array_equal(centre, 0)
        judge(scene, centre, spread(300))
    else:
        with pytest.raises(NotStarShaped):
            star_centre(terms, where)


def test_a_dent_is_seen_and_a_bite_from_behind_is_not() -> None:
    dented = Scene(shapes=(*balls((0, 0, 0)), *balls((1.8, 0, 0), coefficient=-1.0)))
    judge(dented, star_centre(Terms.of(dented), region(dented)), spread(500))
    hollow = Scene(shapes=(*balls((0, 0, 0)), *balls((0, 0, 0), coefficient=-2.5, hardness=8.0)))
    with pytest.raises(NotStarShaped):
        star_centre(Terms.of(hollow), region(hollow))


def test_the_cut_of_an_endless_body_is_its_surface() -> None:
    pipe = Scene(shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),), bounds=((-2, -2, -1), (2, 2, 1.5)))
    found = radial_solution(Terms.of(pipe), region(pipe), (0, 0, 0), [(0, 0, 3), (0, 0, -1), (1, 0, 1), (1, 0, 0), (1, 0, -2)])
    np.testing.assert_allclose(found.radius, [1.5, 1.0, sqrt(2), 1.0, sqrt(1.25)], atol=1e-12)
    assert found.converged.all()


def test_a_centre_outside_is_refused() -> None:
    scene = case("sphere").scene
    with pytest.raises(ValueError, match=r"expected a centre inside the body, got \(2\.0, 0\.0, 0\.0\)"):
        radial_solution(Terms.of(scene), region(scene), (2, 0, 0), [(1, 0, 0)])


def test_bad_first_guesses_only_cost_time() -> None:
    scene = case("convex_1").scene
    terms, where = Terms.of(scene), region(scene)
    best = radial_solution(terms, where, (0, 0, 0), spread(100))
    for start in (np.nan, -1.0, 1e9, 1e-9):
        other = radial_solution(terms, where, (0, 0, 0), spread(100), start=np.full(114, start))
        assert other.converged.all()
        np.testing.assert_allclose(other.radius, best.radius, atol=1e-12)
