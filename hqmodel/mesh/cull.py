"""Which blocks of the grid the surface may pass through, by exact bounds from coarse to fine."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, box_bounds

from .grid import BLOCK, Grid

Blocks = NDArray[np.int64]

# Cells along a side of a tile: what one job looks through with the terms that matter there.
TILE = 64
# Cells along a side of what is marched at once, so as to need little memory.
PART = 64
_HALVES = np.array(list(product((0, 1), repeat=3)))


def tiles(terms: Terms, grid: Grid) -> Blocks:
    """First nodes (n, 3) of the tiles that the surface may pass through, in a fixed order."""
    size = TILE
    while size < max(len(nodes) for nodes in grid.nodes):
        size *= 2
    return _descend(terms, grid, np.zeros((1, 3), dtype=np.int64), size, TILE)


def blocks_of(terms: Terms, grid: Grid, tile: Blocks) -> Blocks:
    """First nodes (n, 3) of the blocks of one tile that the surface may pass through."""
    return _descend(terms, grid, tile.reshape(1, 3), TILE, BLOCK)


def parts(blocks: Blocks) -> Iterator[Blocks]:
    """Blocks (n, 3) by the cubes of `PART` cells that they lie in."""
    if len(blocks):
        x, y, z = (blocks // PART).T
        label = (x << 40) + (y << 20) + z
        order = np.argsort(label, kind="stable")
        yield from np.split(blocks[order], np.flatnonzero(np.diff(label[order])) + 1)


def _descend(terms: Terms, grid: Grid, cubes: Blocks, size: int, until: int) -> Blocks:
    ends = np.array([len(nodes) - 1 for nodes in grid.nodes])
    cubes = _crossed(terms, grid, cubes, size)
    while size > until:
        size //= 2
        cubes = (cubes[:, None] + size * _HALVES).reshape(-1, 3)
        cubes = _crossed(terms, grid, cubes[np.all(cubes < ends, axis=1)], size)
    return cubes[np.lexsort(cubes.T[::-1])]


def _crossed(terms: Terms, grid: Grid, cubes: Blocks, size: int) -> Blocks:
    lower, upper = box_bounds(terms, *grid.corners(cubes, size))
    crossed = (upper > 0) & ((lower <= 0) | grid.touches_outside(cubes, size)) if grid.cuts else (upper > 0) & (lower <= 0)
    return cubes[crossed]
