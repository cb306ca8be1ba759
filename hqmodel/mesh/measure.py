"""What a mesh is worth: how far it lies from the true surface, whether it is closed, what it holds."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_ratio, near_linear_single

from .mesh import Array, Mesh, Triangles, crosses, lengths
from .refine import to_surface


def depths(terms: Terms, vertices: Array, faces: Triangles, slopes: Array) -> NDArray[np.float32]:
    """How far each face's middle lies below the surface, (F,), to first order; negative above it.

    `slopes` (V,) is how fast the near-linear field changes at each vertex.
    """
    corners = [faces[:, i] for i in range(3)]
    middles = np.stack([(x[corners[0]] + x[corners[1]] + x[corners[2]]) / 3 for x in vertices.T]).T
    slope = (slopes[corners[0]] + slopes[corners[1]] + slopes[corners[2]]) / 3
    return (near_linear_single(terms, log_ratio(terms, middles)) / np.maximum(slope, 1e-30)).astype(np.float32)


def largest_distance(terms: Terms, vertices: Array, faces: Triangles, off: NDArray[np.float32], stride: float) -> float:
    """The largest distance of a face's middle from the surface, measured along the gradient by Newton steps.

    Those faces are followed to the surface that look worst by `off`, (F,): some thousandth of them.
    """
    if not len(faces):
        return 0.0
    count = min(len(faces), 200 + len(faces) // 1000)
    worst = vertices[faces[np.argpartition(np.abs(off), -count)[-count:]]].mean(axis=1)
    return float(np.max(lengths(to_surface(terms, worst, stride, rounds=6)[0] - worst)))


def report(mesh: Mesh) -> dict[str, Any]:
    """Counts and measures of a mesh, in its own unit: what ``hqmodel export --json`` prints of it."""
    corners = mesh.vertices[mesh.faces]
    origin = mesh.vertices.mean(axis=0)
    a, b, c = (corners[:, i] - origin for i in range(3))
    with np.errstate(over="ignore", invalid="ignore"):
        across = crosses(b - a, c - a)
        volume = float(np.einsum("ij,ij->", a, across) / 6)
        area = float(lengths(across).sum() / 2)
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
    up, down = start < end, start > end
    forward, backward = np.sort(start[up] * count + end[up]), np.sort(end[down] * count + start[down])
    if len(forward) + len(backward) == len(start) and np.array_equal(forward, backward) and bool(np.all(np.diff(forward) > 0)):
        return len(forward) > 0, len(forward)
    return False, len(np.unique(np.minimum(start, end) * count + np.maximum(start, end)))
