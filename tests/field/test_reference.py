"""The field, its derivatives and ray roots against the reference cases."""

from __future__ import annotations

import numpy as np
import pytest

from hqmodel.field import Terms, curvature, first_hits, gradient, log_gradient, log_ratio, region, value

from ..cases import NAMES, case


@pytest.mark.parametrize("name", NAMES)
def test_values(name: str) -> None:
    here = case(name)
    expected = here.rows("samples", "value")
    got = value(Terms.of(here.scene), here.rows("samples", "point"))
    np.testing.assert_allclose(got, expected, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_log_ratio_has_the_sign_of_the_field(name: str) -> None:
    here = case(name)
    expected = here.rows("samples", "value")
    clear = np.abs(expected) > 1e-12
    got = log_ratio(Terms.of(here.scene), here.rows("samples", "point"))
    assert np.array_equal(np.sign(got[clear]), np.sign(expected[clear]))


@pytest.mark.parametrize("name", NAMES)
def test_derivatives(name: str) -> None:
    here = case(name)
    terms, points = Terms.of(here.scene), here.rows("surface_points", "point")
    expected = here.rows("surface_points", "gradient")
    size = np.linalg.norm(expected, axis=1, keepdims=True)
    np.testing.assert_allclose(gradient(terms, points) / size, expected / size, atol=1e-12)
    ratio, slope = log_gradient(terms, points)
    assert np.max(np.abs(ratio)) < 1e-10
    np.testing.assert_allclose(slope / np.linalg.norm(slope, axis=1, keepdims=True), expected / size, atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_curvatures(name: str) -> None:
    here = case(name)
    got = curvature(Terms.of(here.scene), here.rows("surface_points", "point"))
    np.testing.assert_allclose(got.gaussian, here.rows("surface_points", "gaussian_curvature"), rtol=1e-4, atol=1e-12)
    np.testing.assert_allclose(got.mean, here.rows("surface_points", "mean_curvature"), rtol=1e-4, atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_rays(name: str) -> None:
    here = case(name)
    terms = Terms.of(here.scene)
    got = first_hits(terms, region(here.scene, terms), here.rows("rays", "origin"), here.rows("rays", "direction"))
    np.testing.assert_allclose(got, here.rows("rays", "distance"), rtol=0, atol=1e-9)
