"""A mesh within a tolerance of the true surface: triangles many where it curves, few where it is flat.

Faces that are too far off are split; then edges collapse as long as the faces about them stay near; at last every face is
measured at points no further apart than the cells of the grid that it came from, and split where need be.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, curvature, near_linear_gradient

from .creases import crossings
from .decimate import simplified
from .mesh import Array, Mesh, Triangles, dots, lengths, marks
from .refine import to_surface
from .splits import Indices, Part, Plane

Bools = NDArray[np.bool_]
Near = Callable[[Array, Array, Array], Bools]
Stage = tuple[Array, Triangles, Array]

# Cells along the longest side that a body is first looked at with, and the fewest and the most that are chosen for a tolerance.
COARSE, FEWEST, MOST = 48, 64, 512
# Cells no larger than the tolerance see all that is, and so many, along the longest side, are taken to see enough.
_ENOUGH = 256
# The share of the surface that cells are to be fine enough for as it curves; the rest is split.
_SMOOTH = 0.75
# How many times finer to look again where a tolerance was not met, and how much finer than proportion would have it.
_AGAIN, _FINER = (1.4, 4.0), 1.1
# The shares of the tolerance that faces may be off before edges collapse, while they do, and at last.
_BEFORE, _MEANWHILE, _AT_LAST = 0.5, 0.85, 0.97
# How far off quadrics may think that faces come to lie, in tolerances: they judge on the safe side, ever more so.
_SURELY, _PERHAPS = 0.7, 3.0
_ROUNDS = 12
# How often it is tried to reduce a mesh, and how far about faces that came to lie too far off it is then left as it is, in cells
# or tolerances, whichever are larger.
_TRIES, _ROOM = 4, 2.0
# The most Newton steps that a point takes towards the surface; none follows one shorter than these shares of its way or a cell.
_STEPS, _FIRM, _EXACT = 6, 1e-3, 1e-9
# A point is on the surface when the last step towards it was shorter than this share of a cell.
_ARRIVED = 1e-5
# Faces whose middles are off by less than this share of the tolerance are not, elsewhere, off by what they may be.
_DOUBTFUL = 0.15
# The largest number of parts that a face's sides are divided in to be measured.
_FINEST = 100
_AT_ONCE = 1 << 15
# Where in a triangle it is looked whether it may be made: the weights of its corners, the first of which is new. More points lie
# towards the corners, as what is flat in the middle may bend there.
_SHARES = np.array([0.5, 0.8, 0.2, 0.95, 0.05])
_SPOTS = np.concatenate([np.stack([_SHARES, 1 - _SHARES, 0 * _SHARES], axis=1), np.full((1, 3), 1 / 3)])


def adapted(
    surface: Surface,
    vertices: Array,
    faces: Triangles,
    off: NDArray[np.float32],
    mirrored: tuple[int, ...],
    tolerance: float,
) -> tuple[Array, Triangles, float]:
    """Vertices and faces of a mesh within `tolerance`, and how far it is off at most as measured, in world units.

    `off` (F,) is how far the middles of the faces given are.
    """
    away = np.abs(off).astype(float)
    doubtful = away > _DOUBTFUL * tolerance
    away[doubtful] = surface.off(vertices, faces[doubtful])
    stage = _refined(surface, vertices, faces, away, _BEFORE * tolerance)
    # First as far as quadrics alone warrant it: that is quick, and little is left to measure.
    for most, near in ((_SURELY, None), (_PERHAPS, surface.near(_MEANWHILE * tolerance))):
        stage = _reduced(surface, stage, mirrored, most * tolerance, near, tolerance)
    vertices, faces, away = stage
    return vertices, faces, float(np.max(away, initial=0.0))


def fineness(terms: Terms, coarse: Mesh, tolerance: float) -> int:
    """How many cells along the longest side a tolerance asks for, judged by a coarse mesh.

    An edge of length l over the principal curvature k (eqs. 24-26) is off by k l^2 / 8; with cells of size sqrt(tolerance / k)
    their diagonals are off by a quarter of the tolerance.
    """
    gaussian, mean = curvature(terms, coarse.vertices)
    principal = np.abs(mean) + np.sqrt(np.maximum(mean * mean - gaussian, 0.0))
    side = float(np.max(np.ptp(coarse.vertices, axis=0)))
    curved = side * np.sqrt(float(np.quantile(principal, _SMOOTH)) / tolerance)
    return int(np.clip(np.ceil(max(min(_ENOUGH, side / tolerance), curved)), FEWEST, MOST))


def finer(cells: int, error: float, tolerance: float) -> int:
    """How many cells would about meet a tolerance that so many missed; creases that they cut off shrink in proportion."""
    return int(np.ceil(cells * np.clip(_FINER * error / tolerance, *_AGAIN)))


@dataclass(frozen=True, eq=False)
class Surface:
    """The true surface, where a grid of cells of size `cell` found it.

    Of the `planes` (axis, coordinate) the first `cuts` cut it off, and the others mirror it.
    `still` is called again and again; whatever it raises ends the work.
    """

    terms: Terms
    planes: list[Plane]
    cuts: int
    cell: float
    still: Callable[[], None]

    def flat(self, points: Array) -> Indices:
        """In which plane, numbered from 1, each coordinate of points lies, (n, 3); 0 for none."""
        number = np.zeros(points.shape, dtype=np.intp)
        for index, (axis, plane) in enumerate(self.planes):
            number[points[:, axis] == plane, axis] = index + 1
        return number

    def near(self, most: float) -> Near:
        """Tells which triangles, by their corners (n, 3) each, lie about within a distance."""

        roughly = not np.any(self.terms.inner < 1)  # where slopes are infinite, distances to first order are nothing

        def near(a: Array, b: Array, c: Array) -> Bools:
            return self._measured(np.stack([a, b, c]), _SPOTS, roughly) <= most

        return near

    def nearest(self, points: Array, held: Bools) -> Array:
        """The points (n, 3) moved onto the surface, held coordinates, (n, 3), kept: by as many steps as each takes."""
        moved, going = points.copy(), np.arange(len(points))
        for _ in range(_STEPS):
            moved[going], last = to_surface(self.terms, moved[going], self.cell, 1, held[going])
            going = going[last > np.maximum(_FIRM * lengths(moved[going] - points[going]), _EXACT * self.cell)]
        return moved

    def off(self, vertices: Array, faces: Triangles) -> Array:
        """How far each face is off the surface at most, (F,), as far as that can be seen by points a cell apart."""
        result = np.zeros(len(faces))
        corners = vertices[faces.T]
        for some, lattice in self._lattices(corners):
            result[some] = self._measured(corners[:, some], lattice)
        return result

    def beside(self, points: Array, vertices: Array, faces: Triangles, reach: float) -> Bools:
        """Which of the points (n, 3) are about as near to any of the faces as `reach`, which is no less than a cell."""
        from scipy.spatial import cKDTree  # late: it is slow to load

        corners = vertices[faces.T]
        spots = [np.tensordot(lattice, corners[:, some], axes=1).reshape(-1, 3) for some, lattice in self._lattices(corners)]
        distance, _ = cKDTree(np.concatenate(spots)).query(points, distance_upper_bound=reach)
        return np.isfinite(distance)

    def _lattices(self, corners: Array) -> Iterator[tuple[Indices, Array]]:
        """The numbers of some faces, by their corners (3, F, 3), and a lattice whose points lie a cell apart on them, for all."""
        longest = np.sqrt(np.max(np.sum((corners - np.roll(corners, 1, axis=0)) ** 2, axis=2), axis=0))
        parts = np.clip(np.ceil(longest / self.cell), 3, _FINEST).astype(int)
        for number in np.unique(parts):
            rows = np.flatnonzero(parts == number)
            lattice = _lattice(int(number))
            for some in np.array_split(rows, len(rows) * len(lattice) // _AT_ONCE + 1):
                self.still()
                yield some, lattice

    def _measured(self, corners: Array, lattice: Array, roughly: bool = False) -> Array:
        """How far triangles, by their corners (3, n, 3), are off at most at a lattice's points, (n,); within caps
        they aren't. `roughly`: to first order."""
        flat = np.stack([self.flat(points) for points in corners])
        capped = np.any(_common(flat) & (flat[0] <= self.cuts), axis=1)
        points = np.tensordot(lattice, corners, axes=1)
        sides, of_side = np.unique(lattice > 0, axis=0, return_inverse=True)
        held = np.stack([_common(flat[side]) for side in sides])[of_side]
        distance = self._distance(points[:, ~capped].reshape(-1, 3), held[:, ~capped].reshape(-1, 3), roughly)
        result = np.zeros(corners.shape[1])
        result[~capped] = np.max(distance.reshape(len(lattice), -1), axis=0)
        return result

    def _distance(self, points: Array, held: Bools, roughly: bool) -> Array:
        if not roughly:
            return lengths(self.nearest(points, held) - points)
        linear, slope = near_linear_gradient(self.terms, points)
        return np.abs(linear) / np.maximum(lengths(np.where(held, 0.0, slope)), 1e-200)


def _common(planes: Indices) -> Bools:
    """Which coordinates (n, 3) lie in one plane at all of some points, whose planes are given (k, n, 3)."""
    return np.all(planes == planes[0], axis=0) & (planes[0] > 0)


def _reduced(
    surface: Surface, stage: Stage, mirrored: tuple[int, ...], most: float, near: Near | None, tolerance: float
) -> Stage:
    """The mesh with fewer faces, and how far each is off; where they turn out too far off, it is done again without these."""

    vertices, faces, off = stage
    allowed = max(tolerance, float(np.max(off, initial=0.0)))
    held, reach = surface.flat(vertices) > 0, _ROOM * max(surface.cell, tolerance)
    for _ in range(_TRIES):
        fewer = simplified(vertices, faces, 0, held, mirrored, surface.nearest, most, near, surface.still)
        result = _refined(surface, *fewer, surface.off(*fewer), _AT_LAST * tolerance)
        if np.max(result[2], initial=0.0) <= allowed:
            return result
        held[surface.beside(vertices, result[0], result[1][result[2] > tolerance], reach)] = True
    return stage


def _lattice(parts: int) -> Array:
    """Weights (n, 3) of the corners at points of a triangle whose sides are divided in so many parts, corners left out."""
    i, j = np.meshgrid(np.arange(parts + 1), np.arange(parts + 1), indexing="ij")
    weights = np.stack([i, j, parts - i - j], axis=-1).reshape(-1, 3)
    return weights[(weights.min(axis=1) >= 0) & (weights.max(axis=1) < parts)] / parts


def _refined(surface: Surface, vertices: Array, faces: Triangles, off: Array, most: float) -> Stage:
    """The mesh with faces split that are further off than `most`, and how far each is; `off` (F,) is that before."""
    for _ in range(_ROUNDS):
        surface.still()
        bad = off > most
        if not bad.any():
            break
        marked = np.zeros(len(vertices), dtype=bool)
        marked[faces[bad]] = True
        near = marks(marked, faces) >= 2
        corners, which = np.unique(faces[near], return_inverse=True)
        part = Part(surface.terms, vertices[corners], which.reshape(-1, 3), surface.planes, surface.still)
        edges, middles, there = _splits(surface, part, off[near], most)
        part.split(*crossings(part, edges, surface.cell))
        count = len(part.points)
        there &= np.isin(edges @ (count, 1), part.edges() @ (count, 1))  # those that no crease splits
        part.split(edges[there], middles[there])
        if len(part.points) == len(corners):
            break
        number = np.append(corners, np.arange(len(part.points) - len(corners)) + len(vertices)).astype(np.int32)
        vertices = np.concatenate([vertices, part.points[len(corners) :]])
        fresh = number[part.faces]
        known = off[near][part.origin]
        anew = np.bincount(part.origin)[part.origin] > 1
        known[anew] = surface.off(vertices, fresh[anew])
        faces, off = np.concatenate([faces[~near], fresh]), np.concatenate([off[~near], known])
    return vertices, faces, off


def _splits(surface: Surface, part: Part, off: Array, most: float) -> tuple[Indices, Array, Bools]:
    """One side of each face that is further off than `most`, where it may be split by its middle, and whether it can;
    `off` (F,) is how far each face is.

    The side that is off furthest itself, or the longest where none is off by half as much as the face.
    """
    bad = off > most
    sides = np.sort(np.stack([part.faces[bad], np.roll(part.faces[bad], -1, axis=1)], axis=2), axis=2)
    count = len(part.points)
    numbers, which = np.unique(sides.reshape(-1, 2) @ (count, 1), return_inverse=True)
    edges = np.stack(np.divmod(numbers, count), axis=1)
    a, b = part.points[edges.T]
    middles, last = part.settled((a + b) / 2, surface.cell, _STEPS, part.held(edges))
    length, away = lengths(b - a), lengths(middles - (a + b) / 2)
    of_side = which.reshape(-1, 3)
    by_length = np.max(away[of_side], axis=1) < 0.5 * off[bad]
    chosen = np.where(by_length, np.argmax(length[of_side], axis=1), np.argmax(away[of_side], axis=1))
    wanted = np.unique(of_side[np.arange(len(chosen)), chosen])
    ahead = dots(part.looking(middles), part.normals[edges].sum(axis=1)) > 0
    there = (last < _ARRIVED * surface.cell) & (away < 0.5 * length) & ahead
    return edges[wanted], middles[wanted], there[wanted]
