"""How far a mesh lies from the true surface, measured anywhere on its faces, and what of it lies near."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import inf

import numpy as np

from hqmodel.field import Terms, near_linear_gradient

from .measure import along
from .mesh import Array, Triangles, crosses, lengths, unit
from .refine import to_surface
from .splits import Indices, Plane
from .stars import Bools, Near

# The most Newton steps that points take towards the surface.
STEPS = 6
# None follows one that is shorter than these shares of the point's way and of a cell.
_FIRM, _EXACT = 1e-3, 1e-9
# Distances to first order that are below this share of what matters are near enough.
_SURE = 0.5
# The fewest and the most parts that a face's sides are divided in to be measured: their middles are looked at in any case.
_COARSEST, _FINEST = 4, 100
_AT_ONCE = 1 << 15
# Where in a triangle it is looked whether it may be made: the weights of its corners, the first of which is new. More points lie
# towards the corners, as what is flat in the middle may bend there.
_SHARES = np.array([0.5, 0.8, 0.2, 0.95, 0.05])
_SPOTS = np.concatenate([np.stack([_SHARES, 1 - _SHARES, 0 * _SHARES], axis=1), np.full((1, 3), 1 / 3)])


@dataclass(frozen=True, eq=False)
class Surface:
    """The true surface, where a grid of cells of size `cell` found it.

    Of the `planes` (axis, coordinate) the first `cuts` cut it off, and the others mirror it.
    `still` is called again and again, and `left` with how many faces are left as a mesh is reduced; whatever they raise ends the
    work.
    """

    terms: Terms
    planes: list[Plane]
    cuts: int
    cell: float
    still: Callable[[], None]
    left: Callable[[int], None]

    def flat(self, points: Array) -> Indices:
        """In which plane, numbered from 1, each coordinate of points lies, (n, 3); 0 for none."""
        number = np.zeros(points.shape, dtype=np.intp)
        for index, (axis, plane) in enumerate(self.planes):
            number[points[:, axis] == plane, axis] = index + 1
        return number

    @property
    def crested(self) -> bool:
        """Whether there are crests, which are narrow, and about which slopes are infinite."""
        return bool(np.any(self.terms.inner < 1))

    def near(self, most: float) -> Near:
        """Tells which triangles, by their corners (n, 3) each, lie about within a distance."""

        def near(a: Array, b: Array, c: Array) -> Bools:
            return self._measured(np.stack([a, b, c]), _SPOTS, inf) <= most

        return near

    def nearest(self, points: Array, held: Bools) -> Array:
        """The points (n, 3) moved onto the surface, held coordinates, (n, 3), kept: by as many steps as each takes."""
        moved, going = points.copy(), np.arange(len(points))
        for _ in range(STEPS):
            if not going.size:
                break
            moved[going], last = to_surface(self.terms, moved[going], self.cell, 1, held[going])
            going = going[last > np.maximum(_FIRM * lengths(moved[going] - points[going]), _EXACT * self.cell)]
        return moved

    def off(self, vertices: Array, faces: Triangles, most: float) -> Array:
        """How far each face is off the surface at most, (F,), as far as that can be seen by points a cell apart, or less.

        Where that seems to be more than `most` it is looked at twice.
        """
        result = np.zeros(len(faces))
        corners = vertices[faces.T]
        for some, lattice in self._lattices(corners):
            result[some] = self._measured(corners[:, some], lattice, most)
        return result

    def beside(self, points: Array, vertices: Array, faces: Triangles, reach: float) -> Bools:
        """Which of the points (n, 3) are about as near to any of the faces as `reach`, which is no less than a cell."""
        from scipy.spatial import cKDTree  # late: it is slow to load

        corners = vertices[faces.T]
        spots = [np.tensordot(lattice, corners[:, some], axes=1).reshape(-1, 3) for some, lattice in self._lattices(corners)]
        distance, _ = cKDTree(np.concatenate(spots)).query(points, distance_upper_bound=reach)
        return np.isfinite(distance)

    def _lattices(self, corners: Array) -> Iterator[tuple[Indices, Array]]:
        """The numbers of some faces, by their corners (3, F, 3), and a lattice whose points lie a cell apart on them, or less."""
        longest = np.sqrt(np.max(np.sum((corners - np.roll(corners, 1, axis=0)) ** 2, axis=2), axis=0))
        parts = np.clip(np.ceil(longest * (2 if self.crested else 1) / self.cell), _COARSEST, _FINEST).astype(int)
        for number in np.unique(parts):
            rows = np.flatnonzero(parts == number)
            lattice = _lattice(int(number))
            for some in np.array_split(rows, len(rows) * len(lattice) // _AT_ONCE + 1):
                self.still()
                yield some, lattice

    def _measured(self, corners: Array, lattice: Array, most: float) -> Array:
        """How far triangles, by their corners (3, n, 3), are off at most at a lattice's points, (n,); within caps they aren't.

        To first order, where that is far less than `most` and slopes are finite; else along the gradient, or, where that is
        more, along the triangle's normal.
        """
        flat = np.stack([self.flat(points) for points in corners])
        capped = np.any(_common(flat) & (flat[0] <= self.cuts), axis=1)
        points = np.tensordot(lattice, corners, axes=1)
        sides, of_side = np.unique(lattice > 0, axis=0, return_inverse=True)
        held = np.stack([_common(flat[side]) for side in sides])[of_side.ravel()]
        points, held = points[:, ~capped].reshape(-1, 3), held[:, ~capped].reshape(-1, 3)
        linear, slope = near_linear_gradient(self.terms, points)
        distance = np.abs(linear) / np.maximum(lengths(np.where(held, 0.0, slope)), 1e-200)
        unsure = np.flatnonzero((distance > _SURE * most) | self.crested)
        distance[unsure] = lengths(self.nearest(points[unsure], held[unsure]) - points[unsure])
        far = np.flatnonzero(distance > most)
        if far.size:
            a, b, c = (corner[~capped][far % np.count_nonzero(~capped)] for corner in corners)
            normals = unit(np.where(held[far], 0.0, crosses(b - a, c - a)))
            distance[far] = np.minimum(distance[far], along(self.terms, points[far], normals, self.cell))
        result = np.zeros(corners.shape[1])
        result[~capped] = np.max(distance.reshape(len(lattice), -1), axis=0)
        return result


def _common(planes: Indices) -> Bools:
    """Which coordinates (n, 3) lie in one plane at all of some points, whose planes are given (k, n, 3)."""
    return np.all(planes == planes[0], axis=0) & (planes[0] > 0)


def _lattice(parts: int) -> Array:
    """Weights (n, 3) of the corners at points of a triangle whose sides are divided in so many parts, corners left out."""
    i, j = np.meshgrid(np.arange(parts + 1), np.arange(parts + 1), indexing="ij")
    weights = np.stack([i, j, parts - i - j], axis=-1).reshape(-1, 3)
    return weights[(weights.min(axis=1) >= 0) & (weights.max(axis=1) < parts)] / parts
