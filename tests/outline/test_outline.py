"""Outlines: areas in closed form, corners, holes, cuts, thin parts, and every node on the surface."""

from __future__ import annotations

from math import gamma, pi, sqrt

import numpy as np
import pytest

from hqmodel.field import Terms, log_ratio, near_linear_gradient
from hqmodel.files import load
from hqmodel.model import Scene, Shape, Strip, Transform
from hqmodel.outline import Outline, OutlineError, Plane, outline
from hqmodel.outline.curves import along

from ..cases import NAMES, case

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def superquadric(exponent: float, **more: object) -> Scene:
    return Scene.model_validate({"shapes": (Shape(strips=tuple(Strip(normal=n, gamma=exponent) for n in AXES)),), **more})


def nearly(drawn: Outline) -> float:
    """How far the area may be off: the tolerance along the whole outline."""
    return drawn.tolerance * drawn.length


@pytest.mark.parametrize("exponent", [0.5, 0.6, 1.0, 1.5, 2.0, 4.0, 20.0, 60.0, 400.0, 1000.0])
def test_the_area_of_a_superellipse(exponent: float) -> None:
    drawn = outline(superquadric(exponent))
    assert drawn.area == pytest.approx(4 * gamma(1 + 1 / exponent) ** 2 / gamma(1 + 2 / exponent), abs=nearly(drawn))
    assert len(drawn.curves) == 1


@pytest.mark.parametrize("plane", [Plane((0, 0, 1), 0.6), Plane((0, -2, 0), 1.2), Plane((1, 2, 3), 0.6 * sqrt(14))])
def test_a_ball_is_cut_in_circles(plane: Plane) -> None:
    drawn = outline(superquadric(2.0), plane)
    assert drawn.area == pytest.approx(0.64 * pi, abs=nearly(drawn))
    assert drawn.length == pytest.approx(1.6 * pi, rel=1e-4)
    points = plane.world(drawn.curves[0][:, 0])
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1.0, atol=1e-12)
    assert len(drawn.curves[0]) <= 12


def test_a_straight_sided_outline_has_its_corners_and_few_nodes() -> None:
    drawn = outline(superquadric(1.0))
    nodes = drawn.curves[0][:, 0]
    assert len(nodes) <= 6
    for corner in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        assert np.min(np.linalg.norm(nodes - corner, axis=1)) < 1e-9


@pytest.mark.parametrize("name", NAMES)
def test_every_curve_is_on_the_surface(name: str) -> None:
    scene = case(name).scene
    plane = Plane((0.0, 0.3, 1.0), 0.05)
    drawn, terms = outline(scene, plane), Terms.of(scene)
    size = float(np.max(drawn.bounds[1] - drawn.bounds[0]))
    for chain in drawn.curves:
        np.testing.assert_array_equal(chain[:, 3], np.roll(chain[:, 0], -1, axis=0))
        points = plane.world(along(chain, np.linspace(0, 1, 9))).reshape(-1, 3)
        value, slope = near_linear_gradient(terms, points)
        slope = slope @ plane.axes[:2].T
        off = np.abs(value) / np.maximum(np.linalg.norm(slope, axis=1), 1e-9)
        assert np.quantile(off, 0.99) < 3 * drawn.tolerance
        assert np.max(off) < 2e-3 * size  # beside a kink the slope says little


@pytest.mark.parametrize("name", NAMES)
def test_the_area_is_that_of_the_points_inside(name: str) -> None:
    scene = case(name).scene
    drawn = outline(scene)
    low, high = drawn.bounds
    count = 700
    steps = (np.arange(count) + 0.5) / count
    u, v = np.meshgrid(low[0] + steps * (high - low)[0], low[1] + steps * (high - low)[1])
    inside = log_ratio(Terms.of(scene), np.stack([u, v, np.zeros_like(u)], axis=-1)) > 1e-13
    assert drawn.area == pytest.approx(np.mean(inside) * np.prod(high - low), rel=0.01)


def test_holes_are_taken_away() -> None:
    scene = load("hex-nut")
    drawn = outline(scene)
    areas = sorted(Outline(drawn.plane, (chain,), drawn.tolerance).area for chain in drawn.curves)
    assert len(areas) == 2
    assert areas[0] < 0 < areas[1]
    assert drawn.area == pytest.approx(sum(areas))


@pytest.mark.parametrize(("plane", "across"), [(Plane(), 2.0), (Plane((1, 0, 1)), 2.0)])
def test_bounds_cut_the_outline_straight(plane: Plane, across: float) -> None:
    drawn = outline(superquadric(2.0, bounds=((-0.5, -2, -2), (0.5, 2, 2))), plane)
    points = plane.world(np.concatenate(drawn.polygons()))
    assert np.max(points[:, 0]) == pytest.approx(0.5, abs=1e-6)
    assert np.ptp(points[:, 1]) == pytest.approx(across, abs=1e-4)
    assert np.count_nonzero(np.abs(np.abs(points[:, 0]) - 0.5) < 1e-6) >= 4


def test_a_thin_part_askew_to_the_axes_is_found_whole() -> None:
    plate = (Strip(normal=(1, 0, 0)), Strip(normal=(0.3, 1, 0), half_width=2e-4, gamma=8), Strip(normal=(0, 0, 1)))
    drawn = outline(Scene(shapes=(Shape(strips=plate),)), precision=1e-6)
    exact = 4e-4 * gamma(0.5) * gamma(1.125) / gamma(1.625)  # the integral of (1 - x^2)^(1/8), twice the half-width each
    assert len(drawn.curves) == 1
    assert drawn.area == pytest.approx(exact, abs=nearly(drawn))


def test_an_outline_moves_with_its_shape_and_scales() -> None:
    moved = superquadric(3.0).changed(
        shapes=(superquadric(3.0).shapes[0].changed(transform=Transform(translation=(5, -3, 0), scale=(1e-3, 1e-3, 1e-3))),)
    )
    drawn, still = outline(moved), outline(superquadric(3.0))
    assert drawn.area == pytest.approx(still.area * 1e-6, rel=1e-4)
    np.testing.assert_allclose((drawn.bounds[0] + drawn.bounds[1]) / 2, [5, -3], atol=1e-6)
    assert still.scaled(10).area == pytest.approx(still.area * 100)


def test_a_polygon_stays_within_its_tolerance() -> None:
    rough = outline(superquadric(2.0)).polygons(0.01)[0]
    assert len(rough) < 40
    middles = (rough + np.roll(rough, -1, axis=0)) / 2
    assert np.min(np.linalg.norm(middles, axis=1)) > 1 - 0.0101


@pytest.mark.parametrize(
    ("scene", "plane", "told"),
    [
        (superquadric(2.0), Plane((0, 0, 1), 2.0), "no outline: the plane misses the body"),
        (superquadric(2.0), Plane((1, 1, 1), 1.8), "no outline: the plane misses the body"),
        (Scene(shapes=()), Plane(), "no outline: the field is below its level everywhere"),
        (Scene(shapes=(Shape(strips=(Strip(normal=(1, 0, 0)),)),)), Plane(), "bounds: expected a box"),
    ],
)
def test_what_has_no_outline_is_told(scene: Scene, plane: Plane, told: str) -> None:
    with pytest.raises(OutlineError, match=told):
        outline(scene, plane)


def test_a_flat_scene_is_its_outline() -> None:
    flat = (Strip(normal=(1, 0, 0), gamma=2), Strip(normal=(0, 1, 0), gamma=2))
    drawn = outline(Scene(dimension=2, shapes=(Shape(strips=flat),)))
    assert drawn.area == pytest.approx(pi, abs=nearly(drawn))
