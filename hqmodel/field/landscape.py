"""The landscape over the plane: the height of a scene's sum of exponentials at each point of it (Hanson 1988, figures 16-18).

The plane at a height w cuts the body's outline out of it, whose field is that height less w.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hqmodel.model import Scene

from .evaluate import value
from .region import region
from .terms import Terms

Array = NDArray[np.float64]

# Land no higher than this, or deeper, counts as flat.
FLAT = 0.003


@dataclass(frozen=True, eq=False)
class Landscape:
    """Points (n + 1, n + 1, 3) of the land over a grid of n x n squares; the first index goes with x, the second with y."""

    points: Array

    @property
    def low(self) -> Array:
        """The corner (2,) of the rectangle where x and y are least."""
        return self.points[0, 0, :2]

    @property
    def high(self) -> Array:
        """The corner (2,) where they are largest."""
        return self.points[-1, -1, :2]

    @property
    def heights(self) -> Array:
        """(n + 1, n + 1)."""
        return self.points[..., 2]

    def squares(self) -> Array:
        """The squares' corners (n * n, 4, 3), counter-clockwise as seen from above."""
        p = self.points
        return np.stack([p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]], axis=2).reshape(-1, 4, 3)

    def section(self, level: float) -> Array:
        """Where the land, each square two triangles, meets the plane at a height: pieces of curves (m, 2, 3), in no order."""
        corners = self.squares()
        triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
        above = triangles[..., 2] > level
        crossed = triangles[np.any(above, axis=1) & ~np.all(above, axis=1)]
        ends = np.roll(crossed, -1, axis=1)
        start, end = crossed[..., 2] - level, ends[..., 2] - level
        cut = (start > 0) != (end > 0)  # two edges of each triangle
        share = start[cut] / (start[cut] - end[cut])
        return (crossed[cut] + (ends[cut] - crossed[cut]) * share[:, None]).reshape(-1, 2, 3)


def landscape(scene: Scene, squares: int, low: Array | None = None, high: Array | None = None) -> Landscape:
    """The land in and about the rectangle from low to high (2,), which is the body's where none is given.

    It reaches as far to each side as the land is not flat, at most by the rectangle's own width.
    """
    terms = replace(Terms.of(scene), level=0.0)
    if low is None or high is None:
        where = region(scene)
        where = region(scene.changed(level=FLAT)) if where.empty else where
        low, high = where.low[:2], where.high[:2]
    wide = _points(terms, squares, low - (high - low), high + (high - low)).reshape(-1, 3)
    uneven = np.vstack([wide[np.abs(wide[:, 2]) > FLAT, :2], low, high])
    return Landscape(_points(terms, squares, np.min(uneven, axis=0), np.max(uneven, axis=0)))


def _points(terms: Terms, squares: int, low: Array, high: Array) -> Array:
    """Points (n, n, 3) of the land over the rectangle from low to high."""
    x, y = (np.linspace(a, b, squares + 1) for a, b in zip(low, high, strict=True))
    ground = np.stack([*np.meshgrid(x, y, indexing="ij"), np.zeros((len(x), len(y)))], axis=-1)
    return np.concatenate([ground[..., :2], value(terms, ground)[..., None]], axis=-1)
