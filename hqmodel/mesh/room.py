"""Whether a mesh will find room in memory, judged by a coarse one before the work is begun."""

from __future__ import annotations

import os
from math import sqrt
from typing import NamedTuple

import numpy as np

from hqmodel import memory
from hqmodel.model import Scene

from .build import polygonize
from .mesh import Mesh, MeshError, crosses
from .tolerance import COARSE

# Bytes that meshing, measuring and writing want at the most: for each triangle, or each that there was before they were
# reduced; for each run of blocks under way; and for the rest. Measured for bodies of all kinds and formats at 256 to 1,024 cells.
_FACE, _REDUCED, _RUN, _REST = 150.0, 220.0, 2e7, 4e7
# The same for each quad of a radial grid, at 512 to 2,048 of them around.
_QUAD = 600.0
# More triangles than that, in squares of the resolution, no body was seen to have.
_MOST = 60.0


class Count(NamedTuple):
    """A mesh's triangles at `COARSE` cells: those that marching cubes lays over the surface, `plain`, whose number goes with the
    square of the resolution, and those that creases add, which goes with the resolution itself."""

    plain: float
    added: float

    @classmethod
    def of(cls, coarse: Mesh) -> Count:
        """Two triangles for each crossing of a line of the grid, of which there is one to each square of a cell's sides."""
        a, b, c = (coarse.vertices[corner] for corner in coarse.faces.T)
        crossed = float(np.abs(crosses(b - a, c - a)).sum()) / 2
        cell = float(np.max(np.ptp(coarse.vertices, axis=0))) / COARSE
        plain = min(2 * crossed / cell**2, len(coarse.faces))
        return cls(plain, len(coarse.faces) - plain)

    def at(self, resolution: float) -> float:
        """The triangles to be expected at that resolution."""
        finer = resolution / COARSE
        return self.plain * finer**2 + self.added * finer

    def finest(self, faces: float) -> float:
        """The resolution that so many triangles are to be expected at."""
        return 2 * faces * COARSE / (self.added + sqrt(self.added**2 + 4 * self.plain * faces))


def lack_of_room(count: Count, resolution: int, reducing: bool) -> str:
    """Why there is no memory for such a mesh, and up to which resolution there is; empty where there is.

    `reducing`: whether its triangles are to become fewer.
    """
    each, rest, free = _REDUCED if reducing else _FACE, _rest(), memory.available()
    needed = rest + each * count.at(resolution)
    if needed <= free:
        return ""
    return _lack(int(count.finest(max(0.0, free - rest) / each)), free, resolution, needed)


def must_have_room(scene: Scene, resolution: int, reducing: bool = False) -> None:
    """Raise MeshError where there is no memory for the scene's mesh. It costs a coarse one where that is in doubt."""
    if _rest() + _REDUCED * _MOST * resolution**2 <= memory.available():
        return
    try:
        count = Count.of(polygonize(scene, COARSE, shading=False))
    except MeshError:
        return  # the finer one will say what is wrong
    lack = lack_of_room(count, resolution, reducing)
    if lack:
        raise MeshError(lack)


def quads_must_have_room(around: int) -> None:
    """Raise MeshError where there is no memory for a radial grid with so many quads around: six faces of (around/4)^2."""
    free, each = memory.available(), 6 * _QUAD / 16
    needed = _REST + each * around**2
    if needed > free:
        raise MeshError(_lack(int(sqrt(max(0.0, free - _REST) / each)), free, around, needed))


def _lack(fits: int, free: float, resolution: int, needed: float) -> str:
    return (
        f"resolution: expected at most {fits} in the {memory.told(free)} of memory that are free, "
        f"got {resolution}, which needs about {memory.told(needed)}"
    )


def _rest() -> float:
    return _REST + _RUN * (os.cpu_count() or 1)
