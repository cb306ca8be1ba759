"""Numbers over the whole permitted range: nothing is ever NaN, nothing warns, derivatives agree with differences."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hqmodel.field import (
    Terms,
    curvature,
    gradient,
    log_gradient,
    log_ratio,
    near_linear,
    near_linear_gradient,
    near_linear_single,
    shaping_strip,
    term_weights,
    value,
)
from hqmodel.model import Group, Scene, Shape, Strip

from ..cases import case
from ..strategies import scenes

EVERYWHERE = st.floats(allow_nan=False, allow_infinity=False)


@given(scenes(), st.lists(st.tuples(EVERYWHERE, EVERYWHERE, EVERYWHERE), min_size=1, max_size=4))
def test_everything_is_a_number_everywhere(scene: Scene, points: list[tuple[float, float, float]]) -> None:
    terms = Terms.of(scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for result in (value(terms, points), gradient(terms, points), *curvature(terms, points), term_weights(terms, points)):
            assert np.all(np.isfinite(result))
        ratio, slope = log_gradient(terms, points)
        assert not np.any(np.isnan(ratio))
        assert np.all(np.isfinite(slope))
        opposed = (np.any(terms.positive) or terms.level < 0) and (not np.all(terms.positive) or terms.level > 0)
        assert np.all(np.isfinite(log_ratio(terms, points))) == opposed
        if len(terms):
            assert np.all(shaping_strip(terms, points) < len(terms.inner))


@pytest.mark.parametrize("name", ["astroid", "composite_0", "cylinder", "two_holes", "mirrored", "convex_1"])
def test_gradients_are_differences(name: str) -> None:
    terms = Terms.of(case(name).scene)
    points = np.random.default_rng(1).uniform(-1.0, 1.0, (200, 3))
    step = 1e-6
    for field, slope in ((value, gradient(terms, points)), (log_ratio, log_gradient(terms, points)[1])):
        offsets = step * np.eye(3)
        differences = np.stack([(field(terms, points + e) - field(terms, points - e)) / (2 * step) for e in offsets], axis=1)
        size = 1 + np.linalg.norm(slope, axis=1, keepdims=True)
        assert np.quantile(np.abs(differences - slope) / size, 0.99) < 1e-5


def test_a_sphere_is_curved_evenly_on_its_axes_too() -> None:
    ball = Terms.of(case("sphere").scene)
    where = [(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.6, 0.8, 0.0), (0.0, 2.0, 0.0)]
    got = curvature(ball, where)
    np.testing.assert_allclose(got.gaussian, [1, 1, 1, 0.25], rtol=1e-12)
    np.testing.assert_allclose(got.mean, [1, 1, 1, 0.5], rtol=1e-12)


def test_opposite_powers_that_both_overflow_are_told_apart() -> None:
    def saddle(plus: float, minus: float) -> Terms:
        strips = (Strip(normal=(1, 0, 0), gamma=plus), Strip(normal=(0, 1, 0), gamma=minus, sign=-1))
        return Terms.of(Scene(shapes=(Shape(strips=strips),)))

    far = (30.0, 30.0, 0.0)
    assert log_ratio(saddle(900.0, 800.0), far) < 0 < log_ratio(saddle(800.0, 900.0), far)


def test_a_group_of_unlike_exponents_neither_over_nor_underflows() -> None:
    for inner, outer in ((1000.0, 0.05), (0.05, 1000.0), (1000.0, 1000.0), (0.05, 0.05)):
        strips = tuple(Strip(normal=n, gamma=inner, group="g") for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
        terms = Terms.of(Scene(shapes=(Shape(groups={"g": Group(gamma=outer)}, strips=strips),)))
        alone = log_ratio(terms, [(0.5, 0, 0), (10.0, 0, 0)])
        np.testing.assert_allclose(1 - alone, [0.5**outer, 10.0**outer if outer < 300 else 1e300], rtol=1e-12, atol=1e-15)


def test_what_is_not_there_has_no_field() -> None:
    nothing = Terms.of(Scene(shapes=(), level=0.5))
    assert value(nothing, np.zeros((2, 2, 3))).tolist() == [[-0.5, -0.5], [-0.5, -0.5]]
    assert log_ratio(nothing, np.zeros(3)) == -np.inf
    hidden = Shape(visible=False, strips=(Strip(normal=(1, 0, 0)),))
    assert len(Terms.of(Scene(shapes=(hidden, hidden.changed(visible=True, coefficient=0.0))))) == 0


@given(st.floats(-1e6, 1e6), st.sampled_from(["sphere", "thin_plate", "astroid", "composite_1"]))
def test_near_linear_keeps_the_sign(ratio: float, name: str) -> None:
    terms = Terms.of(case(name).scene)
    assert np.sign(near_linear(terms, np.array(ratio))) == np.sign(ratio) or abs(ratio) < 1e-12


def blend(gamma: float, **changes: Any) -> Scene:
    """Two shapes that add where they overlap, so that L exceeds what either comes to."""
    strips = tuple(Strip(normal=n, gamma=gamma) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    return Scene(shapes=(Shape(strips=strips, **changes), Shape(strips=strips, **changes)))


@pytest.mark.parametrize("gamma", [0.5, 2.0, 60.0, 400.0])
@pytest.mark.parametrize("changes", [{}, {"coefficient": 9.0, "hardness": 0.5}, {"constant": 4.0}, {"constant": -0.4}])
def test_near_linear_rises_with_the_field(gamma: float, changes: dict[str, float]) -> None:
    terms = Terms.of(blend(gamma, **changes))
    most = float(log_ratio(terms, np.zeros(3)))
    ratio = np.linspace(-20.0, most, 4001)
    values = near_linear(terms, ratio)
    assert np.all(np.diff(values) > 0)
    np.testing.assert_allclose(near_linear_single(terms, ratio), values, rtol=1e-4, atol=1e-5)
    points = np.random.default_rng(5).uniform(-1.2, 1.2, (200, 3))
    here, slope = log_gradient(terms, points)
    step = 1e-6 * np.maximum(1.0, np.abs(here))
    rise = (near_linear(terms, here + step) - near_linear(terms, here - step)) / (2 * step)
    np.testing.assert_allclose(near_linear_gradient(terms, points)[1], rise[:, None] * slope, rtol=1e-3, atol=1e-9)


def test_a_value_does_not_depend_on_its_neighbours() -> None:
    terms = Terms.of(case("composite_2").scene)
    points = np.random.default_rng(2).uniform(-1, 1, (1001, 3))
    assert np.array_equal(log_ratio(terms, points)[7:900], log_ratio(terms, points[7:900]))
    assert all(
        log_ratio(terms, point) == expected for point, expected in zip(points[:50], log_ratio(terms, points), strict=False)
    )
