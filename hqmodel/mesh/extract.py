"""Triangles of a tile's blocks by marching cubes (see `cubes`), every vertex named by its grid edge.

Only nodes of the blocks are sampled, each once, and only cells of the blocks looked at. Vertices are told apart by the edge they
lie on, never by rounding coordinates.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cubes import AMBIGUOUS, CORNERS, EDGES, FACES, triangles
from .cull import Blocks
from .grid import BLOCK, Grid
from .mesh import Triangles

AT_NODE = 3
Samples = NDArray[np.float32]
Numbers = NDArray[np.int64]
_BITS = np.uint8(1) << np.arange(8, dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles and the edges that their vertices lie on, each once.

    `node` (V, 3) and `axis` (V,): the first node of the grid's edge and the axis that it runs along; `AT_NODE` for the node
    itself, where an edge without length leaves a cut. `ends` (V, 2): the samples at both nodes, positive inside. `pinched` (V,)
    tells those on faces of cells that are inside at two opposite corners only: where edges with four triangles may arise.
    """

    node: Numbers
    axis: Numbers
    ends: Samples
    pinched: NDArray[np.bool_]
    faces: Triangles

    def keys(self, grid: Grid) -> Numbers:
        """One number for each of the grid's edges, (V,)."""
        _, ny, nz = (len(nodes) for nodes in grid.nodes)
        x, y, z = self.node.T
        return ((x * ny + y) * nz + z) * (AT_NODE + 1) + self.axis


def extract(blocks: Blocks, tile: Blocks, size: int, sample: Callable[[Numbers], Samples]) -> Patch | None:
    """The level set 0 of a field, positive inside, in blocks (n, 3) of the tile of `size` cells whose first node is `tile` (3,).

    `sample` gives the field at nodes (m, 3), never 0, and -inf beyond a cut. None where there is no surface.
    """
    shape = (size + 1,) * 3
    strides = np.array([shape[1] * shape[2], shape[2], 1])
    first = (blocks - tile) @ strides
    marked = np.zeros(np.prod(shape), dtype=bool)
    marked[first[:, None] + _lattice(BLOCK + 1) @ strides] = True
    nodes = np.flatnonzero(marked)
    samples = np.empty(marked.shape, dtype=np.float32)
    samples[nodes] = sample(np.stack(np.unravel_index(nodes, shape)).T + tile)
    marked[nodes] = False
    inside = (samples > 0).view(np.uint8)
    cells = (first[:, None] + _lattice(BLOCK) @ strides).ravel()
    case = np.zeros(len(cells), dtype=np.uint8)
    for bit, step in zip(_BITS, CORNERS @ strides, strict=True):
        case |= inside[cells + step] * bit
    crossed = (case > 0) & (case < 255)
    if not crossed.any():
        return None
    cells, case = cells[crossed], case[crossed]
    pinched = np.zeros(marked.shape, dtype=bool)
    edges, of_cell = _triangulated(case, _joined(case, cells, samples, strides, pinched))
    lower, along = np.array(EDGES)[edges].T
    corner = cells[of_cell] + (CORNERS @ strides)[lower]
    number, of_axis, vertices = np.empty(marked.shape, dtype=np.int32), list[Numbers](), 0
    faces = np.empty(len(corner), dtype=np.int32)
    for axis in range(3):
        here = along == axis
        marked[corner[here]] = True
        of_axis.append(np.flatnonzero(marked))
        marked[of_axis[-1]] = False
        number[of_axis[-1]] = np.arange(vertices, vertices + len(of_axis[-1]), dtype=np.int32)
        faces[here] = number[corner[here]]
        vertices += len(of_axis[-1])
    near, axes = np.concatenate(of_axis), np.repeat(np.arange(3), [len(of) for of in of_axis])
    far = near + strides[axes]
    node = np.stack(np.unravel_index(near, shape)).T + tile
    ends = np.stack([samples[near], samples[far]]).T
    return _without_length(Patch(node, axes, ends, pinched[near] & pinched[far], faces.reshape(-1, 3)))


def _without_length(patch: Patch) -> Patch:
    """The patch with the ends of cuts closed up: edges that leave it have no length."""
    node, axis, ends = patch.node, patch.axis, patch.ends
    leaves = np.isneginf(ends[:, 0]) | np.isneginf(ends[:, 1])
    if not leaves.any():
        return patch
    node = node + (np.isneginf(ends[:, :1]) & (axis[:, None] == np.arange(3)))
    axis = np.where(leaves, AT_NODE, axis)
    _, kept, number = np.unique(np.column_stack([node, axis]), axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1).astype(np.int32)[patch.faces]
    a, b, c = faces.T
    with_length = (a != b) & (b != c) & (c != a)
    return Patch(node[kept], axis[kept], ends[kept], (patch.pinched | leaves)[kept], faces[with_length])


def _lattice(count: int) -> Numbers:
    steps = np.arange(count)
    return np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)


def _joined(
    case: NDArray[np.uint8], cells: Numbers, samples: Samples, strides: Numbers, pinched: NDArray[np.bool_]
) -> NDArray[np.uint8]:
    """For each cell the ambiguous faces, as bits, whose inside corners are joined: where the face's saddle is inside.

    Their corners are marked as `pinched`.
    """
    result = np.zeros(len(cells), dtype=np.uint8)
    unclear = np.flatnonzero(AMBIGUOUS[case])
    for face, ring in enumerate(FACES):
        rows = unclear[AMBIGUOUS[case[unclear]] >> face & 1 > 0]
        corners = [cells[rows] + CORNERS[corner] @ strides for corner in ring]
        a, b, c, d = (samples[corner] for corner in corners)
        joined = np.where(a > 0, a * c > b * d, b * d > a * c)
        result[rows] |= np.where(joined, 1 << face, 0).astype(np.uint8)
        for corner in corners:
            pinched[corner] = True
    return result


def _triangulated(case: NDArray[np.uint8], joined: NDArray[np.uint8]) -> tuple[Numbers, Numbers]:
    """The edges of the cells' triangles, (3 F,), by their number in a cell, and the cell of each."""
    kinds, kind = np.unique(case + joined.astype(np.int64) * 256, return_inverse=True)
    tables = [triangles(int(code) % 256, int(code) // 256) for code in kinds]
    counts = np.array([len(table) for table in tables])
    starts = np.cumsum(counts) - counts
    count = counts[kind]
    of_cell = np.repeat(np.arange(len(kind)), count)
    within = np.arange(len(of_cell)) - np.repeat(np.cumsum(count) - count, count)
    return np.concatenate(tables).astype(np.int64)[starts[kind][of_cell] + within], of_cell
