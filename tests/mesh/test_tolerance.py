"""Meshes within a tolerance: what is promised is measured by other means, and costs few triangles."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from hqmodel.field import Terms, first_hits, log_ratio, region
from hqmodel.mesh import Mesh, MeshError, polygonize, report
from hqmodel.model import Scene, Shape, Strip

from ..cases import NAMES, case
from ..gpu.scenes import random_rays
from .volumes import scene_of

Array = NDArray[np.float64]
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def length(mesh: Mesh) -> float:
    return float(np.max(np.ptp(mesh.vertices, axis=0)))


def spots(mesh: Mesh, count: int) -> tuple[Array, Array]:
    """Points spread evenly over the faces, with the middles of all edges and faces, and the faces' normals there."""
    corners = mesh.vertices[mesh.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(normals, axis=1)
    rng = default_rng(0)
    chosen = rng.choice(len(corners), count, p=area / area.sum())
    spread = np.einsum("ni,nij->nj", rng.dirichlet(np.ones(3), count), corners[chosen])
    sides = (corners + np.roll(corners, 1, axis=1)).reshape(-1, 3) / 2
    normals = np.concatenate([normals[chosen], normals, np.repeat(normals, 3, axis=0)])
    points = np.concatenate([spread, corners.mean(axis=1), sides])
    return points, normals / np.linalg.norm(normals, axis=1, keepdims=True)


def beyond(scene: Scene, points: Array, normals: Array, distance: float) -> int:
    """How many of the points have no surface within that distance.

    It is near where one of some points along the normal is on the other side of it, or where a vertex of a fine mesh is near.
    """
    terms = Terms.of(scene)
    where = region(scene, terms)

    def inside(at: Array) -> NDArray[np.bool_]:
        kept = np.all((at >= where.low) & (at <= where.high), axis=1) if where.cut else np.ones(len(at), dtype=bool)
        return (log_ratio(terms, at) > 0) & kept

    left, sides = np.arange(len(points)), inside(points)
    for share in (1, -1, 0.5, -0.5, 0.2, -0.2, 0.05, -0.05):
        left = left[inside(points[left] + share * distance * normals[left]) == sides[left]]
    away, _ = cKDTree(polygonize(scene, 160, shading=False).vertices).query(points[left])
    return int(np.count_nonzero(away > distance))


def hits(scene: Scene, count: int) -> Array:
    """Points of the true surface that random rays meet, by exact bounds."""
    terms = Terms.of(scene)
    where = region(scene, terms)
    origins, directions = random_rays(default_rng(0), where.low, where.high, count)
    points: Array = origins + first_hits(terms, where, origins, directions)[:, None] * directions
    return points[np.isfinite(points[:, 0])]


def away(points: Array, mesh: Mesh) -> Array:
    """How far points (n, 3) are from the nearest triangle, (n,)."""
    corners = mesh.vertices[mesh.faces]
    sides = np.roll(corners, -1, axis=1) - corners
    normals = np.cross(sides[:, 0], sides[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    squares = np.sum(sides * sides, axis=2)
    result = np.empty(len(points))
    for i, point in enumerate(points):
        way = point - corners
        share = np.clip(np.sum(way * sides, axis=2) / squares, 0, 1)
        beside = np.linalg.norm(way - share[..., None] * sides, axis=2).min(axis=1)
        above = np.all(np.sum(np.cross(sides, way) * normals[:, None], axis=2) > 0, axis=1)
        result[i] = np.min(np.where(above, np.abs(np.sum(way[:, 0] * normals, axis=1)), beside))
    return result


def as_promised(scene: Scene, mesh: Mesh, tolerance: float) -> None:
    assert mesh.surface_error is not None
    assert mesh.surface_error <= tolerance
    assert beyond(scene, *spots(mesh, 8_000), tolerance) == 0
    measured = report(mesh)
    assert measured["watertight"]
    plain = report(polygonize(scene, mesh.resolution, shading=False))
    assert measured["euler_number"] == plain["euler_number"]
    assert abs(measured["volume"] - plain["volume"]) < measured["area"] * tolerance


@pytest.mark.parametrize("name", NAMES)
def test_reference(name: str) -> None:
    scene = case(name).scene
    tolerance = 1.2e-2 * length(polygonize(scene, 32, shading=False))
    resolution = None if name.startswith("composite") else 40  # where thin parts and creases ask for more
    as_promised(scene, polygonize(scene, resolution, tolerance=tolerance), tolerance)


@pytest.mark.parametrize("seed", [1, 9])
def test_random_scenes(seed: int) -> None:
    """Tips and crests that so few cells don't see well may miss the tolerance, but by no more than is said."""
    scene = scene_of(seed)
    coarse = polygonize(scene, 32, shading=False)
    tolerance = 6e-3 * length(coarse)
    mesh = polygonize(scene, 64, tolerance=tolerance)
    assert mesh.surface_error is not None
    stated = max(tolerance, mesh.surface_error)
    as_promised(scene, mesh, stated)
    assert np.max(away(hits(scene, 300), mesh)) <= stated
    assert len(mesh.faces) < 0.3 * len(coarse.faces)


def test_a_rim_that_is_sharper_than_the_cells() -> None:
    scene = case("thin_plate").scene
    mesh = polygonize(scene, 72, tolerance=5e-4)
    as_promised(scene, mesh, 5e-4)
    assert len(mesh.faces) < 0.25 * len(polygonize(scene, 72, shading=False).faces)


def test_a_cut_body() -> None:
    pipe = Scene(shapes=(Shape(strips=(Strip(normal=X), Strip(normal=Y))),), bounds=((-2, -2, -1), (2, 2, 1.5)))
    mesh = polygonize(pipe, 48, tolerance=0.01)
    as_promised(pipe, mesh, 0.01)
    assert len(mesh.faces) < 200
    assert (mesh.vertices[:, 2].min(), mesh.vertices[:, 2].max()) == (-1.0, 1.5)


def test_the_mesh_is_as_fine_as_a_tolerance_asks_for() -> None:
    """A sphere of radius 1 takes 8 pi / (3 sqrt(3) e) equilateral triangles with corners on it that are off by e."""
    scene = case("sphere").scene
    for tolerance in (0.02, 0.005):
        mesh = polygonize(scene, tolerance=tolerance)
        as_promised(scene, mesh, tolerance)
        assert len(mesh.faces) < 2.5 * 8 * np.pi / (3 * np.sqrt(3) * tolerance)


def test_a_mirrored_body_stays_its_own_image() -> None:
    mesh = polygonize(case("mirrored").scene, 32, tolerance=0.03)
    corners = {tuple(sorted(map(tuple, face))) for face in mesh.vertices[mesh.faces].tolist()}
    for axis in (0, 1):
        image = mesh.vertices * np.where(np.arange(3) == axis, -1.0, 1.0) + 0.0
        assert {tuple(sorted(map(tuple, face))) for face in image[mesh.faces].tolist()} == corners


@pytest.mark.parametrize("tolerance", [0.0, -1.0, float("nan"), float("inf")])
def test_tolerances_that_are_none(tolerance: float) -> None:
    with pytest.raises(MeshError, match="tolerance: expected a number above 0, got"):
        polygonize(case("sphere").scene, 16, tolerance=tolerance)
