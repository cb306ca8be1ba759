"""What a mesh is worth: how far it lies from the true surface, whether it is closed, what it holds."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_ratio, near_linear_single

from .compiled import compiled
from .mesh import Array, Mesh, Triangles, lengths
from .refine import to_surface


def depths(terms: Terms, vertices: Array, faces: Triangles, slopes: Array) -> NDArray[np.float32]:
    """How far each face's middle lies below the surface, (F,), to first order; negative above it.

    `slopes` (V,) is how fast the near-linear field changes at each vertex.
    """
    middles, slope = np.empty((3, len(faces))), np.empty(len(faces))
    _average(np.ascontiguousarray(vertices), slopes, faces, middles, slope)
    return (near_linear_single(terms, log_ratio(terms, middles.T)) / np.maximum(slope, 1e-30)).astype(np.float32)


@compiled
def _average(vertices: Array, slopes: Array, faces: Triangles, middles: Array, slope: Array) -> None:
    """The faces' middles, (3, F), and their corners' slopes on average."""
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        for i in range(3):
            middles[i, f] = (vertices[a, i] + vertices[b, i] + vertices[c, i]) / 3
        slope[f] = (slopes[a] + slopes[b] + slopes[c]) / 3


def largest_distance(terms: Terms, vertices: Array, faces: Triangles, off: NDArray[np.float32], stride: float) -> float:
    """The largest distance of a face's middle from the surface, measured along the gradient by Newton steps.

    Those faces are followed to the surface that look worst by `off`, (F,): some thousandth of them.
    """
    if not len(faces):
        return 0.0
    count = min(len(faces), 200 + len(faces) // 1000)
    least = np.partition(np.abs(off), -count)[-count]
    worst = vertices[faces[np.flatnonzero(np.abs(off) >= least)[:count]]].mean(axis=1)
    return float(np.max(lengths(to_surface(terms, worst, stride, rounds=6)[0] - worst)))


def report(mesh: Mesh) -> dict[str, Any]:
    """Counts and measures of a mesh, in its own unit: what ``hqmodel export --json`` prints of it."""
    faces = np.ascontiguousarray(mesh.faces, dtype=np.int32)
    volume, area = _content(np.ascontiguousarray(mesh.vertices, dtype=float), faces)
    watertight, edges = _closed(faces, len(mesh.vertices))
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


@compiled
def _content(vertices: Array, faces: Triangles) -> tuple[float, float]:
    """Volume and area: (b - a) x (c - a) of every face has twice its area, and with a six times its share of the volume."""
    x, y, z = vertices[:, 0] - vertices[0, 0], vertices[:, 1] - vertices[0, 1], vertices[:, 2] - vertices[0, 2]
    volume = area = 0.0
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        ux, uy, uz = x[b] - x[a], y[b] - y[a], z[b] - z[a]
        vx, vy, vz = x[c] - x[a], y[c] - y[a], z[c] - z[a]
        nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        volume += (x[a] * nx + y[a] * ny + z[a] * nz) / 6
        area += np.sqrt(nx * nx + ny * ny + nz * nz) / 2
    return volume, area


@compiled
def _closed(faces: Triangles, count: int) -> tuple[bool, int]:
    """Whether every edge has exactly one neighbour in each direction, and how many edges there are."""
    start = np.zeros(count + 1, dtype=np.int64)
    for corner in faces.ravel():
        start[corner + 1] += 1
    start = np.cumsum(start)
    ends, filled = np.empty(faces.size, dtype=np.int32), start[:-1].copy()
    for f in range(len(faces)):
        for i in range(3):
            corner = faces[f, i]
            ends[filled[corner]] = faces[f, i - 2]
            filled[corner] += 1
    simple, edges = len(faces) > 0, 0
    for a in range(count):
        for e in range(start[a], start[a + 1]):
            b, before, back = ends[e], 0, 0
            for other in range(start[a], e):
                before += ends[other] == b
            for other in range(start[b], start[b + 1]):
                back += ends[other] == a
            simple &= back == 1 and before == 0
            edges += before == 0 and (a <= b or back == 0)
    return simple, edges
