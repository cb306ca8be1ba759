"""Edges split, and the faces beside them with them, so that the mesh stays closed and its faces fair."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, near_linear_gradient

from .mesh import Array, areas, crosses, dots, lengths, slices, unit
from .refine import crossed, to_surface

Indices = NDArray[np.intp]
Plane = tuple[int, float]

# No triangle is made that is flatter than this (height to length), or leans further from the way it is to look (the cosine).
_FLAT = 2e-3
_LEAN = 0.1
# A point is on the surface when the last step towards it was shorter than this share of a cell.
ARRIVED = 1e-5
# Steps towards it, of this share of a cell at most.
_ROUNDS, _STRIDE = 16, 0.1


class Part:
    """Faces (F, 3) of a mesh with vertices `points` (V, 3) numbered from 0, and the field's outward unit `normals` (V, 3) there.

    `origin` (F,) is the face that each was part of at first. Edges in one of the `planes` (axis, coordinate) are to stay there.
    `still` is called again and again; whatever it raises ends the work.
    """

    def __init__(self, terms: Terms, points: Array, faces: Indices, planes: list[Plane], still: Callable[[], None]) -> None:
        self._terms, self._planes, self._still = terms, planes, still
        self.points, self.faces = points, faces
        self.normals = self.looking(points)
        self.origin = np.arange(len(faces))

    def looking(self, points: Array) -> Array:
        """The field's outward unit normals (n, 3) at points."""
        normals = np.empty_like(points)
        for here in slices(len(points)):
            self._still()
            normals[here] = unit(-near_linear_gradient(self._terms, points[here])[1])
        return normals

    def settled(self, points: Array, stride: float, rounds: int, held: NDArray[np.bool_]) -> tuple[Array, Array]:
        """`to_surface`, for points (n, 3) of which coordinates are held."""
        moved, last = np.empty_like(points), np.empty(len(points))
        for here in slices(len(points)):
            self._still()
            moved[here], last[here] = to_surface(self._terms, points[here], stride, rounds, held[here])
        return moved, last

    def reached(self, start: Array, end: Array, cell: float, held: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_]]:
        """The surface near `end`, (n, 3) each, and whether it was reached, (n,): by Newton's steps, or where these get lost, as
        between sides of unlike steepness, on the way there from `start`."""
        points, last = self.settled(end, _STRIDE * cell, _ROUNDS, held)
        arrived = last < ARRIVED * cell
        lost = np.flatnonzero(~arrived)
        points[lost], arrived[lost] = crossed(self._terms, start[lost], end[lost], self._still)
        return points, arrived

    def edges(self, first: int = 0) -> tuple[Indices, Indices]:
        """All edges (n, 2) of the faces from the first on, the lower vertex first, and how many of these meet in each, (n,)."""
        count = len(self.points)
        sides, meeting = np.unique(_sides(self.faces[first:], count), return_counts=True)
        return np.stack(np.divmod(sides, count), axis=1), meeting

    def held(self, edges: Indices) -> NDArray[np.bool_]:
        """Which coordinates the edges (n, 2) have in common with a plane that they lie in, (n, 3)."""
        held = np.zeros((len(edges), 3), dtype=bool)
        for axis, plane in self._planes:
            held[:, axis] |= np.all(self.points[edges, axis] == plane, axis=1)
        return held

    def split(self, edges: Indices, middles: Array) -> int:
        """Split edges (n, 2), given as `edges` gives them, at middles (n, 3), but for those that faces would suffer by.

        Of the edges of such a face first that is left whole whose split would add least. Returns the number of the first new
        face; these come last.
        """
        a, b = self.points[edges.T]
        gains = areas(a, middles, b)
        while len(edges):
            self._still()
            points = np.concatenate([self.points, middles])
            faces, parent, uses = _pieces(self.faces, edges, points)
            fresh = np.concatenate([self.normals, self.normals[edges[:, 0]] + self.normals[edges[:, 1]]])
            bad = _misshapen(points, self._faced(points, fresh, faces, parent), faces)
            if not bad.any():
                whole = np.delete(np.arange(len(self.faces)), np.unique(parent))
                self.faces = np.concatenate([self.faces[whole], faces])
                self.origin = self.origin[np.concatenate([whole, parent])]
                self.points, self.normals = points, np.concatenate([self.normals, self.looking(middles)])
                return len(whole)
            uses = uses[np.unique(parent[bad])]
            gain = np.where(uses < 0, np.inf, gains[uses])
            kept = np.ones(len(edges), dtype=bool)
            kept[uses[gain == np.min(gain, axis=1, keepdims=True)]] = False
            edges, middles, gains = edges[kept], middles[kept], gains[kept]
        return len(self.faces)

    def _faced(self, points: Array, normals: Array, faces: Indices, parent: Indices) -> Array:
        """The ways that faces (n, 3) are to look, (n, 3): as their corners do, but in a plane as their parents (n,) did."""
        towards = unit(normals[faces[:, 0]] + normals[faces[:, 1]] + normals[faces[:, 2]])
        for axis, plane in self._planes:
            flat = np.flatnonzero(np.all(points[faces, axis] == plane, axis=1))
            a, b, c = (self.points[self.faces[parent[flat], i]] for i in range(3))
            towards[flat] = unit(crosses(b - a, c - a))
        return towards


def _sides(faces: Indices, count: int) -> Indices:
    """One number for the edge of each side of faces among so many vertices, (F, 3)."""
    following = np.roll(faces, -1, axis=1)
    return np.minimum(faces, following) * count + np.maximum(faces, following)


def _misshapen(points: Array, towards: Array, faces: Indices) -> NDArray[np.bool_]:
    """Whether each face is almost without area or looks another way than it should."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    across = crosses(b - a, c - a)
    size = lengths(across)
    longest = np.maximum.reduce([lengths(b - a), lengths(c - b), lengths(a - c)])
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
