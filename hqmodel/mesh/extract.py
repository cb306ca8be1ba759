"""Triangles of blocks by marching cubes (see `cubes`), every vertex named by its grid edge.

Only nodes of the blocks are sampled, each once, and only cells of the blocks looked at. Vertices are told apart by the edge they
lie on, never by rounding coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cubes import AMBIGUOUS, CORNERS, EDGES, FACES, triangles
from .cull import Blocks
from .grid import BLOCK, Grid
from .mesh import Array, Triangles, slices
from .nodes import ALL, OWN, Nodes
from .sampling import Indices, Numbers, Samples, Sampling

AT_NODE = 3
_STRIDES = np.array([(BLOCK + 1) ** 2, BLOCK + 1, 1])
_EDGE_AXIS = np.array([axis for _, axis in EDGES])
_EDGE_NODE = CORNERS[[corner for corner, _ in EDGES]] @ _STRIDES
# A block's own nodes among all of it.
_OWN_ROWS = OWN @ _STRIDES


@dataclass(frozen=True, eq=False)
class Patch:
    """Triangles and the edges that their vertices lie on, each once, in the order of their axes.

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
    nodes = Nodes(blocks)
    samples = nodes.sampled(sampling)
    nodes.into_sheets(samples, sampling)
    inside = nodes.by_block((samples > 0).view(np.uint8))
    case = _cases(inside)
    mixed = (case - np.uint8(1)) < 254
    if not mixed.any():
        return None
    case, first = case[mixed], _among_all(mixed, _OWN_ROWS)
    joined, unclear = _joined(case, first, nodes, samples, sampling)
    near, far, axis, number = _vertices(nodes, inside)
    border = nodes.bordering()
    shared = np.logical_or.reduce([border[i].take(near) & (axis != i) for i in range(3)])
    marked = np.zeros(len(samples), dtype=bool)
    marked[unclear] = True
    faces = _faces(nodes, number, first, case + joined.astype(np.intp) * 256)
    ends = np.stack([samples.take(near), samples.take(far)]).T
    leaves = np.isneginf(ends[:, 0]) | np.isneginf(ends[:, 1])
    shared[leaves] = border[:, near[leaves]].any(axis=0) | border[:, far[leaves]].any(axis=0)
    pinched = (marked.take(near) & marked.take(far)) | leaves
    aside = nodes.aside(near, far)
    return _without_length(Patch(nodes.named(near), axis, ends, aside, pinched, shared, faces), leaves)


def _cases(inside: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """For every cell which of its corners are inside, as bits, (64, n), from all nodes of blocks, (125, n)."""
    inside = inside.reshape(BLOCK + 1, BLOCK + 1, BLOCK + 1, -1)
    case = inside[:, :, :-1] | inside[:, :, 1:] << 1
    case = case[:, :-1] | case[:, 1:] << 2
    return np.asarray(case[:-1] | case[1:] << 4).reshape(len(OWN), -1)


def _among_all(marked: NDArray[np.bool_], rows: Indices) -> Indices:
    """Where the marked ones of some rows (r, n) of the blocks' nodes are among all of them, (125, n)."""
    shift = (rows - np.arange(len(rows))) * marked.shape[1]
    return np.flatnonzero(marked) + np.repeat(shift, np.count_nonzero(marked, axis=1))


def _vertices(nodes: Nodes, inside: NDArray[np.uint8]) -> tuple[Indices, Indices, NDArray[np.int64], NDArray[np.int32]]:
    """The crossed edges of blocks, each once: the places of both nodes and the axis, (V,) each; and the edges' numbers by axis
    and place, (3, places). `inside` (125, n) tells all nodes of the blocks."""

    def crossed(axis: int, rows: Indices) -> tuple[Indices, Indices]:
        start = _among_all(inside[rows] != inside[rows + _STRIDES[axis]], rows)
        end = start + _STRIDES[axis] * nodes.count
        return nodes.of_block.take(start).astype(np.intp), nodes.of_block.take(end).astype(np.intp)

    number = np.zeros((3, len(nodes)), dtype=np.int32)
    beyond = np.empty(len(nodes) - nodes.owned, dtype=np.intp)
    near, far, axes = list[Indices](), list[Indices](), list[NDArray[np.int64]]()
    count = 0
    for axis in range(3):
        start, end = crossed(axis, _OWN_ROWS)
        rim_start, rim_end = crossed(axis, np.flatnonzero((ALL[:, axis] < BLOCK) & (ALL.max(axis=1) == BLOCK)))
        beyond[:] = -1
        on_rim = rim_start >= nodes.owned  # the others are a block's own; of these several blocks may have each
        beyond[rim_start[on_rim] - nodes.owned] = rim_end[on_rim]
        rim = np.flatnonzero(beyond >= 0)
        near += [start, rim + nodes.owned]
        far += [end, beyond[rim]]
        axes.append(np.full(len(start) + len(rim), axis))
        for places in near[-2:]:
            number[axis, places] = np.arange(count, count + len(places))
            count += len(places)
    return np.concatenate(near), np.concatenate(far), np.concatenate(axes), number


def _without_length(patch: Patch, leaves: NDArray[np.bool_]) -> Patch:
    """The patch with the ends of cuts closed up: edges that leave it, (V,), have no length."""
    if not leaves.any():
        return patch
    node = patch.node + (np.isneginf(patch.ends[:, :1]) & (patch.axis[:, None] == np.arange(3)))
    axis = np.where(leaves, AT_NODE, patch.axis)
    _, kept, number = np.unique(np.column_stack([axis, node]), axis=0, return_index=True, return_inverse=True)
    faces = number.reshape(-1).astype(np.int32)[patch.faces]
    a, b, c = faces.T
    with_length = (a != b) & (b != c) & (c != a)
    aside = patch.aside
    if aside is not None:
        aside = np.where(np.isneginf(patch.ends[:, :1, None]), aside[:, ::-1], aside)[kept]
    return Patch(node[kept], axis[kept], patch.ends[kept], aside, patch.pinched[kept], patch.shared[kept], faces[with_length])


def _joined(
    case: NDArray[np.uint8], first: Indices, nodes: Nodes, samples: Samples, sampling: Sampling
) -> tuple[NDArray[np.uint8], Indices]:
    """For each cell the ambiguous faces, as bits, whose inside corners are joined. Besides, the places of all such corners.

    They are where the middle between them is inside, or that between the others, if these have been moved into a groove. A
    sheet's last corner is joined to the body beyond, and a groove's to the space there.
    """
    unclear = np.flatnonzero(AMBIGUOUS.take(case))
    which = [unclear[AMBIGUOUS[case[unclear]] >> face & 1 > 0] for face in range(len(FACES))]
    rings = CORNERS[np.array(FACES)] @ _STRIDES * nodes.count
    corners = [first[rows] + ring[:, None] for ring, rows in zip(rings, which, strict=True)]
    seen = nodes.of_block.reshape(-1)[np.concatenate(corners, axis=1)]
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


def _faces(nodes: Nodes, number: NDArray[np.int32], first: Indices, code: Indices) -> Triangles:
    """The triangles (F, 3) of cells by the numbers of their edges, (3, places).

    `code` (n,) is a cell's case and its joined faces as further bits, `first` (n,) where in `nodes.of_block` its first node is.
    """
    kinds = np.flatnonzero(np.bincount(code))
    tables = [triangles(int(kind) % 256, int(kind) // 256) for kind in kinds]
    counts, edges = np.array([len(table) for table in tables]), np.concatenate(tables).astype(np.intp)
    starts = np.cumsum(counts) - counts
    kind_of = np.zeros(kinds[-1] + 1, dtype=np.intp)
    kind_of[kinds] = np.arange(len(kinds))
    place, by_place = nodes.of_block.reshape(-1), number.reshape(-1)
    edge_node, edge_axis = _EDGE_NODE * nodes.count, _EDGE_AXIS * len(nodes)
    faces = []
    for here in slices(len(code)):
        kind = kind_of.take(code[here])
        count = counts.take(kind)
        cell = np.repeat(np.arange(len(kind)), count)
        edge = edges.take(np.arange(len(cell)) + (starts.take(kind) - np.cumsum(count) + count).take(cell))
        at = place.take(first[here].take(cell) + edge_node.take(edge))
        faces.append(by_place.take(edge_axis.take(edge) + at))
    return np.concatenate(faces).reshape(-1, 3)
