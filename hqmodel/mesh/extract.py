"""Triangles of blocks by marching cubes (see `cubes`), every vertex named by its grid edge.

Only nodes of the blocks are sampled, each once, and only cells of the blocks looked at. Vertices are told apart by the edge they
lie on, never by rounding coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .cubes import AMBIGUOUS, CORNERS, EDGES, FACES, triangles
from .cull import Blocks
from .grid import ALONG, BLOCK, Grid
from .mesh import Array, Triangles, slices
from .sampling import CUBE, Indices, Numbers, Samples, Sampling
from .sheets import moves

AT_NODE = 3


def _lattice(count: int) -> Numbers:
    steps = np.arange(count)
    return np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)


# A block has nodes of its own, all but those on its far sides, which are its neighbours'.
_OWN = _lattice(BLOCK)
_ALL = _lattice(BLOCK + 1)
_STRIDES = np.array([(BLOCK + 1) ** 2, BLOCK + 1, 1])
_EDGE_AXIS = np.array([axis for _, axis in EDGES])
_EDGE_NODE = CORNERS[[corner for corner, _ in EDGES]] @ _STRIDES
# Nodes sampled at once: what stays in a processor's cache.
_CHUNK = 1 << 15


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles and the edges that their vertices lie on, each once.

    `node` (V, 3) and `axis` (V,): the first node of the grid's edge and the axis that it runs along; `AT_NODE` for the node
    itself, where an edge without length leaves a cut. `ends` (V, 2): the samples at both nodes, positive inside. `aside`
    (V, 2, 3): how far both have moved, in cells; None where none has. `pinched` (V,) tells those on faces of cells that are
    inside at two opposite corners only: where edges with four triangles may arise. `shared` (V,) tells those that other blocks
    may have too.
    """

    node: Numbers
    axis: Numbers
    ends: Samples
    aside: Array | None
    pinched: NDArray[np.bool_]
    shared: NDArray[np.bool_]
    faces: Triangles

    def keys(self, grid: Grid) -> Numbers:
        """One number for each of the grid's edges, (V,)."""
        _, ny, nz = (len(nodes) for nodes in grid.nodes)
        x, y, z = self.node.T
        return ((x * ny + y) * nz + z) * (AT_NODE + 1) + self.axis


def extract(blocks: Blocks, sampling: Sampling) -> Patch | None:
    """The surface in blocks (n, 3), given by their first nodes; None where there is none."""
    nodes = _Nodes(blocks)
    samples = nodes.sampled(sampling)
    nodes.into_sheets(samples, sampling)
    inside = (samples > 0).view(np.uint8).take(nodes.of_block)
    case = _cases(inside).ravel()
    cells = np.flatnonzero((case > 0) & (case < 255))
    if not len(cells):
        return None
    case = case.take(cells)
    block = cells // len(_OWN)
    first = block * len(_ALL) + (_OWN @ _STRIDES).take(cells - block * len(_OWN))
    joined, unclear = _joined(case, first, nodes, samples, sampling)
    near, far, axis, number = _vertices(nodes, inside)
    rim = nodes.rim()
    shared = np.logical_or.reduce([rim[i].take(near) & (axis != i) for i in range(3)])
    marked = np.zeros(len(samples), dtype=bool)
    marked[unclear] = True
    faces = _faces(nodes, number, first, case + joined.astype(np.intp) * 256)
    ends = np.stack([samples.take(near), samples.take(far)]).T
    leaves = np.isneginf(ends[:, 0]) | np.isneginf(ends[:, 1])
    shared[leaves] = rim[:, near[leaves]].any(axis=0) | rim[:, far[leaves]].any(axis=0)
    pinched = (marked.take(near) & marked.take(far)) | leaves
    aside = nodes.aside(near, far)
    return _without_length(Patch(nodes.named(near), axis, ends, aside, pinched, shared, faces), leaves)


class _Nodes:
    """Room for the nodes of blocks (n, 3), each once: block by block, those of neighbours on their far sides included.

    `of_block` (n, 125) tells where those of each block are, in the order of their coordinates.
    """

    def __init__(self, blocks: Blocks) -> None:
        numbers = blocks.astype(np.int64) // BLOCK @ ALONG
        every, which = np.unique(numbers[:, None] + CORNERS @ ALONG, return_inverse=True)
        self._first = every // ALONG[:, None] % ALONG[1] * BLOCK
        self._beside = which.reshape(-1, 8)  # each block's place among all, and those of its neighbours on the far sides
        own = _ALL % BLOCK @ np.array([BLOCK**2, BLOCK, 1])
        self.of_block = np.take(self._beside.astype(np.int32), _ALL // BLOCK @ np.array([4, 2, 1]), axis=1)
        self.of_block *= len(_OWN)
        self.of_block += own.astype(np.int32)
        self._shift: Array | None = None  # of each place, (places, 3), in cells
        self._found = np.zeros(len(self), dtype=bool)

    def __len__(self) -> int:
        return self._first.shape[1] * len(_OWN)

    def named(self, places: NDArray[np.integer[Any]]) -> Numbers:
        """The nodes (n, 3) at places (n,)."""
        slot = places // len(_OWN)
        own = places - slot * len(_OWN)
        return np.stack([first.take(slot) + step.take(own) for first, step in zip(self._first, _OWN.T, strict=True)]).T

    def into_sheets(self, samples: Samples, sampling: Sampling) -> None:
        """Move nodes into sheets that the samples (places,) don't see, and have them see these, in place."""
        found = moves(self.of_block, samples, self.named, sampling)
        if found is not None and len(found.places):
            self._shift = np.zeros((len(self), 3))
            self._shift[found.places, found.axis] = found.shift
            self._found[found.places] = (samples[found.places] > 0) != (found.samples > 0)
            samples[found.places] = found.samples

    def aside(self, near: Indices, far: NDArray[np.int32]) -> Array | None:
        """How far the nodes at places (n,) each have moved, (n, 2, 3); None where none has."""
        return None if self._shift is None else np.stack([self._shift[near], self._shift[far]], axis=1)

    def middle(self, one: Indices, other: Indices) -> Array:
        """The numbers (n, 3) of the middles between nodes at places (n,) each."""
        middle = (self.named(one) + self.named(other)) / 2
        return middle if self._shift is None else middle + (self._shift[one] + self._shift[other]) / 2

    def in_sheets(self, one: Indices, other: Indices) -> NDArray[np.intp]:
        """How many of the nodes at places (n,) each have been moved to the other side of the level, (n,)."""
        return self._found[one].astype(np.intp) + self._found[other]

    def rim(self) -> NDArray[np.bool_]:
        """Whether nodes are on a side beyond which there is no block, by the axis across the side and by place, (3, places)."""
        result = np.zeros((3, len(self)), dtype=bool)
        present = np.zeros((2, self._first.shape[1]), dtype=bool)
        present[1, self._beside[:, 0]] = True
        for axis, steps in enumerate(_ALL.T):
            ahead = self._beside[:, 4 >> axis]
            present[0] = False
            present[0, ahead] = True
            for there, at in ((present[0, self._beside[:, 0]], 0), (present[1, ahead], BLOCK)):
                result[axis, self.of_block[np.ix_(~there, steps == at)]] = True
        return result

    def sampled(self, sampling: Sampling) -> Samples:
        """The field at all nodes of the blocks, by their places."""
        used = np.zeros(len(self), dtype=bool)
        used[self.of_block] = True
        places = np.flatnonzero(used)
        if sampling.by_cube:  # so that few cubes share a chunk
            cube = ALONG @ (self._first // CUBE)
            places = places[np.argsort(cube.take(places // len(_OWN)), kind="stable")]
        result = np.zeros(len(self), dtype=np.float32)
        for start in range(0, len(places), _CHUNK):
            here = places[start : start + _CHUNK]
            result[here] = sampling.at(self.named(here))
        return result


def _cases(inside: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """For every cell which of its corners are inside, as bits, (n, 4, 4, 4), from all nodes of blocks, (n, 125)."""
    inside = inside.reshape(-1, BLOCK + 1, BLOCK + 1, BLOCK + 1)
    case = inside[..., :-1] | inside[..., 1:] << 1
    case = case[:, :, :-1] | case[:, :, 1:] << 2
    return np.asarray(case[:, :-1] | case[:, 1:] << 4)


def _vertices(nodes: _Nodes, inside: NDArray[np.uint8]) -> tuple[Indices, NDArray[np.int32], Numbers, NDArray[np.int32]]:
    """The crossed edges of blocks, each once: the places of both nodes and the axis, (V,) each; and the edges' numbers by axis
    and place, (3, places)."""
    of_block, inside = nodes.of_block.ravel(), inside.ravel()
    number = np.zeros((3, len(nodes)), dtype=np.int32)
    beyond, crossed = np.empty(len(nodes), dtype=np.int32), np.zeros(len(nodes), dtype=bool)
    near, far = list[Indices](), list[NDArray[np.int32]]()
    count = 0
    for axis in range(3):
        stride = _STRIDES[axis]
        differ = np.append(inside[:-stride] != inside[stride:], np.zeros(stride, dtype=bool)).reshape(-1, len(_ALL))
        edges = np.flatnonzero(differ & (_ALL[:, axis] < BLOCK))
        start = of_block.take(edges)
        beyond[start] = of_block.take(edges + stride)
        crossed[start] = True
        near.append(np.flatnonzero(crossed))
        crossed[start] = False
        far.append(beyond.take(near[-1]))
        number[axis, near[-1]] = np.arange(count, count + len(near[-1]))
        count += len(near[-1])
    return np.concatenate(near), np.concatenate(far), np.repeat(np.arange(3), [len(found) for found in near]), number


def _without_length(patch: Patch, leaves: NDArray[np.bool_]) -> Patch:
    """The patch with the ends of cuts closed up: edges that leave it, (V,), have no length."""
    if not leaves.any():
        return patch
    node = patch.node + (np.isneginf(patch.ends[:, :1]) & (patch.axis[:, None] == np.arange(3)))
    axis = np.where(leaves, AT_NODE, patch.axis)
    _, kept, number = np.unique(np.column_stack([node, axis]), axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1).astype(np.int32)[patch.faces]
    a, b, c = faces.T
    with_length = (a != b) & (b != c) & (c != a)
    aside = patch.aside
    if aside is not None:
        aside = np.where(np.isneginf(patch.ends[:, :1, None]), aside[:, ::-1], aside)[kept]
    return Patch(node[kept], axis[kept], patch.ends[kept], aside, patch.pinched[kept], patch.shared[kept], faces[with_length])


def _joined(
    case: NDArray[np.uint8], first: Indices, nodes: _Nodes, samples: Samples, sampling: Sampling
) -> tuple[NDArray[np.uint8], Indices]:
    """For each cell the ambiguous faces, as bits, whose inside corners are joined. Besides, the places of all such corners.

    They are where the middle between them is inside, or that between the others, if these have been moved into a groove. A
    sheet's last corner is joined to the body beyond, and a groove's to the space there.
    """
    unclear = np.flatnonzero(AMBIGUOUS.take(case))
    which = [unclear[AMBIGUOUS[case[unclear]] >> face & 1 > 0] for face in range(len(FACES))]
    corners = [first[rows] + (CORNERS[list(ring)] @ _STRIDES)[:, None] for ring, rows in zip(FACES, which, strict=True)]
    seen = nodes.of_block.ravel()[np.concatenate(corners, axis=1)]
    a, b, c, d = seen
    a, c, b, d = np.where(samples.take(a) > 0, [a, c, b, d], [b, d, a, c])
    inside, outside = nodes.in_sheets(a, c), nodes.in_sheets(b, d)
    groove = outside > inside
    joined = sampling.at(nodes.middle(np.where(groove, b, a), np.where(groove, d, c))) > 0
    joined = np.where(inside == 1, (outside != 1) | joined, joined & (outside != 1))
    bits = np.repeat(1 << np.arange(len(FACES)), [len(rows) for rows in which])
    result = np.zeros(len(case), dtype=np.uint8)
    np.bitwise_or.at(result, np.concatenate(which)[joined], bits[joined].astype(np.uint8))
    return result, seen.ravel()


def _faces(nodes: _Nodes, number: NDArray[np.int32], first: Indices, code: Indices) -> Triangles:
    """The triangles (F, 3) of cells by the numbers of their edges, (3, places).

    `code` (n,) is a cell's case and its joined faces as further bits, `first` (n,) where in `nodes.of_block` its first node is.
    """
    kinds = np.flatnonzero(np.bincount(code))
    tables = [triangles(int(kind) % 256, int(kind) // 256) for kind in kinds]
    counts, edges = np.array([len(table) for table in tables]), np.concatenate(tables).astype(np.intp)
    starts = np.cumsum(counts) - counts
    kind_of = np.zeros(kinds[-1] + 1, dtype=np.intp)
    kind_of[kinds] = np.arange(len(kinds))
    place, by_place = nodes.of_block.ravel(), number.ravel()
    faces = []
    for here in slices(len(code)):
        kind = kind_of.take(code[here])
        count = counts.take(kind)
        cell = np.repeat(np.arange(len(kind)), count)
        edge = edges.take(np.arange(len(cell)) + (starts.take(kind) - np.cumsum(count) + count).take(cell))
        at = place.take(first[here].take(cell) + _EDGE_NODE.take(edge))
        faces.append(by_place.take(_EDGE_AXIS.take(edge) * len(nodes) + at))
    return np.concatenate(faces).reshape(-1, 3)
