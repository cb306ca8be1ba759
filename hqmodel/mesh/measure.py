"""What a mesh is worth: how far it lies from the true surface, whether it is closed, what it holds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_ratio, near_linear_single

from .mesh import Array, Faces, Mesh, Triangles, crosses, dots, lengths, unit
from .refine import to_surface

# Faces that are measured between two looks at whether it is still wanted.
_AT_ONCE = 1 << 18


# The share of a cell that distances of faces count in whole multiples of: sums of them don't depend on the order.
QUANTUM = 2.0**-20
# Newton steps whose last is longer than this share of a stride have not arrived.
_LOST = 1e-2


def depths(terms: Terms, vertices: Array, faces: Faces, slopes: Array, cell: float) -> NDArray[np.float32]:
    """How far each face's middle lies below the surface, (F,), in whole quanta of a cell, to first order; negative above it.

    `slopes` (V,) is how fast the near-linear field changes at each vertex.
    """
    a, b, c = faces.T.astype(np.intp, copy=False)
    middles = np.stack([(x.take(a) + x.take(b) + x.take(c)) / 3 for x in vertices.T]).T
    slope = (slopes.take(a) + slopes.take(b) + slopes.take(c)) / 3
    slope *= QUANTUM * cell
    return np.rint(near_linear_single(terms, log_ratio(terms, middles)) / np.maximum(slope, 1e-30)).astype(np.float32)


def furthest(off: NDArray[np.float32]) -> NDArray[np.intp]:
    """The numbers of those faces that are furthest off the surface: some thousandth of them, and none that is on it."""
    count = min(int(np.count_nonzero(off)), 200 + len(off) // 1000)
    return np.argpartition(np.abs(off), -count)[len(off) - count :] if count else np.empty(0, dtype=np.intp)


def largest_distance(terms: Terms, vertices: Array, faces: Triangles, stride: float) -> float:
    """The largest distance of a face's middle from the true surface: along the gradient by Newton steps of at most `stride`, or,
    where these lead nowhere, as at a rim between steep sides, along the faces' normals."""
    if not len(faces):
        return 0.0
    corners = vertices[faces]
    middles = corners.mean(axis=1)
    arrived, last = to_surface(terms, middles, stride, rounds=6)
    away = lengths(arrived - middles)
    lost = np.flatnonzero(last > _LOST * stride)
    across = unit(crosses(corners[lost, 1] - corners[lost, 0], corners[lost, 2] - corners[lost, 0]))
    away[lost] = np.minimum(away[lost], along(terms, middles[lost], across, stride))
    return float(np.max(away))


def along(terms: Terms, points: Array, normals: Array, stride: float) -> Array:
    """How far the surface is from points (n, 3) along their normals (n, 3), one way or the other; inf if beyond four strides."""
    inside = log_ratio(terms, points) > 0

    def other(way: float, away: Array) -> NDArray[np.bool_]:
        return (log_ratio(terms, points + (way * away)[:, None] * normals) > 0) != inside

    result = np.full(len(points), np.inf)
    for way in (1.0, -1.0):
        low, high = np.zeros(len(points)), np.full(len(points), np.inf)
        for step in stride * 2.0 ** np.arange(-8, 3):
            there = other(way, np.full(len(points), step))
            high = np.where(np.isinf(high) & there, step, high)
            low = np.where(np.isinf(high), step, low)
        for _ in range(10):
            middle = np.where(np.isinf(high), 0.0, (low + high) / 2)
            there = other(way, middle)
            low, high = np.where(there, low, middle), np.where(there, middle, high)
        result = np.minimum(result, high)
    return result


def report(mesh: Mesh, still: Callable[[], None] = lambda: None) -> dict[str, Any]:
    """Counts and measures of a mesh, in its own unit: what ``hqmodel export --json`` prints of it.

    `still` is called again and again; whatever it raises ends the work.
    """
    volume, area = _volume_and_area(mesh, still)
    watertight, edges = _closed(mesh, still)
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


def _volume_and_area(mesh: Mesh, still: Callable[[], None]) -> tuple[float, float]:
    origin = mesh.vertices.mean(axis=0)
    volume = area = 0.0
    for start in range(0, len(mesh.faces), _AT_ONCE):
        still()
        corners = mesh.vertices[mesh.faces[start : start + _AT_ONCE]] - origin
        a, b, c = (corners[:, i] for i in range(3))
        with np.errstate(over="ignore", invalid="ignore"):
            across = crosses(b - a, c - a)
            volume += float(dots(a, across).sum() / 6)
            area += float(lengths(across).sum() / 2)
    return volume, area


def _closed(mesh: Mesh, still: Callable[[], None]) -> tuple[bool, int]:
    """Whether every edge has exactly one neighbour in each direction, and how many edges there are.

    Edges are looked at by the lower number of their vertices, some of these at a time.
    """
    count = len(mesh.vertices)
    start, end = mesh.faces.ravel(), mesh.faces[:, [1, 2, 0]].ravel()
    lower = np.minimum(start, end)
    step = max(1, count * _AT_ONCE // max(1, len(mesh.faces)))
    closed, edges = len(mesh.faces) > 0, 0
    for first in range(0, count, step):
        still()
        here = np.flatnonzero((lower >= first) & (lower < first + step))
        one, other = start[here].astype(np.int64), end[here].astype(np.int64)
        up, down = one < other, one > other
        forward, backward = np.sort(one[up] * count + other[up]), np.sort(other[down] * count + one[down])
        if len(forward) + len(backward) == len(here) and np.array_equal(forward, backward) and np.all(np.diff(forward) > 0):
            edges += len(forward)
        else:
            closed, edges = False, edges + len(np.unique(np.minimum(one, other) * count + np.maximum(one, other)))
    return closed, edges
