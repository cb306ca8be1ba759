"""What a mesh is worth: how far it lies from the true surface, whether it is closed, what it holds."""

from __future__ import annotations

from typing import Any

import numpy as np

from hqmodel.field import Terms, log_ratio, near_linear

from .mesh import Array, Mesh, Triangles
from .refine import to_surface


def largest_distance(terms: Terms, vertices: Array, faces: Triangles, slopes: Array, stride: float) -> float:
    """The largest distance of a face's middle from the surface, measured along the gradient by Newton steps.

    `slopes` (V,) is how fast the near-linear field changes at each vertex. With it all faces are judged to first order; those
    that look worst, some hundredth of them, are followed to the surface.
    """
    if not len(faces):
        return 0.0
    middles = vertices[faces].mean(axis=1)
    estimate = np.abs(near_linear(terms, log_ratio(terms, middles))) / np.maximum(slopes[faces].min(axis=1), 1e-300)
    count = min(len(middles), 100 + len(middles) // 100)
    worst = middles[np.argpartition(estimate, -count)[-count:]]
    return float(np.max(np.linalg.norm(to_surface(terms, worst, stride, rounds=5)[0] - worst, axis=1)))


def report(mesh: Mesh) -> dict[str, Any]:
    """Counts and measures of a mesh, in its own unit: what ``hqmodel export --json`` prints of it."""
    corners = mesh.vertices[mesh.faces]
    origin = mesh.vertices.mean(axis=0)
    a, b, c = (corners[:, i] - origin for i in range(3))
    with np.errstate(over="ignore", invalid="ignore"):
        across = np.cross(b - a, c - a)
        volume = float(np.einsum("ij,ij->", a, across) / 6)
        area = float(np.linalg.norm(across, axis=1).sum() / 2)
    watertight, edges = _closed(mesh)
    return {
        "vertices": len(mesh.vertices),
        "faces": len(mesh.faces),
        "watertight": watertight,
        "volume": volume,
        "area": area,
        "bounds": [mesh.vertices.min(axis=0).tolist(), mesh.vertices.max(axis=0).tolist()],
        "euler_number": len(mesh.vertices) - edges + len(mesh.faces),
        "surface_error": mesh.surface_error,
    }


def _closed(mesh: Mesh) -> tuple[bool, int]:
    """Whether every edge has exactly one neighbour in each direction, and how many edges there are."""
    count = len(mesh.vertices)
    start = mesh.faces.ravel().astype(np.int64)
    end = np.roll(mesh.faces, -1, axis=1).ravel().astype(np.int64)
    forward = np.sort(start * count + end)
    backward = np.sort(end * count + start)
    simple = bool(np.all(np.diff(forward) > 0)) if len(forward) else False
    edges = np.unique(np.minimum(start, end) * count + np.maximum(start, end))
    return simple and bool(np.array_equal(forward, backward)), len(edges)
