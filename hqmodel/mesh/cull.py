"""Which blocks of the grid the surface may pass through, by exact bounds from coarse to fine."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, box_bounds

from .grid import BLOCK, Grid

Blocks = NDArray[np.int64]
Size = int | tuple[int, int, int]

# Cells along the sides of a tile, what one job samples with the terms that matter there: powers of 2, times that of a block.
TILE = (128, 128, 128)


def tiles(terms: Terms, grid: Grid) -> Blocks:
    """First nodes (n, 3) of the tiles that the surface may pass through, in a fixed order."""
    most = size = max(TILE)
    while size < max(len(nodes) for nodes in grid.nodes):
        size *= 2
    cubes = _descend(terms, grid, np.zeros((1, 3), dtype=np.int64), size, most)
    return _ordered(_crossed(terms, grid, _parts(grid, cubes, most, TILE), TILE))


def blocks_of(terms: Terms, grid: Grid, tile: Blocks) -> Blocks:
    """First nodes (n, 3) of the blocks of one tile that the surface may pass through."""
    least = min(TILE)
    return _ordered(_descend(terms, grid, _parts(grid, tile.reshape(1, 3), TILE, least), least, BLOCK))


def _descend(terms: Terms, grid: Grid, cubes: Blocks, size: int, until: int) -> Blocks:
    cubes = _crossed(terms, grid, cubes, size)
    while size > until:
        size //= 2
        cubes = _crossed(terms, grid, _parts(grid, cubes, 2 * size, size), size)
    return cubes


def _parts(grid: Grid, boxes: Blocks, size: Size, part: Size) -> Blocks:
    """First nodes of the boxes of `part` cells that make up boxes of `size` cells, those beyond the grid's end left out."""
    steps = [np.arange(0, whole, piece) for whole, piece in zip(np.broadcast_to(size, 3), np.broadcast_to(part, 3), strict=True)]
    parts = (boxes[:, None] + np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3)).reshape(-1, 3)
    return parts[np.all(parts < [len(nodes) - 1 for nodes in grid.nodes], axis=1)]


def _crossed(terms: Terms, grid: Grid, boxes: Blocks, size: Size) -> Blocks:
    lower, upper = box_bounds(terms, *grid.corners(boxes, size))
    return boxes[(upper > 0) & ((lower <= 0) | grid.touches_outside(boxes, size))]


def _ordered(boxes: Blocks) -> Blocks:
    return boxes[np.lexsort(boxes.T[::-1])]
