"""Triangles of a tile's blocks by scikit-image's marching cubes (Lewiner et al. 2003), every vertex named by its grid edge.

Only nodes of the blocks are sampled, each once; the other cells of the tile are masked out. Vertices are told apart by the edge
they lie on, never by rounding coordinates.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from skimage.measure import marching_cubes

from .cull import Blocks
from .grid import BLOCK, Grid
from .mesh import Triangles

INSIDE, AT_NODE = 3, 4
Samples = NDArray[np.float32]
Numbers = NDArray[np.int64]
_NODES = BLOCK + 1
# The interpolated position along an edge only names the edge. Samples are kept this far off the level and below the largest
# by this much, so that no position comes near a node.
_LEAST, _MOST = np.float32(0.05), np.float32(12.0)
_ON_NODE = np.float32(1e-3)
# What a vertex lies on by the axes (bits 1, 2 and 4) along which its position is between nodes: an edge, or inside a cell.
_AXIS_OF_BITS = np.array([INSIDE, 0, 1, INSIDE, 2, INSIDE, INSIDE, INSIDE], dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles and what their vertices lie on, each once.

    `node` (V, 3) and `axis` (V,): the first node of the grid's edge and the axis that it runs along; `INSIDE` for a point
    inside the cell at that node, `AT_NODE` for the node itself, where an edge without length leaves a cut. `place` (V, 3):
    where marching cubes put it, in cells from that node. `ends` (V, 2): the samples at both nodes, positive inside. `pinched`
    (V,) tells those on faces of cells that are inside at two opposite corners only: where edges with four triangles may arise.
    """

    node: Numbers
    axis: Numbers
    place: Samples
    ends: Samples
    pinched: NDArray[np.bool_]
    faces: Triangles

    def keys(self, grid: Grid) -> Numbers:
        """One number for each of the grid's edges, (V,)."""
        _, ny, nz = (len(nodes) for nodes in grid.nodes)
        x, y, z = self.node.T
        return ((x * ny + y) * nz + z) * (AT_NODE + 1) + self.axis


def extract(blocks: Blocks, tile: Blocks, size: int, sample: Callable[[Numbers], Samples], steepness: float) -> Patch | None:
    """The level set 0 of a field, positive inside, in blocks (n, 3) of the tile of `size` cells whose first node is `tile` (3,).

    `sample` gives the field at nodes (m, 3), -inf beyond a cut; `steepness` brings a cell's difference in it to about 1. None
    where there is no surface.
    """
    shape = (size + 1,) * 3
    strides = np.array([shape[1] * shape[2], shape[2], 1])
    first = (blocks - tile) @ strides
    of_block = (first[:, None] + _lattice(0, _NODES) @ strides).astype(np.int32)
    used = np.zeros(np.prod(shape), dtype=bool)
    used[of_block] = True
    nodes = np.flatnonzero(used)
    values = sample(np.stack(np.unravel_index(nodes, shape)).T + tile)
    if values.max() <= 0 or values.min() > 0:
        return None
    volume = np.full(used.shape, -_LEAST)
    volume[nodes] = np.copysign(np.clip(np.abs(values) * np.float32(steepness), _LEAST, _MOST), values)
    cells = used
    cells[:] = False
    cells[first[:, None] + _lattice(1, _NODES) @ strides] = True  # a cell is masked by its far corner
    found, faces, _, _ = marching_cubes(
        volume.reshape(shape), 0.0, mask=cells.reshape(shape), gradient_direction="ascent", allow_degenerate=True
    )
    if not len(faces):
        return None
    volume[nodes] = values
    return _named(tile, strides, volume, _pinched(volume, of_block), found, faces.astype(np.int32, copy=False))


def _lattice(start: int, end: int) -> Numbers:
    steps = np.arange(start, end)
    return np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)


def _named(
    tile: Blocks, strides: Numbers, samples: Samples, pinched: NDArray[np.bool_], found: Samples, faces: Triangles
) -> Patch:
    columns = found.T
    nodes = [np.floor(column + _ON_NODE) for column in columns]
    bits = sum(
        (column - node > 2 * _ON_NODE) * np.int64(1 << i) for i, (column, node) in enumerate(zip(columns, nodes, strict=True))
    )
    axis = _AXIS_OF_BITS[bits]
    place = found - np.stack(nodes).T
    node = np.stack([part.astype(np.int64) for part in nodes]).T
    near = node @ strides
    far = near + np.append(strides, [0, 0])[axis]
    ends = np.stack([samples[near], samples[far]]).T
    pinch = pinched[near] & pinched[far]
    leaves = (axis < INSIDE) & (np.isneginf(ends[:, 0]) | np.isneginf(ends[:, 1]))
    node += tile
    if not leaves.any():
        return Patch(node, axis, place, ends, pinch, faces)
    for i in range(3):
        node[:, i] += leaves & np.isneginf(ends[:, 0]) & (axis == i)
    axis = np.where(leaves, AT_NODE, axis)
    _, kept, number = np.unique(np.column_stack([node, axis]), axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1).astype(np.int32)[faces]
    a, b, c = faces.T
    with_length = (a != b) & (b != c) & (c != a)
    return Patch(node[kept], axis[kept], place[kept], ends[kept], (pinch | leaves)[kept], faces[with_length])


def _pinched(samples: Samples, of_block: NDArray[np.int32]) -> NDArray[np.bool_]:
    """The nodes of those of the blocks' cells' faces that are inside at two opposite corners only."""
    inside = samples[of_block] > 0
    result = np.zeros(samples.shape, dtype=bool)
    index = np.arange(inside.shape[1])
    for a, b in combinations((_NODES * _NODES, _NODES, 1), 2):
        first = index[: len(index) - a - b]
        on_face = (first // a % _NODES < BLOCK) & (first // b % _NODES < BLOCK)
        corners = [slice(start, start + len(first)) for start in (0, a, b, a + b)]
        c00, c01, c10, c11 = (inside[:, corner] for corner in corners)
        crossed = (c00 == c11) & (c01 == c10) & (c00 != c01) & on_face
        if crossed.any():
            for corner in corners:
                result[of_block[:, corner][crossed]] = True
    return result
