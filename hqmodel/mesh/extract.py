"""Triangles of sampled blocks by scikit-image's marching cubes (Lewiner et al. 2003), every vertex named by its grid edge.

Blocks are handed over packed one after another along the first axis, the cells between them masked out, so that one call does
for hundreds. Vertices are told apart by the edge they lie on, never by rounding coordinates.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skimage.measure import marching_cubes

from .cull import Blocks
from .grid import BLOCK
from .mesh import Array, Triangles

NODES = BLOCK + 1
INSIDE, AT_NODE = 3, 4
# Blocks in one call; float32 coordinates of the packed array stay finer than a thousandth of a cell.
_PACK = 560
# The interpolated position along an edge only names the edge. Samples are kept this far off the level and below the largest
# by this much, so that no position comes near a node.
_LEAST, _MOST = 0.05, 12.0
_ON_NODE = 1e-3


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles and the edges their vertices lie on.

    `edge` (V, 4): the lower node's number along each axis, and the axis the edge runs along; `INSIDE` for a point inside the
    cell at that node, `AT_NODE` for the node itself, where an edge without length leaves a cut. `place` (V, 3): where marching
    cubes put it, in cells from that node. `ends` (V, 2): the samples at both nodes.
    """

    edge: NDArray[np.int64]
    place: Array
    ends: Array
    faces: Triangles


def extract(blocks: Blocks, sample: Callable[[Blocks], Array], steepness: float) -> Patch:
    """The level set 0 of a field, positive inside, in blocks (n, 3).

    `sample` gives the field at the nodes of some of them, (m, 5, 5, 5); `steepness` brings a cell's difference in it to about 1.
    """
    packs = [blocks[i : i + _PACK] for i in range(0, len(blocks), _PACK)]
    patches = [_packed(pack, sample(pack), steepness) for pack in packs]
    starts = np.cumsum([0] + [len(patch.edge) for patch in patches])
    return Patch(
        np.concatenate([patch.edge for patch in patches]),
        np.concatenate([patch.place for patch in patches]),
        np.concatenate([patch.ends for patch in patches]),
        np.concatenate([patch.faces + np.int32(start) for patch, start in zip(patches, starts[:-1], strict=True)]),
    )


def _packed(blocks: Blocks, samples: Array, steepness: float) -> Patch:
    volume = np.where(samples > 0, 1.0, -1.0) * np.clip(np.abs(samples) * steepness, _LEAST, _MOST)
    inside = volume > 0
    if inside.all() or not inside.any():
        return Patch(np.empty((0, 4), np.int64), np.empty((0, 3)), np.empty((0, 2)), np.empty((0, 3), np.int32))
    packed = volume.astype(np.float32).reshape(-1, NODES, NODES)
    mask = np.ones(packed.shape, dtype=bool)
    mask[::NODES] = False  # a cell is masked by its far corner
    found, faces, _, _ = marching_cubes(packed, 0.0, mask=mask, gradient_direction="ascent")
    return _named(blocks, samples, found.astype(float), faces.astype(np.int32))


def _named(blocks: Blocks, samples: Array, found: Array, faces: Triangles) -> Patch:
    nearest = np.rint(found)
    between = np.abs(found - nearest) > _ON_NODE
    node = np.where(between, np.floor(found), nearest).astype(np.int64)
    axis = np.where(np.count_nonzero(between, axis=1) == 1, np.argmax(between, axis=1), INSIDE)
    block, local = node[:, 0] // NODES, node.copy()
    local[:, 0] %= NODES
    far = local.copy()
    rows = np.flatnonzero(axis < INSIDE)
    far[rows, axis[rows]] += 1
    ends = np.stack([samples[(block, *end.T)] for end in (local, far)], axis=1)
    leaves = (axis < INSIDE) & np.any(np.isneginf(ends), axis=1)
    local = np.where((leaves & np.isneginf(ends[:, 0]))[:, None], far, local)
    axis[leaves] = AT_NODE
    return Patch(np.column_stack([blocks[block] + local, axis]), found - node, ends, faces)
