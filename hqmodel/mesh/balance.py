"""Faces laid evenly about the surface.

Vertices on the surface leave the triangles between them on one side of it. Moved out by a share of how far their faces' middles
lie off, faces lie on both sides, at well under half the distance on average.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .grid import Grid
from .measure import QUANTUM
from .mesh import Array, Faces, alike

# The share, and how far a vertex may move at most, as a share of the longest side.
_SHARE = 0.75
_FURTHEST = 6e-5
# Not after faces that are further off than this share of a cell or whose corners' normals have a cosine below this.
_SMOOTH = 0.1
_ALIKE = 0.8
# What a face counts beside how far it is off: more than twice what those about any vertex can be off together.
_ONE = 2.0**32

Steps = NDArray[np.float32]


class Balance(NamedTuple):
    """Where vertices may move: not across `mirrored` planes nor on cuts of the grid, nor further than `furthest`.

    Distances are in whole quanta of the grid's cell.
    """

    grid: Grid
    mirrored: tuple[int, ...]
    furthest: float

    @classmethod
    def of(cls, grid: Grid, mirrored: tuple[int, ...], longest: float) -> Balance:
        """For a body whose longest side is `longest`."""
        return cls(grid, mirrored, float(np.floor(_FURTHEST * longest / (QUANTUM * grid.cell))))

    def pulls(self, faces: Faces, off: Steps, normals: NDArray[np.float32]) -> NDArray[np.float32]:
        """The sum of `off` (F,) over the smooth faces about each vertex, and their number, (V, 2); `normals` (V, 3)."""
        smooth = (np.abs(off) < _SMOOTH / QUANTUM) & alike(normals, faces, _ALIKE)
        both = np.where(smooth, off.astype(float) + _ONE, 0.0)  # whole numbers: their sums can be told apart again
        total = sum(np.bincount(corner, both, len(normals)) for corner in faces.T)
        number = np.rint(total / _ONE)
        return np.stack([total - number * _ONE, number]).T.astype(np.float32)

    def steps(self, pulls: NDArray[np.float32]) -> Steps:
        """How far vertices move out, (n,), by their `pulls` (n, 2)."""
        share = np.float32(_SHARE) * pulls[:, 0] / np.maximum(pulls[:, 1], 1)
        return np.rint(np.clip(share, -self.furthest, self.furthest))

    def move(self, vertices: Array, normals: NDArray[np.float32], step: Steps) -> None:
        """Move vertices (V, 3) along their normals (V, 3) by their steps (V,), in place.

        Vertices in a mirror plane stay in it; those in a cut stay where they are, and their steps are made 0.
        """
        for axis, plane, _ in self.grid.cuts:
            step[vertices[:, axis] == plane] = 0
        long = step * np.float32(QUANTUM * self.grid.cell)
        for i in range(3):
            way = long * normals[:, i]
            if i in self.mirrored:
                way[vertices[:, i] == 0] = 0
            vertices[:, i] += way

    def sunk(self, off: Steps, faces: Faces, step: Steps) -> Steps:
        """`off` (F,) after the corners of the faces (F, 3) have moved by their steps (V,)."""
        for corner in faces.T:
            off = off - np.rint(step.take(corner) / 3)
        return off
