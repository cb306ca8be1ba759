"""Which space a closed cloud leaves empty and which it encloses: what keeps parts from growing into either."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from .bodies import Array

# Cells along the longest side, tried in turn until no gap between the points lets the outside in.
_CELLS = (48, 32, 22, 15)
# Cells beside the walls that outside points are taken from.
_NEAR = 3
# The inside is believed when it is at least so much of what the walls take up.
_LEAST = 0.1


def sides(points: Array, count: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Points outside (M, 3) and inside (L, 3) of the surface that points (N, 3) lie on, at most `count` each.

    All are some way off the surface. An open cloud has no inside, and of its outside nothing is known but that round its box.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    for cells in _CELLS:
        side = float(np.max(high - low)) / cells
        start = low - 3 * side
        walls = np.zeros(np.ceil((high - low) / side).astype(int) + 6, dtype=bool)
        walls[tuple(((points - start) / side).astype(int).T)] = True
        walls = ndimage.binary_dilation(walls, np.ones((3, 3, 3)))
        labels, _ = ndimage.label(~walls)
        outside = labels == labels[0, 0, 0]
        inside = ~walls & ~outside
        if np.count_nonzero(inside) > _LEAST * np.count_nonzero(walls):
            near = outside & ndimage.binary_dilation(walls, iterations=_NEAR)
            return _some(near, start, side, count, rng), _some(inside, start, side, count, rng)
    return _some(~ndimage.binary_dilation(walls, iterations=2), start, side, count, rng), np.empty((0, 3))


def _some(
    chosen: np.ndarray[tuple[int, ...], np.dtype[np.bool_]], start: Array, side: float, count: int, rng: np.random.Generator
) -> Array:
    """At most so many points, each somewhere in one of the chosen cells."""
    cells = rng.permutation(np.argwhere(chosen))[:count]
    return np.asarray(start + (cells + rng.uniform(size=cells.shape)) * side)
