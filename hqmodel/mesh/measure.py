"""What a mesh is worth: how far it lies from the true surface, whether it is closed, what it holds."""

from __future__ import annotations

from typing import Any

import numpy as np

from hqmodel.field import Terms, log_gradient

from .mesh import Array, Mesh


def distances(terms: Terms, points: Array, reach: float) -> Array:
    """Distance (n,) of points (n, 3) near the surface from it, measured along the gradient by Newton steps.

    Exact to second order in the distance; no more than `reach` is looked for.
    """
    moved = points.copy()
    for _ in range(4):
        ratio, slope = log_gradient(terms, moved)
        square = np.maximum(np.sum(slope * slope, axis=1), 1e-300)
        step = (ratio / square)[:, None] * slope
        length = np.linalg.norm(step, axis=1, keepdims=True)
        moved = moved - step * np.minimum(1.0, reach / np.maximum(length, 1e-300))
    return np.linalg.norm(moved - points, axis=1)


def report(mesh: Mesh) -> dict[str, Any]:
    """Counts and measures of a mesh, in its own unit: what ``hqmodel export --json`` prints of it."""
    corners = mesh.vertices[mesh.faces]
    origin = mesh.vertices.mean(axis=0)
    a, b, c = (corners[:, i] - origin for i in range(3))
    across = np.cross(b - a, c - a)
    watertight, edges = _closed(mesh)
    return {
        "vertices": len(mesh.vertices),
        "faces": len(mesh.faces),
        "watertight": watertight,
        "volume": float(np.einsum("ij,ij->", a, across) / 6),
        "area": float(np.linalg.norm(across, axis=1).sum() / 2),
        "bounds": [mesh.vertices.min(axis=0).tolist(), mesh.vertices.max(axis=0).tolist()],
        "euler_number": len(mesh.vertices) - edges + len(mesh.faces),
        "surface_error": mesh.surface_error,
    }


def _closed(mesh: Mesh) -> tuple[bool, int]:
    """Whether every edge has exactly one neighbour in each direction, and how many edges there are."""
    count = len(mesh.vertices)
    start = mesh.faces.ravel()
    end = np.roll(mesh.faces, -1, axis=1).ravel()
    forward = np.sort(start * count + end)
    backward = np.sort(end * count + start)
    simple = bool(np.all(np.diff(forward) > 0)) if len(forward) else False
    return simple and bool(np.array_equal(forward, backward)), len(np.unique(np.minimum(start, end) * count + np.maximum(start, end)))
