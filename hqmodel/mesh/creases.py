"""Sharp edges and corners, which marching cubes cuts off, put back.

An edge of the mesh whose ends look different ways is split where their tangent planes meet, at the point of the surface there
(the points of Kobbelt et al. 2001, "Feature sensitive surface extraction", but one on every edge across a crease, so that the
triangles between them meet along it). Split again, edges close in on what little rounding a large exponent leaves.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms

from .measure import QUANTUM
from .mesh import Array, Faces, Triangles, alike, areas, dots, lengths, marks, unit
from .splits import Indices, Part, Plane

# Ends whose normals' cosine is less than this look different ways.
_SHARP = 0.97
_ROUNDS = 3
# By how much less sharp than that a face with such an edge may look, when its normals are in single precision.
_SLACK = 1e-3
# An edge is split where that adds a triangle of this share of a cell's square, not next to its ends, and not at a point that is
# further away than so many times its length.
_GAIN = 0.006
_ASIDE = 0.01
_FAR = 4.0
# No edge of a face is looked at whose middle is nearer to the surface than so many quanta.
_ROUGH = 0.0025 / QUANTUM


class Creased(NamedTuple):
    """New vertices `points` (n, 3), numbered after the old ones, with the field's outward unit `normals` (n, 3) there; all
    `faces` (F, 3), and for each the old face that it is part of, `origin` (F,)."""

    points: Array
    normals: Array
    faces: Triangles
    origin: Indices


def sharp_vertices(faces: Faces, off: NDArray[np.float32], normals: NDArray[np.float32]) -> NDArray[np.bool_]:
    """The vertices, (V,), of faces (F, 3) that a crease may pass through: well off the surface, by `off` (F,) quanta, and between
    vertices whose normals (V, 3) differ."""
    rough = faces.compress(np.abs(off) > _ROUGH, axis=0)
    result = np.zeros(len(normals), dtype=bool)
    result[rough[~alike(normals, rough, _SHARP + _SLACK)]] = True
    return result


def creased(
    terms: Terms,
    vertices: Array,
    normals: NDArray[np.float32],
    faces: Triangles,
    sharp: NDArray[np.bool_],
    cell: float,
    planes: list[Plane],
    pinched: NDArray[np.bool_],
    still: Callable[[], None],
) -> Creased | None:
    """The mesh with edges split at its creases; None where there are none.

    `normals` (V, 3) are the vertices'; only edges between `sharp` vertices (V,) are looked at, and none that more than two faces
    meet in, which are between `pinched` ones (V,). Edges in one of the `planes` (axis, coordinate) are split in it. `still` is
    called again and again; whatever it raises ends the work.
    """
    near = marks(sharp, faces) >= 2
    corners, which = np.unique(faces[near], return_inverse=True)
    part = Part(terms, vertices[corners], which.reshape(-1, 3), planes, still)
    edges, meeting = part.edges()
    sharp, crowded = sharp[corners], _crowded(part, edges, meeting, pinched[corners])
    for _ in range(_ROUNDS):
        old = np.flatnonzero(edges[:, 1] < len(corners))
        ends = edges[old].T
        barred = ~np.logical_and(*sharp[ends]) | np.logical_and(*crowded[ends])
        edges, _ = part.edges(part.split(*crossings(part, np.delete(edges, old[barred], axis=0), cell)))
    if len(part.points) == len(corners):
        return None
    number = np.append(corners, np.arange(len(part.points) - len(corners)) + len(vertices)).astype(np.int32)
    return Creased(
        part.points[len(corners) :],
        part.normals[len(corners) :],
        np.concatenate([faces[~near], number[part.faces]]),
        np.concatenate([np.flatnonzero(~near), np.flatnonzero(near)[part.origin]]),
    )


def _crowded(part: Part, edges: Indices, meeting: Indices, pinched: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The ends, (V,), of edges (n, 2) that more than two faces meet in: `meeting` (n,) on this side of the planes, and in one of
    them maybe as many beyond. Only those between `pinched` vertices (V,) are looked at."""
    suspect = np.flatnonzero(np.logical_and(*pinched[edges.T]))
    edges = edges[suspect]
    result = np.zeros(len(pinched), dtype=bool)
    result[edges[(meeting[suspect] > 2) | part.held(edges).any(axis=1)]] = True
    return result


def crossings(part: Part, edges: Indices, cell: float) -> tuple[Indices, Array]:
    """Those of the part's edges (n, 2) that have a crease between their ends, and where on it they are to be split."""
    first, second = _in_order(part.points, edges)
    a, b, held = part.points[first], part.points[second], part.held(edges)
    m, n = (unit(np.where(held, 0.0, part.normals[end])) for end in (first, second))
    rows = np.flatnonzero(dots(m, n) < _SHARP)
    a, b, held, m, n = a[rows], b[rows], held[rows], m[rows], n[rows]
    points, arrived = part.reached((a + b) / 2, _meeting(a, b, m, n), cell, held)
    along, way = b - a, unit(m + n)
    aside = along - dots(along, way)[:, None] * way
    share = dots(points - a, aside) / np.maximum(dots(aside, aside), 1e-300)
    near = lengths(points - a - share[:, None] * along) < _FAR * lengths(along)
    good = arrived & near & (share > _ASIDE) & (share < 1 - _ASIDE) & (areas(a, points, b) > _GAIN * cell**2)
    return edges[rows[good]], points[good]


def _in_order(points: Array, edges: Indices) -> tuple[Indices, Indices]:
    """The ends (n,) of edges (n, 2) in the order of their coordinates, so that nothing depends on how vertices are numbered."""
    x, y, z = (points[edges[:, 1]] - points[edges[:, 0]]).T
    back = np.where(x != 0, x, np.where(y != 0, y, z)) < 0
    return np.where(back, edges[:, 1], edges[:, 0]), np.where(back, edges[:, 0], edges[:, 1])


def _meeting(a: Array, b: Array, m: Array, n: Array) -> Array:
    """Where the planes through a and b with normals m and n meet, (k, 3), and that which a, b and m + n span.

    Seen along m + n such points lie on their edges, so that the parts of faces beside them do not fold.
    """
    along = b - a
    below, above = -dots(m, along), dots(n, along)  # how far b is below the plane through a, and a below that through b
    between = below * above > 0
    total = np.where(between, below + above, 1.0)
    height = np.where(between, below * above, 0.0) / total / np.maximum(1 + dots(m, n), 1e-12)
    step = height[:, None] * (m + n)
    most = _FAR * lengths(along) / np.maximum(lengths(step), 1e-300)
    return a + np.where(between, above / total, 0.5)[:, None] * along + step * np.minimum(1, most)[:, None]
