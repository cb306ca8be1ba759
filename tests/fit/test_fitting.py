"""Fits of clouds whose truth is known, and of what is no cloud of a body."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.fit_clouds import GOALS, cloud, radial_errors, random_superquadric, true_points
from hqmodel.field import Terms, log_ratio
from hqmodel.fit import FitError, fit
from hqmodel.mesh import polygonize, report
from hqmodel.model import Scene, Shape, Strip

from ..cases import case

Array = NDArray[np.float64]
COUNT = 1000


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("superquadric", "clean"),
        ("octahedron", "noise"),
        ("thin_plate", "outliers"),
        ("convex_0", "one side"),
    ],
)
def test_the_truth_is_found(name: str, kind: str) -> None:
    scene = case(name).scene
    fitted = fit(cloud(scene, kind, COUNT, 1), strips=4, seed=1)
    assert np.median(radial_errors(fitted.scene, scene)) < GOALS[kind]


def test_a_superquadric_half_seen_is_found_as_one() -> None:
    scene = random_superquadric(2)
    found = fit(cloud(scene, "one side", 500, 1)).scene
    assert np.median(radial_errors(found, scene)) < 1e-5
    shape, true = found.shapes[0], scene.shapes[0]
    assert [shape.groups[name].gamma for name in shape.groups] == pytest.approx([true.groups["rim"].gamma], rel=1e-3)
    assert sorted(strip.gamma for strip in shape.strips) == pytest.approx(sorted(strip.gamma for strip in true.strips), rel=1e-3)
    normals = np.array([strip.normal for strip in shape.strips])
    assert normals @ normals.T == pytest.approx(np.eye(3), abs=1e-8)


def test_where_no_group_is_needed_none_is_made() -> None:
    shape = fit(ball(400) * (1.0, 0.7, 0.5)).scene.shapes[0]
    assert not shape.groups
    assert [strip.gamma for strip in shape.strips] == pytest.approx([2.0] * 3, rel=1e-3)


def ball(count: int = COUNT) -> Array:
    points = np.random.default_rng(7).normal(size=(count, 3))
    return np.asarray(points / np.linalg.norm(points, axis=1, keepdims=True))


def test_the_same_seed_gives_the_same_scene() -> None:
    points = cloud(case("superquadric").scene, "noise", 200, 2)
    assert fit(points, strips=3, seed=5).scene == fit(points, strips=3, seed=5).scene


def test_a_cloud_far_off_and_small_is_fitted_as_well() -> None:
    fitted = fit(ball(400) * 1e-3 + np.array([5.0, -20.0, 3.0]), strips=3)
    assert fitted.report.largest < 1e-6
    assert fitted.scene.shapes[0].transform.translation == pytest.approx((5.0, -20.0, 3.0), abs=1e-8)


def test_residuals_are_distances_outward() -> None:
    moved = ball() * np.repeat([1.0, 1.1], [COUNT - 20, 20])[:, None]
    residuals = fit(moved, strips=3).residuals
    assert np.abs(residuals[:-20]).max() < 1e-3
    assert residuals[-20:] == pytest.approx(0.1, abs=2e-3)


def test_normals_tell_a_hollow_side_from_a_full_one() -> None:
    points = ball()
    points = points[points[:, 2] > 0.4]
    fitted = fit(points, points, strips=3)
    assert np.all(log_ratio(Terms.of(fitted.scene), 0.9 * points) > 0)
    assert np.all(log_ratio(Terms.of(fitted.scene), 1.1 * points) < 0)


def test_the_side_nobody_saw_stays_near() -> None:
    points = ball()
    fitted = fit(points[points[:, 0] > 0.2], strips=3)
    assert np.abs(polygonize(fitted.scene, 32).vertices).max() < 1.5


def dumbbell(axis: Array) -> Scene:
    """A large and a small ball on an axis, nearly apart."""
    balls = (
        Shape(strips=tuple(Strip(normal=tuple(n), half_width=radius, offset=float(-n @ axis * at)) for n in np.eye(3)))
        for at, radius in ((-1.0, 1.0), (0.9, 0.7))
    )
    return Scene(shapes=tuple(balls))


@pytest.fixture(scope="module")
def lobes() -> tuple[Scene, Any]:
    scene = dumbbell(np.array([1.0, 0.0, 0.0]))
    return scene, fit(true_points(scene, 800, np.random.default_rng(1)), parts=2, strips=3)


def test_several_parts_find_the_lobes(lobes: tuple[Scene, Any]) -> None:
    fitted = lobes[1]
    assert fitted.report.symmetric
    assert fitted.report.median < 2e-3
    middles = np.array([(-1.0, 0.0, 0.0), (0.9, 0.0, 0.0)])
    assert np.all(log_ratio(Terms.of(fitted.scene), middles) > 0)
    assert np.all(log_ratio(Terms.of(fitted.scene), np.array([(0.1, 0.7, 0.0), (0.1, 0.0, -0.7)])) < 0)


def test_what_several_parts_give_can_be_made(lobes: tuple[Scene, Any]) -> None:
    scene, fitted = lobes
    made, true = (report(polygonize(whole, 48)) for whole in (fitted.scene, scene))
    assert made["watertight"]
    assert made["volume"] == pytest.approx(true["volume"], rel=0.05)


@pytest.mark.parametrize(
    ("points", "told"),
    [
        (np.empty((0, 3)), "points: expected at least 12 that differ, got 0"),
        (np.ones((500, 3)), "points: expected at least 12 that differ, got 1"),
        (np.eye(3).repeat(100, axis=0), "points: expected at least 12 that differ, got 3"),
        (np.random.default_rng(0).normal(size=(5, 3)), "points: expected at least 12 that differ, got 5"),
        (np.outer(np.linspace(0, 1, 99), (1, 2, 3)), "points: expected the surface of a body, got points on a line"),
        (ball() * (1, 1, 0), "points: expected the surface of a body, got points in a plane"),
        (np.where(np.arange(90).reshape(30, 3) == 31, np.nan, ball(30)), "points[10]: expected finite numbers, got ["),
        (np.zeros((30, 2)), "points: expected rows of 3 numbers, got an array of shape (30, 2)"),
        (ball() * 1e-200, "points: expected coordinates that float64 can tell apart, got a cloud "),
        (ball() * 1e-9 + 1e6, "points: expected coordinates that float64 can tell apart, got a cloud "),
    ],
)
@pytest.mark.parametrize("parts", [1, 4])
def test_what_is_no_cloud_of_a_body_is_told(points: Array, told: str, parts: int) -> None:
    with pytest.raises(FitError) as error:
        fit(points, parts=parts)
    assert str(error.value).startswith(told)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("parts", [1, 2])
def test_a_dozen_points_and_duplicates_of_them_give_a_body(parts: int) -> None:
    corners = ball(14)
    fitted = fit(np.concatenate([corners] * 30), parts=parts, strips=3)
    assert fitted.report.median < 0.1
    assert len(polygonize(fitted.scene, 24).faces)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"parts": 0}, "parts"),
        ({"strips": 2}, "strips"),
        ({"tolerance": 0.5}, "tolerance"),
        ({"normals": np.ones((3, 3))}, "normals"),
    ],
)
def test_numbers_out_of_range_are_told(options: dict[str, Any], told: str) -> None:
    with pytest.raises(FitError, match=f"^{told}: expected "):
        fit(ball(), **options)


@pytest.mark.parametrize("parts", [1, 3])
def test_progress_rises_and_what_it_raises_ends_the_work(parts: int) -> None:
    shares: list[float] = []

    def enough(share: float, doing: str) -> None:
        assert doing
        shares.append(share)
        if share > 0.3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fit(cloud(dumbbell(np.array([0.0, 0.0, 1.0])), "clean", 400, 1), parts=parts, strips=3, progress=enough)
    assert shares == sorted(shares)


def test_five_million_points_are_thinned_out() -> None:
    from hqmodel.fit.cloud import MOST, prepared

    points = np.random.default_rng(0).normal(size=(5_000_000, 3))
    cloud = prepared(points, None, np.random.default_rng(0))
    assert len(cloud.points) == MOST
