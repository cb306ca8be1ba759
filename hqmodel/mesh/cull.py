"""Which blocks of the grid the surface may pass through, by exact bounds from coarse to fine."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, box_bounds, relevant_terms

from .grid import BLOCK, Grid

Blocks = NDArray[np.integer[Any]]

# Cells along a side of a tile, where blocks are looked for at once, with the terms that matter there: larger for a single one.
_TILE, _WHOLE = 128, 512


def tiles(terms: Terms, grid: Grid) -> tuple[Blocks, int]:
    """First nodes (n, 3) of the tiles that the surface may pass through, neighbours mostly in a row, and their size in cells."""
    tile = _TILE if len(terms) > 1 else _WHOLE
    size = tile
    while size < max(len(nodes) for nodes in grid.nodes):
        size *= 2
    return _descend(terms, grid, np.zeros((1, 3), dtype=np.int64), size, tile), tile


def blocks_of(terms: Terms, grid: Grid, size: int, tile: Blocks) -> Blocks:
    """First nodes (n, 3) of the blocks of a tile of that size that the surface may pass through, neighbours mostly in a row."""
    tile = tile.reshape(1, 3)
    return _descend(relevant(terms, grid, tile, size), grid, tile, size, BLOCK)


def relevant(terms: Terms, grid: Grid, cubes: Blocks, size: int) -> Terms:
    """Only the terms that can matter where the cubes of cells are."""
    low, high = grid.corners(cubes, size)
    return relevant_terms(terms, low.min(axis=0), high.max(axis=0))


def _descend(terms: Terms, grid: Grid, cubes: Blocks, size: int, until: int) -> Blocks:
    ends = np.array([len(nodes) - 1 for nodes in grid.nodes])
    cubes = _crossed(terms, grid, cubes, size)
    while size > until:
        size //= 2
        steps = np.stack(np.meshgrid([0, size], [0, size], [0, size], indexing="ij"), axis=-1).reshape(-1, 3)
        cubes = (cubes[:, None] + steps).reshape(-1, 3)
        cubes = _crossed(terms, grid, cubes[np.all(cubes < ends, axis=1)], size)
    return cubes


def _crossed(terms: Terms, grid: Grid, cubes: Blocks, size: int) -> Blocks:
    lower, upper = box_bounds(terms, *grid.corners(cubes, size))
    return cubes[(upper > 0) & ((lower <= 0) | grid.touches_outside(cubes, size))]
