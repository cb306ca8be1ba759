"""Triangles of a tile's blocks by marching cubes (see `cubes`), every vertex named by its grid edge.

Only nodes of the blocks are sampled, each once, and only cells of the blocks looked at. Vertices are told apart by the edge they
lie on, never by rounding coordinates.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cubes import AMBIGUOUS, CORNERS, CROSSED, EDGES, FACES, triangles
from .cull import Blocks
from .grid import BLOCK, Grid
from .mesh import Triangles

AT_NODE = 3
Samples = NDArray[np.float32]
Numbers = NDArray[np.int64]
Indices = NDArray[np.intp]
_EDGES = np.array(EDGES)


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
    room = _room.of((size + 1) ** 3)
    first = (blocks - tile) @ strides
    nodes = room.each(first[:, None] + _lattice(BLOCK + 1) @ strides)
    room.samples[nodes] = sample(np.stack(np.unravel_index(nodes, shape)).T + tile)
    cells = (first[:, None] + _lattice(BLOCK) @ strides).ravel()
    case = room.cases(nodes, strides)[cells]
    crossed = (case > 0) & (case < 255)
    if not crossed.any():
        return None
    cells, case, corners = cells[crossed], case[crossed], CORNERS @ strides
    joined, unclear = _joined(case, cells, room.samples, corners)
    near, axis, of_cell = _vertices(room, cells, case, corners)
    far = near + strides[axis]
    node = np.stack(np.unravel_index(near, shape)).T + tile
    ends = np.stack([room.samples[near], room.samples[far]]).T
    room.marked[unclear] = True
    pinched = room.marked[near] & room.marked[far]
    room.marked[unclear] = False
    edges, which = _triangulated(case, joined)
    return _without_length(Patch(node, axis, ends, pinched, of_cell[which, edges].reshape(-1, 3)))


def _vertices(
    room: _Room, cells: Indices, case: NDArray[np.uint8], corners: Indices
) -> tuple[Indices, NDArray[np.int64], Triangles]:
    """The crossed edges of cells, each once, by first node and axis, (V,) each, and their numbers by cell and edge, (n, 12)."""
    of_cell, near, count = np.empty((len(cells), 12), dtype=np.int32), list[Indices](), 0
    for edges in np.arange(12).reshape(3, 4):
        nodes = cells[:, None] + corners[_EDGES[edges, 0]]
        found = room.each(nodes[CROSSED[case][:, edges]])
        room.number[found] = np.arange(count, count + len(found), dtype=np.int32)
        of_cell[:, edges] = room.number[nodes]
        near.append(found)
        count += len(found)
    return np.concatenate(near), np.repeat(np.arange(3), [len(found) for found in near]), of_cell


class _Room(threading.local):
    """Arrays over a tile's nodes, one set a thread, used again for every tile: fresh memory is slow to come by."""

    samples: Samples
    inside: NDArray[np.uint8]
    marked: NDArray[np.bool_]
    number: NDArray[np.int32]

    def of(self, count: int) -> _Room:
        """Itself, with arrays for tiles of so many nodes."""
        if not hasattr(self, "samples") or len(self.samples) != count:
            self.samples = np.empty(count, dtype=np.float32)
            self.inside = np.zeros(count, dtype=np.uint8)
            self.marked = np.zeros(count, dtype=bool)
            self.number = np.zeros(count, dtype=np.int32)
        return self

    def each(self, numbers: Indices) -> Indices:
        """The nodes, each once and in order."""
        self.marked[numbers] = True
        found = np.flatnonzero(self.marked)
        self.marked[found] = False
        return found

    def cases(self, nodes: Indices, strides: Indices) -> NDArray[np.uint8]:
        """For every cell, by its first node, which of its corners are inside, as bits; true for cells whose corners are nodes."""
        self.inside[nodes] = self.samples[nodes] > 0
        case, spare = self.inside, self.number.view(np.uint8).reshape(4, -1)  # its numbers are not needed yet
        for bits, stride, into in zip((1, 2, 4), reversed(strides.tolist()), spare, strict=False):
            count = len(case) - stride
            np.left_shift(case[stride:], np.uint8(bits), out=into[:count])
            case = np.bitwise_or(case[:count], into[:count], out=into[:count])
        self.inside[nodes] = 0
        return case


_room = _Room()


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


def _joined(case: NDArray[np.uint8], cells: Indices, samples: Samples, corners: Indices) -> tuple[NDArray[np.uint8], Indices]:
    """For each cell the ambiguous faces, as bits, whose inside corners are joined: where the face's saddle is inside. Besides,
    the corners of all ambiguous faces."""
    result = np.zeros(len(cells), dtype=np.uint8)
    unclear = np.flatnonzero(AMBIGUOUS[case])
    seen = []
    for face, ring in enumerate(FACES):
        rows = unclear[AMBIGUOUS[case[unclear]] >> face & 1 > 0]
        seen.append(cells[rows] + corners[list(ring), None])
        a, b, c, d = samples[seen[-1]]
        joined = np.where(a > 0, a * c > b * d, b * d > a * c)
        result[rows] |= np.where(joined, 1 << face, 0).astype(np.uint8)
    return result, np.concatenate(seen, axis=1).ravel()


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
