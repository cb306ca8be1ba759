"""Which blocks of the grid the surface may pass through, by exact bounds from coarse to fine."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, box_bounds

from .grid import BLOCK, Grid

Blocks = NDArray[np.int64]

# Cells along a side of a tile: what one job samples with the terms that matter there.
TILE = 128


def tiles(terms: Terms, grid: Grid) -> Blocks:
    """First nodes (n, 3) of the tiles that the surface may pass through, in a fixed order."""
    size = TILE
    while size < max(len(nodes) for nodes in grid.nodes):
        size *= 2
    return _descend(terms, grid, np.zeros((1, 3), dtype=np.int64), size, TILE)


def blocks_of(terms: Terms, grid: Grid, tile: Blocks) -> Blocks:
    """First nodes (n, 3) of the blocks of one tile that the surface may pass through."""
    return _descend(terms, grid, tile.reshape(1, 3), TILE, BLOCK)


def _descend(terms: Terms, grid: Grid, cubes: Blocks, size: int, until: int) -> Blocks:
    ends = np.array([len(nodes) - 1 for nodes in grid.nodes])
    cubes = _crossed(terms, grid, cubes, size)
    while size > until:
        size //= 2
        steps = np.stack(np.meshgrid([0, size], [0, size], [0, size], indexing="ij"), axis=-1).reshape(-1, 3)
        cubes = (cubes[:, None] + steps).reshape(-1, 3)
        cubes = _crossed(terms, grid, cubes[np.all(cubes < ends, axis=1)], size)
    return cubes[np.lexsort(cubes.T[::-1])]


def _crossed(terms: Terms, grid: Grid, cubes: Blocks, size: int) -> Blocks:
    lower, upper = box_bounds(terms, *grid.corners(cubes, size))
    return cubes[(upper > 0) & ((lower <= 0) | grid.touches_outside(cubes, size))]
