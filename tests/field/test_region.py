"""The region holds the body, is tight, and tells what has no end or no body."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.field import Terms, log_ratio, region
from hqmodel.model import Scene, Shape, Strip, Transform

from ..cases import NAMES, case

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def strips(*rows: tuple[tuple[float, float, float], float, int]) -> Scene:
    return Scene(shapes=(Shape(strips=tuple(Strip(normal=n, gamma=g, sign=s) for n, g, s in rows)),))


@pytest.mark.parametrize("name", NAMES)
def test_holds_the_body(name: str) -> None:
    scene = case(name).scene
    found = region(scene)
    assert found.bounded
    assert not (found.cut or found.empty)
    points = np.random.default_rng(4).uniform(-2.5, 2.5, (200_000, 3))
    body = points[log_ratio(Terms.of(scene), points) > 0]
    assert np.all((body >= found.low) & (body <= found.high))


@pytest.mark.parametrize("name", NAMES)
def test_loosely_it_holds_no_less(name: str) -> None:
    scene = case(name).scene
    loose, found = region(scene, loosely=True), region(scene)
    assert loose.bounded
    assert np.all(loose.low <= found.low + 0.05 * found.size)
    assert np.all(loose.high >= found.high - 0.05 * found.size)
    points = np.random.default_rng(6).uniform(-2.5, 2.5, (50_000, 3))
    body = points[log_ratio(Terms.of(scene), points) > 0]
    assert np.all((body >= loose.low) & (body <= loose.high))


@pytest.mark.parametrize("name", NAMES)
def test_is_tight(name: str) -> None:
    scene = case(name).scene
    found = region(scene)
    surface = np.random.default_rng(5).uniform(found.low, found.high, (400_000, 3))
    body = surface[log_ratio(Terms.of(scene), surface) > 0]
    reached = np.ptp(body, axis=0)
    assert np.all(found.size < 1.3 * reached + 0.02)


def test_a_sphere_far_away_and_small_is_found() -> None:
    far = Transform(translation=(1e5, -2e5, 3e5), scale=(1e-3, 1e-3, 1e-3))
    found = region(Scene(shapes=(Shape(transform=far, strips=tuple(Strip(normal=n) for n in (X, Y, Z))),)))
    np.testing.assert_allclose(found.centre, far.translation, atol=1e-4)
    np.testing.assert_allclose(found.size, 2e-3, rtol=0.1)


def test_an_endless_cylinder_is_told_and_shown_in_part() -> None:
    found = region(strips((X, 2.0, 1), (Y, 2.0, 1)))
    assert not found.bounded
    assert found.cut
    np.testing.assert_allclose([found.low[:2], found.high[:2]], [[-1, -1], [1, 1]], atol=0.05)
    assert 2 < found.size[2] < 100


def test_a_hyperboloid_of_one_sheet_has_no_end() -> None:
    assert not region(strips((X, 2.0, 1), (Y, 2.0, 1), (Z, 2.0, -1))).bounded


def test_a_hyperbolic_body_may_still_be_bounded() -> None:
    found = region(strips((X, 4.0, 1), (Y, 4.0, 1), (Z, 4.0, 1), (X, 2.0, -1)))
    assert found.bounded
    edge = np.sqrt((1 + np.sqrt(5)) / 2)
    np.testing.assert_allclose(found.high[0], edge, rtol=0.05)


def test_what_carves_all_that_is_far_away_bounds() -> None:
    pipe = Shape(strips=(Strip(normal=X), Strip(normal=Y)))
    away = Shape(coefficient=-1.0, constant=0.0, strips=(Strip(normal=Z, sign=-1),))
    found = region(Scene(shapes=(pipe, away)))
    assert found.bounded
    assert found.size[2] < 3
    assert np.all(region(Scene(shapes=(pipe, away)), loosely=True).size == found.size)


def test_bounds_cut() -> None:
    scene = strips((X, 2.0, 1), (Y, 2.0, 1)).changed(bounds=((-2, -2, -1), (2, 2, 3)))
    found = region(scene)
    assert found.bounded
    assert found.cut
    assert (found.low[2], found.high[2]) == (-1.0, 3.0)
    np.testing.assert_allclose(found.high[:2], 1, atol=0.05)


def test_a_flat_shape_is_a_plate() -> None:
    scene = strips((X, 2.0, 1), (Y, 2.0, 1)).changed(dimension=2)
    found = region(scene)
    assert found.bounded
    assert found.cut
    np.testing.assert_allclose(found.high[:2], 1, atol=0.05)
    assert -found.low[2] == found.high[2] == pytest.approx(0.02, rel=0.1)


@pytest.mark.parametrize(
    "scene",
    [
        Scene(shapes=()),
        strips((X, 2.0, 1), (Y, 2.0, 1), (Z, 2.0, 1)).changed(level=10.0),
        Scene(shapes=(Shape(coefficient=-1.0, strips=tuple(Strip(normal=n) for n in (X, Y, Z))),)),
        Scene(shapes=(Shape(constant=-1.0, strips=tuple(Strip(normal=n) for n in (X, Y, Z))),)),
    ],
)
def test_no_body(scene: Scene) -> None:
    assert region(scene).empty


def test_all_space_has_no_end() -> None:
    everywhere = strips((X, 2.0, 1), (Y, 2.0, 1), (Z, 2.0, 1)).changed(level=-1.0)
    assert not region(everywhere).bounded


def test_of_an_endless_body_far_out_a_box_in_order_is_shown() -> None:
    tilted = (Strip(normal=Z, sign=-1), Strip(normal=(-1e6, 1.0, 0.0), gamma=2.5))
    far = Strip(normal=(101205.0, 1.0, 0.0), offset=-1e6, gamma=3.0)
    for scene in (
        Scene(shapes=(Shape(constant=0.0, strips=(*tilted, far)),)),
        Scene(shapes=(Shape(strips=(Strip(normal=X, offset=-100.0), Strip(normal=Y))),)),
    ):
        found = region(scene)
        assert not found.bounded
        assert np.all(found.low < found.high)
