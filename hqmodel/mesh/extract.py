"""Triangles of sampled blocks by scikit-image's marching cubes (Lewiner et al. 2003), every vertex named by its grid edge.

Blocks are handed over packed one after another along the first axis, the cells between them masked out, so that one call does
for hundreds. Vertices are told apart by the edge they lie on, never by rounding coordinates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from skimage.measure import marching_cubes

from .cull import Blocks
from .grid import BLOCK, Grid
from .mesh import Triangles

NODES = BLOCK + 1
INSIDE, AT_NODE = 3, 4
Samples = NDArray[np.float32]
# Blocks in one call; float32 coordinates of the packed array stay finer than a thousandth of a cell.
_PACK = 560
# The interpolated position along an edge only names the edge. Samples are kept this far off the level and below the largest
# by this much, so that no position comes near a node.
_LEAST, _MOST = np.float32(0.05), np.float32(12.0)
_ON_NODE = np.float32(1e-3)
# What a vertex lies on by the axes (bits 1, 2 and 4) along which its position is between nodes: an edge, or inside a cell.
_AXIS_OF_BITS = np.array([INSIDE, 0, 1, INSIDE, 2, INSIDE, INSIDE, INSIDE], dtype=np.int64)
# The steps to the far node of each kind of edge in an array of blocks.
_STRIDE = np.array([NODES * NODES, NODES, 1, 0, 0])


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles and what their vertices lie on, each once.

    `key` (V,) sorted: one number for each grid edge, see `Edges`. `place` (V, 3): where marching cubes put it, in cells from
    the edge's first node. `ends` (V, 2): the samples at both nodes, positive inside. `pinched` (V,) tells those on faces of
    cells that are inside at two opposite corners only: where edges with four triangles may arise.
    """

    key: NDArray[np.int64]
    place: Samples
    ends: Samples
    pinched: NDArray[np.bool_]
    faces: Triangles


class Edges:
    """Numbers for a grid's edges: a node and the axis the edge runs along; `INSIDE` for a point inside the cell at that node,
    `AT_NODE` for the node itself, where an edge without length leaves a cut."""

    def __init__(self, grid: Grid) -> None:
        self._ny, self._nz = len(grid.nodes[1]), len(grid.nodes[2])

    def number(
        self, x: NDArray[np.int64], y: NDArray[np.int64], z: NDArray[np.int64], axis: NDArray[np.int64]
    ) -> NDArray[np.int64]:
        """The number of each edge, (n,)."""
        return ((x * self._ny + y) * self._nz + z) * (AT_NODE + 1) + axis

    def parts(self, key: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Nodes (n, 3) and axes (n,) of edges (n,)."""
        rest, axis = np.divmod(key, AT_NODE + 1)
        rest, z = np.divmod(rest, self._nz)
        x, y = np.divmod(rest, self._ny)
        return np.stack([x, y, z]).T, axis


def extract(blocks: Blocks, edges: Edges, sample: Callable[[Blocks], Samples], steepness: float) -> Patch | None:
    """The level set 0 of a field, positive inside, in blocks (n, 3); None where there is none.

    `sample` gives the field at the nodes of some of them, (m, 5, 5, 5); `steepness` brings a cell's difference in it to about 1.
    """
    patches = list(_packed(blocks, edges, sample, steepness))
    if not patches:
        return None
    starts = np.cumsum([0] + [len(patch.key) for patch in patches[:-1]], dtype=np.int32)
    key, first, number = np.unique(np.concatenate([p.key for p in patches]), return_index=True, return_inverse=True)
    number = number.reshape(-1).astype(np.int32)
    pinched = np.zeros(len(key), dtype=bool)
    pinched[number[np.concatenate([p.pinched for p in patches])]] = True
    faces = np.concatenate([p.faces + start for p, start in zip(patches, starts, strict=True)])
    return Patch(
        key,
        np.concatenate([p.place for p in patches])[first],
        np.concatenate([p.ends for p in patches])[first],
        pinched,
        number[faces],
    )


def _packed(blocks: Blocks, edges: Edges, sample: Callable[[Blocks], Samples], steepness: float) -> Iterator[Patch]:
    for start in range(0, len(blocks), _PACK):
        pack = blocks[start : start + _PACK]
        samples = sample(pack)
        inside = samples > 0
        crossed = inside.any(axis=(1, 2, 3)) & ~inside.all(axis=(1, 2, 3))
        if not crossed.any():
            continue
        pack, samples, inside = pack[crossed], samples[crossed], inside[crossed]
        size = np.clip(np.abs(samples) * np.float32(steepness), _LEAST, _MOST)
        volume = np.where(inside, size, -size).reshape(-1, NODES, NODES)
        mask = np.ones(volume.shape, dtype=bool)
        mask[::NODES] = False  # a cell is masked by its far corner
        found, faces, _, _ = marching_cubes(volume, 0.0, mask=mask, gradient_direction="ascent")
        yield _named(pack, edges, samples.reshape(-1), _pinched(inside).reshape(-1), found, faces.astype(np.int32, copy=False))


def _named(blocks: Blocks, edges: Edges, samples: Samples, pinched: NDArray[np.bool_], found: Samples, faces: Triangles) -> Patch:
    nodes = [np.floor(column + _ON_NODE) for column in found.T]
    bits = sum(
        (column - node > 2 * _ON_NODE) * np.int64(1 << i) for i, (column, node) in enumerate(zip(found.T, nodes, strict=True))
    )
    axis = _AXIS_OF_BITS[bits]
    x, y, z = (node.astype(np.int64) for node in nodes)
    near = (x * NODES + y) * NODES + z
    far = near + _STRIDE[axis]
    ends = np.stack([samples[near], samples[far]]).T
    leaves = (axis < INSIDE) & (np.isneginf(ends[:, 0]) | np.isneginf(ends[:, 1]))
    block, x = np.divmod(x, NODES)
    if leaves.any():
        moved = leaves & np.isneginf(ends[:, 0])
        x, y, z = (node + (moved & (axis == i)) for i, node in enumerate((x, y, z)))
        axis = np.where(leaves, AT_NODE, axis)
    key = edges.number(blocks[block, 0] + x, blocks[block, 1] + y, blocks[block, 2] + z, axis)
    place = found - np.stack(nodes).T
    return Patch(key, place, ends, (pinched[near] & pinched[far]) | leaves, faces)


def _pinched(inside: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The nodes, in blocks (n, 5, 5, 5), of those of the cells' faces that are inside at two opposite corners only."""
    rows = inside.reshape(len(inside), -1)
    result = np.zeros(rows.shape, dtype=bool)
    for a, b in combinations(_STRIDE[:3], 2):
        first = np.arange(rows.shape[1] - a - b)
        on_face = (first // a % NODES < BLOCK) & (first // b % NODES < BLOCK)
        corners = [slice(start, start + len(first)) for start in (0, a, b, a + b)]
        c00, c01, c10, c11 = (rows[:, corner] for corner in corners)
        crossed = (c00 == c11) & (c01 == c10) & (c00 != c01) & on_face
        if crossed.any():
            for corner in corners:
                result[:, corner] |= crossed
    return result
