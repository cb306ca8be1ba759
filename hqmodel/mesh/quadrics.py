"""Quadrics: how far points lie from sets of planes, squared and weighted by the area that each plane stands for.

After Garland and Heckbert 1997, "Surface simplification using quadric error metrics". A quadric is a row of ten numbers: A by
the upper half of its rows, then b, then c of x.Ax + 2 b.x + c. The trace of A is the area of all its planes.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .mesh import Array, Triangles, crosses, dots, lengths

_PRODUCTS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2), (0, 3), (1, 3), (2, 3), (3, 3))
_AT_ONCE = 1 << 14


def quadrics(vertices: Array, faces: Triangles, still: Callable[[], None]) -> Array:
    """Of each vertex, (V, 10): the planes of its faces, each for a third of the face's area. `still` is called now and then."""
    total = np.zeros((len(vertices), 10))
    for some in np.array_split(faces, len(faces) // _AT_ONCE + 1):
        still()
        a, b, c = (vertices.take(corner, axis=0) for corner in some.T)
        normals = crosses(b - a, c - a)
        size = np.maximum(lengths(normals), 1e-300)
        plane = np.stack([*normals.T, -dots(normals, a)]) / size
        for column, (i, j) in enumerate(_PRODUCTS):
            weight = plane[i] * plane[j] * size / 6
            for corner in some.T:
                np.add.at(total[:, column], corner, weight)
    return total


def area(quadric: Array) -> Array:
    """What quadrics (n, 10) stand for; never quite nothing."""
    return np.maximum(quadric[:, 0] + quadric[:, 3] + quadric[:, 5], 1e-300)


def error(quadric: Array, points: Array) -> Array:
    """Quadrics (n, 10) at points (n, 3)."""
    q, (x, y, z) = np.ascontiguousarray(quadric.T), np.ascontiguousarray(points.T)
    gx, gy, gz = _slope(q, x, y, z)
    return x * (gx + q[6]) + y * (gy + q[7]) + z * (gz + q[8]) + q[9]


def least(quadric: Array, points: Array, free: NDArray[np.bool_], pull: Array, reach: Array) -> tuple[Array, Array]:
    """Steps (n, 3) from points to where quadrics (n, 10) are least, and what they are there.

    Only coordinates that are `free`, (n, 3), change. Where the planes fix a point less firmly than `pull` (n,) it is left
    where it is, and where the step's square would be more than `reach` (n,) there is none.
    """
    q, (x, y, z), (i, j, k) = np.ascontiguousarray(quadric.T), np.ascontiguousarray(points.T), np.ascontiguousarray(free.T)
    # A + pull = L D L^T, what couples a coordinate that isn't free left out of A.
    xy, xz, yz = q[1] * (i & j), q[2] * (i & k), q[4] * (j & k)
    d0 = q[0] + pull
    l10, l20 = xy / d0, xz / d0
    d1 = q[3] + pull - l10 * xy
    l21 = (yz - l20 * xy) / d1
    d2 = q[5] + pull - l20 * xz - l21 * (yz - l20 * xy)
    sx, sy, sz = np.zeros_like(x), np.zeros_like(y), np.zeros_like(z)
    for _ in range(2):  # again from where the first led, so that what is firm isn't pulled back
        gx, gy, gz = _slope(q, x + sx, y + sy, z + sz)
        r0, r1 = gx * i, gy * j - l10 * gx * i
        r2 = gz * k - l20 * r0 - l21 * r1
        tz = r2 / d2
        ty = r1 / d1 - l21 * tz
        sx, sy, sz = sx - r0 / d0 + l10 * ty + l20 * tz, sy - ty, sz - tz
    step = np.stack([sx, sy, sz], axis=1)
    step[dots(step, step) > reach] = 0.0
    return step, error(quadric, points + step)


def _slope(q: Array, x: Array, y: Array, z: Array) -> tuple[Array, Array, Array]:
    """Half the gradient of quadrics (10, n)."""
    return (
        q[0] * x + q[1] * y + q[2] * z + q[6],
        q[1] * x + q[3] * y + q[4] * z + q[7],
        q[2] * x + q[4] * y + q[5] * z + q[8],
    )
