"""Meshes within a tolerance: what is promised is measured by other means, and costs few triangles."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.random import default_rng
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from hqmodel.field import Terms, log_ratio, region
from hqmodel.mesh import Mesh, polygonize, report
from hqmodel.model import Scene

from ..cases import NAMES, case

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
    tolerance = 8e-3 * length(polygonize(scene, 32, shading=False))
    finer = {"astroid": 128, "composite_0": 176, "composite_1": 128}
    as_promised(scene, polygonize(scene, finer.get(name, 64), tolerance=tolerance), tolerance)
