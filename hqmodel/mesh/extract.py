"""Triangles of blocks of cells by marching cubes (see `cubes`), every vertex named by its grid edge.

Only nodes of the blocks are sampled, each once, and only cells of the blocks looked at. Vertices are told apart by the edge they
lie on, never by rounding coordinates.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .compiled import compiled
from .cubes import AMBIGUOUS, CORNERS, EDGES, FACES, tables
from .cull import Blocks
from .grid import BLOCK, Grid
from .mesh import Array, Triangles

AT_NODE = 3
Samples = NDArray[np.float32]
Numbers = NDArray[np.int64]
Nodes = NDArray[np.int32]
Axes = NDArray[np.int8]
_EDGES, _FACES = np.array(EDGES), np.array(FACES)


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles and the edges that their vertices lie on, each once.

    `node` (V, 3) and `axis` (V,): the first node of the grid's edge and the axis that it runs along; `AT_NODE` for the node
    itself, where an edge without length leaves a cut. `ends` (V, 2): the samples at both nodes, positive inside. `pinched` (V,)
    tells those on faces of cells that are inside at two opposite corners only: where edges with four triangles may arise.
    """

    node: Nodes
    axis: Axes
    ends: Samples
    pinched: NDArray[np.bool_]
    faces: Triangles

    def keys(self, grid: Grid) -> Numbers:
        """One number for each of the grid's edges, (V,), rising with the first coordinate."""
        layer, row, step = grid.strides
        x, y, z = self.node.T.astype(np.int64)
        return x * layer + y * row + z * step + self.axis


def extract(blocks: Blocks, grid: Grid, field: Callable[[Array], Samples]) -> Patch | None:
    """The level set 0 of a field, positive inside, in blocks whose first nodes are `blocks` (n, 3), near to each other.

    `field` is its value at points (m, 3), never 0; beyond a cut all is outside. None where there is no surface.
    """
    origin = np.min(blocks, axis=0)
    first, shape = blocks - origin, np.max(blocks, axis=0) - origin + BLOCK + 1
    strides, table = np.array([shape[1] * shape[2], shape[2], 1]), tables()
    lattice, corners = _lattice.of(int(np.prod(shape))), CORNERS @ strides
    x, y, z = (nodes[start : start + count] for nodes, start, count in zip(grid.nodes, origin, shape, strict=True))
    most = len(first) * (BLOCK + 1) ** 3
    nodes, points = np.empty(most, dtype=np.int32), np.empty((3, most))
    found = _gather(first, x, y, z, strides, lattice, nodes, points)
    nodes, points = nodes[:found], points[:, :found]
    samples = field(points.T)
    if grid.cuts:
        samples[_beyond(grid, np.stack(np.unravel_index(nodes, shape)).T + origin)] = -np.inf
    cells, kind = np.empty((2, len(first) * BLOCK**3), dtype=np.int32)
    unclear = np.zeros(found, dtype=bool)
    crossed, count = _classify(
        first, strides, lattice, samples, corners, corners[_FACES], AMBIGUOUS, table.number, unclear, cells, kind
    )
    faces, vertices = np.empty((count, 3), dtype=np.int32), np.empty(3 * found, dtype=np.int32)
    number = np.zeros((3, found), dtype=np.int32)
    there = _triangulate(
        cells[:crossed], kind[:crossed], corners, lattice, _EDGES, table.edges, table.start, table.number, number, vertices, faces
    )
    node, axis = np.empty((there, 3), dtype=np.int32), np.empty(there, dtype=np.int8)
    ends, pinched = np.empty((there, 2), dtype=np.float32), np.empty(there, dtype=bool)
    _describe(vertices[:there], nodes, origin, strides, lattice, samples, unclear, node, axis, ends, pinched)
    lattice[nodes] = 0
    if not crossed:
        return None
    patch = Patch(node, axis, ends, pinched, faces)
    return _without_length(patch) if grid.cuts else patch


@compiled
def _gather(
    first: Numbers,
    x: Array,
    y: Array,
    z: Array,
    strides: Numbers,
    lattice: Nodes,
    nodes: Nodes,
    points: Array,
) -> int:
    """The nodes of the blocks, each once, and where they lie; how many they are. The lattice tells the number of each, plus 1."""
    found = 0
    for b in range(len(first)):
        for i in range(first[b, 0], first[b, 0] + BLOCK + 1):
            for j in range(first[b, 1], first[b, 1] + BLOCK + 1):
                for k in range(first[b, 2], first[b, 2] + BLOCK + 1):
                    node = i * strides[0] + j * strides[1] + k
                    if lattice[node] == 0:
                        nodes[found], points[0, found], points[1, found], points[2, found] = node, x[i], y[j], z[k]
                        found += 1
                        lattice[node] = found
    return found


@compiled
def _classify(
    first: Numbers,
    strides: Numbers,
    lattice: Nodes,
    samples: Samples,
    corners: Numbers,
    rings: Numbers,
    ambiguous: NDArray[np.uint8],
    count: Numbers,
    unclear: NDArray[np.bool_],
    cells: Nodes,
    kind: Nodes,
) -> tuple[int, int]:
    """The cells of the blocks that the surface crosses, by their first nodes, with their case and the faces whose inside corners
    are joined, as 64 case + joined; how many they are, and how many triangles they have. Corners of ambiguous faces are marked
    `unclear`; joined are those faces whose saddle is inside.
    """
    crossed = triangles = 0
    for b in range(len(first)):
        for i in range(first[b, 0], first[b, 0] + BLOCK):
            for j in range(first[b, 1], first[b, 1] + BLOCK):
                for k in range(first[b, 2], first[b, 2] + BLOCK):
                    cell = i * strides[0] + j * strides[1] + k
                    case = 0
                    for corner in range(8):
                        case |= (samples[lattice[cell + corners[corner]] - 1] > 0) << corner
                    if case == 0 or case == 255:
                        continue
                    joined = 0
                    for face in range(6):
                        if ambiguous[case] >> face & 1:
                            ring = lattice[cell + rings[face]] - 1
                            unclear[ring] = True
                            even, odd = samples[ring[0]] * samples[ring[2]], samples[ring[1]] * samples[ring[3]]
                            if even != odd and (even > odd) == (samples[ring[0]] > 0):
                                joined |= 1 << face
                    cells[crossed], kind[crossed] = cell, 64 * case + joined
                    crossed += 1
                    triangles += count[case, joined]
    return crossed, triangles


@compiled
def _triangulate(
    cells: Nodes,
    kind: Nodes,
    corners: Numbers,
    lattice: Nodes,
    ends: Numbers,
    edges: Numbers,
    start: Numbers,
    count: Numbers,
    number: Nodes,
    vertices: Nodes,
    faces: Triangles,
) -> int:
    """The triangles of cells, into `faces`, and their vertices, as 4 node + axis with nodes as the lattice numbers them; how many
    these are."""
    found = face = 0
    for n in range(len(cells)):
        case, joined = kind[n] >> 6, kind[n] & 63
        at = start[case, joined]
        for _ in range(count[case, joined]):
            for i in range(3):
                corner, axis = ends[edges[at], 0], ends[edges[at], 1]
                node = lattice[cells[n] + corners[corner]] - 1
                if number[axis, node] == 0:
                    vertices[found] = 4 * node + axis
                    found += 1
                    number[axis, node] = found
                faces[face, i] = number[axis, node] - 1
                at += 1
            face += 1
    return found


@compiled
def _describe(
    vertices: Nodes,
    nodes: Nodes,
    origin: Numbers,
    strides: Numbers,
    lattice: Nodes,
    samples: Samples,
    unclear: NDArray[np.bool_],
    node: Nodes,
    axis: Axes,
    ends: Samples,
    pinched: NDArray[np.bool_],
) -> None:
    """What a patch tells of its vertices."""
    for v in range(len(vertices)):
        near, along = vertices[v] >> 2, vertices[v] & 3
        at = nodes[near]
        far = lattice[at + strides[along]] - 1
        node[v, 0], node[v, 1], node[v, 2] = at // strides[0], at % strides[0] // strides[1], at % strides[1]
        for i in range(3):
            node[v, i] += origin[i]
        axis[v], ends[v, 0], ends[v, 1] = along, samples[near], samples[far]
        pinched[v] = unclear[near] and unclear[far]


class _Lattice(threading.local):
    """Numbers for the nodes of a box, one set a thread, 0 before and after use: so much memory is slow to come by anew."""

    numbers = np.zeros(0, dtype=np.int32)

    def of(self, count: int) -> Nodes:
        """Those of a box of so many nodes."""
        if len(self.numbers) < count:
            self.numbers = np.zeros(count, dtype=np.int32)
        return self.numbers


_lattice = _Lattice()


def _beyond(grid: Grid, nodes: Numbers) -> NDArray[np.bool_]:
    """Whether nodes (n, 3) lie beyond a cut."""
    each = [outside[np.minimum(nodes[:, i], len(outside) - 1)] for i, outside in enumerate(grid.outside)]
    return np.logical_or.reduce(each)


def _without_length(patch: Patch) -> Patch:
    """The patch with the ends of cuts closed up: edges that leave it have no length."""
    node, axis, ends = patch.node, patch.axis, patch.ends
    leaves = np.isneginf(ends[:, 0]) | np.isneginf(ends[:, 1])
    if not leaves.any():
        return patch
    node = node + (np.isneginf(ends[:, :1]) & (axis[:, None] == np.arange(3)))
    axis = np.where(leaves, np.int8(AT_NODE), axis)
    _, kept, number = np.unique(np.column_stack([node, axis]), axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1).astype(np.int32)[patch.faces]
    a, b, c = faces.T
    with_length = (a != b) & (b != c) & (c != a)
    return Patch(node[kept], axis[kept], ends[kept], (patch.pinched | leaves)[kept], faces[with_length])
