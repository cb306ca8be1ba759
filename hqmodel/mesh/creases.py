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

from hqmodel.field import Terms, near_linear_gradient

from .mesh import Array, Triangles, alike, crosses, dots, lengths, marks, unit
from .refine import to_surface

Indices = NDArray[np.intp]
Plane = tuple[int, float]

# Ends whose normals' cosine is less than this look different ways.
_SHARP = 0.95
_ROUNDS = 3
# By how much less sharp than that a face with such an edge may look, when its normals are in single precision.
_SLACK = 1e-3
# An edge is split where the surface is further from it than this share of a cell, and not next to its ends.
_OFF = 0.02
_ASIDE = 0.05
# A point is on the surface when the last step towards it was shorter than this share of a cell.
_ARRIVED = 1e-5
# No triangle is made that is flatter than this (height to length), or leans further from its corners' normals (the cosine).
_FLAT = 2e-3
_LEAN = 0.1


class Creased(NamedTuple):
    """New vertices `points` (n, 3), numbered after the old ones, with the field's outward unit `normals` (n, 3) there; all
    `faces` (F, 3), and for each the old face that it is part of, `origin` (F,)."""

    points: Array
    normals: Array
    faces: Triangles
    origin: Indices


def creased(
    terms: Terms,
    vertices: Array,
    normals: NDArray[np.float32],
    faces: Triangles,
    off: NDArray[np.float32],
    cell: float,
    planes: list[Plane],
    pinched: NDArray[np.bool_],
    still: Callable[[], None],
) -> Creased | None:
    """The mesh with edges split at its creases; None where there are none.

    `normals` (V, 3) are the vertices', `off` (F,) is how far faces' middles are from the surface: those well on it are left
    alone, and edges between `pinched` vertices (V,), as more than two faces may meet there. Edges in one of the `planes` (axis,
    coordinate) are split in it. `still` is called now and then; whatever it raises ends the work.
    """
    marked = np.zeros(len(vertices), dtype=bool)
    rough = faces[np.abs(off) > _OFF / 4 * cell]
    marked[rough[~alike(normals, rough, _SHARP + _SLACK)]] = True
    near = marks(marked, faces) >= 2
    corners, which = np.unique(faces[near], return_inverse=True)
    part = _Part(terms, vertices[corners], which.reshape(-1, 3), cell, planes)
    part.split(lambda edges: np.all(marked[corners[edges]], axis=1) & ~np.all(pinched[corners[edges]], axis=1))
    for _ in range(_ROUNDS - 1):
        still()
        part.split(lambda edges: edges[:, 1] >= len(corners))
    if len(part.points) == len(corners):
        return None
    number = np.append(corners, np.arange(len(part.points) - len(corners)) + len(vertices)).astype(np.int32)
    return Creased(
        part.points[len(corners) :],
        part.normals[len(corners) :],
        np.concatenate([faces[~near], number[part.faces]]),
        np.concatenate([np.flatnonzero(~near), np.flatnonzero(near)[part.origin]]),
    )


class _Part:
    """The faces about the creases, with vertices numbered from 0, splitting up."""

    def __init__(self, terms: Terms, points: Array, faces: Indices, cell: float, planes: list[Plane]) -> None:
        self._terms, self._cell, self._planes = terms, cell, planes
        self.points, self.faces = points, faces
        self.normals = self._looking(points)
        self.origin = np.arange(len(faces))

    def _looking(self, points: Array) -> Array:
        return unit(-near_linear_gradient(self._terms, points)[1])

    def split(self, chosen: Callable[[Indices], NDArray[np.bool_]]) -> None:
        """Split the chosen ones of the edges (n, 2), lower vertex first, that have a crease between their ends."""
        count = len(self.points)
        edges = np.stack(np.divmod(np.unique(_sides(self.faces, count)), count), axis=1)
        edges, middles = self._creases(edges[chosen(edges)])
        while len(edges):
            points = np.concatenate([self.points, middles])
            faces, parent, uses = _pieces(self.faces, edges, points)
            fresh = np.concatenate([self.normals, self.normals[edges[:, 0]] + self.normals[edges[:, 1]]])
            bad = _misshapen(points, fresh, faces)
            unwanted = np.zeros(len(edges), dtype=bool)
            unwanted[np.setdiff1d(uses[np.unique(parent[bad])], -1)] = True
            if not unwanted.any():
                whole = np.delete(np.arange(len(self.faces)), np.unique(parent))
                self.faces = np.concatenate([self.faces[whole], faces])
                self.origin = self.origin[np.concatenate([whole, parent])]
                self.points, self.normals = points, np.concatenate([self.normals, self._looking(middles)])
                return
            edges, middles = edges[~unwanted], middles[~unwanted]

    def _creases(self, edges: Indices) -> tuple[Indices, Array]:
        """Those of the edges that are to be split, and where."""
        first, second = _in_order(self.points, edges)
        a, b = self.points[first], self.points[second]
        held = np.zeros(a.shape, dtype=bool)
        for axis, plane in self._planes:
            held[:, axis] |= (a[:, axis] == plane) & (b[:, axis] == plane)
        m, n = (unit(np.where(held, 0.0, self.normals[end])) for end in (first, second))
        rows = np.flatnonzero(dots(m, n) < _SHARP)
        a, b, held = a[rows], b[rows], held[rows]
        points, last = to_surface(self._terms, _meeting(a, b, m[rows], n[rows], self._cell), 0.1 * self._cell, 8, held)
        along = b - a
        share = dots(points - a, along) / np.maximum(dots(along, along), 1e-300)
        away = lengths(points - a - share[:, None] * along)
        good = (
            (last < _ARRIVED * self._cell)
            & (away > _OFF * self._cell)
            & (away < lengths(along))
            & (share > _ASIDE)
            & (share < 1 - _ASIDE)
        )
        return edges[rows[good]], points[good]


def _sides(faces: Indices, count: int) -> Indices:
    """One number for the edge of each side of faces among so many vertices, (F, 3)."""
    following = np.roll(faces, -1, axis=1)
    return np.minimum(faces, following) * count + np.maximum(faces, following)


def _in_order(points: Array, edges: Indices) -> tuple[Indices, Indices]:
    """The ends (n,) of edges (n, 2) in the order of their coordinates, so that nothing depends on how vertices are numbered."""
    x, y, z = (points[edges[:, 1]] - points[edges[:, 0]]).T
    back = np.where(x != 0, x, np.where(y != 0, y, z)) < 0
    return np.where(back, edges[:, 1], edges[:, 0]), np.where(back, edges[:, 0], edges[:, 1])


def _meeting(a: Array, b: Array, m: Array, n: Array, cell: float) -> Array:
    """Where the planes through a and b with normals m and n meet, (k, 3), nearest to the middle between a and b."""
    middle, cosine = (a + b) / 2, dots(m, n)
    p, q = dots(m, a - middle), dots(n, b - middle)
    scale = np.maximum(1 - cosine * cosine, 1e-3)
    step = ((p - cosine * q) / scale)[:, None] * m + ((q - cosine * p) / scale)[:, None] * n
    return middle + step * np.minimum(1, cell / np.maximum(lengths(step), 1e-300))[:, None]


def _misshapen(points: Array, normals: Array, faces: Indices) -> NDArray[np.bool_]:
    """Whether each face is almost without area or looks another way than its corners do."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    across = crosses(b - a, c - a)
    size = lengths(across)
    longest = np.maximum.reduce([lengths(b - a), lengths(c - b), lengths(a - c)])
    towards = unit(normals[faces[:, 0]] + normals[faces[:, 1]] + normals[faces[:, 2]])
    return (size < _FLAT * longest**2) | (dots(across, towards) < _LEAN * size)


def _pieces(faces: Indices, edges: Indices, points: Array) -> tuple[Indices, Indices, Indices]:
    """The parts (n, 3) of those faces that have some of the edges (m, 2), when the last m of the points split these; the row of
    `faces` that each is part of, (n,), and for each of `faces` the edges of its sides, or -1, (F, 3)."""
    count = len(points)
    key = edges[:, 0] * count + edges[:, 1]
    wanted = _sides(faces, count)
    at = np.minimum(np.searchsorted(key, wanted), len(key) - 1)
    uses = np.where(key[at] == wanted, at, -1)
    number = np.count_nonzero(uses >= 0, axis=1)
    new, parent = [], []
    for many, parts in ((1, _in_two), (2, _in_three), (3, _in_four)):
        rows = np.flatnonzero(number == many)
        # turned so that the edge that differs from the other two comes first
        turn = np.argmax((uses[rows] >= 0) == (many == 1), axis=1)
        index = (turn[:, None] + np.arange(3)) % 3
        corners, sides = (np.take_along_axis(values[rows], index, 1).T for values in (faces, uses))
        new.append(parts(corners, sides + count - len(edges), points).reshape(-1, 3))
        parent.append(np.repeat(rows, many + 1))
    return np.concatenate(new), np.concatenate(parent), uses


def _in_two(corners: Indices, middles: Indices, vertices: Array) -> Indices:
    """Triangles (n, 2, 3) from corners a, b, c and the middles of a b, b c and c a, (3, n) each; a b is split."""
    (a, b, c), (ab, _, _) = corners, middles
    return np.stack([a, ab, c, ab, b, c], axis=1).reshape(-1, 2, 3)


def _in_three(corners: Indices, middles: Indices, vertices: Array) -> Indices:
    """The same, (n, 3, 3), where only a b is whole; the quadrilateral beside it is cut along its shorter diagonal."""
    (a, b, c), (_, bc, ca) = corners, middles
    shorter = lengths(vertices[a] - vertices[bc]) < 0.999 * lengths(vertices[b] - vertices[ca])
    one, other = np.stack([c, ca, bc, a, b, bc, a, bc, ca]), np.stack([c, ca, bc, a, b, ca, b, bc, ca])
    return np.where(shorter, one, other).T.reshape(-1, 3, 3)


def _in_four(corners: Indices, middles: Indices, vertices: Array) -> Indices:
    """The same, (n, 4, 3), where all edges are split."""
    (a, b, c), (ab, bc, ca) = corners, middles
    return np.stack([a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca], axis=1).reshape(-1, 4, 3)
