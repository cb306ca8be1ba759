"""The faces about edges that are to be collapsed: whether what is left is still a surface, and a fair one.

Corners are counted through all the first corners of the faces (3, F), then all the second and all the third ones. An edge is
told by the corner that it starts at.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray

from .mesh import Array, Triangles, crosses, dots

Bits = NDArray[np.uint8]
Bools = NDArray[np.bool_]
Corners = NDArray[np.int64]
Numbers = NDArray[np.int32]
Near = Callable[[Array, Array, Array], Bools]

# No face turns by more than this, and no angle falls below this unless a sharper one was near.
_TURN = cos(radians(80.0))
_SHARPEST = sin(radians(1.0))
# Not even then does it fall below this.
_LEAST = 1e-6
_AT_ONCE = 1 << 13


def following(corners: Corners, faces: Numbers, steps: int = 1) -> Corners:
    """The corners so many steps after others in their faces (3, F)."""
    return (corners + steps * faces.shape[1]) % faces.size


def closed(faces: Triangles, planes: Bits, still: Callable[[], None]) -> tuple[Numbers, Corners]:
    """Faces (F, 3) as columns, and after them a cone's over the border, whose apex, the last of each, is one more vertex.

    And the vertices about which that is no surface, or would not be together with its image in mirror planes: `planes` (V,)
    has a bit for each that a vertex lies in. Only there may the border be. `still` is called now and then.
    """
    apex = np.int64(len(planes))
    start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    forth, back = np.sort(start * apex + end), np.sort(end * apex + start)
    still()
    border = forth[np.take(back, np.searchsorted(back, forth), mode="clip") != forth]
    a, b = np.divmod(border, apex)
    stray = (planes[a] & planes[b] == 0) | (np.bincount(a, minlength=apex)[a] > 1) | (np.bincount(b, minlength=apex)[b] > 1)
    still()
    flush = planes[start] & planes[end] > 0
    start, end = start[flush], end[flush]
    inner = np.intersect1d(start * apex + end, end * apex + start)
    odd = np.concatenate([forth[1:][forth[1:] == forth[:-1]], border[stray], inner])
    cone = np.stack([b, a, np.full(len(a), apex)]).astype(np.int32)
    return np.concatenate([faces.T, cone], axis=1), np.concatenate(np.divmod(odd, apex))


def apart(faces: Numbers, edges: Corners, count: int) -> tuple[Corners, Numbers]:
    """Some of edges, given cheapest first, that are the cheapest at both their ends and have no face about them in common.

    Also the number of the edge that each of `count` vertices ends, or -1.
    """
    vertex, none = faces.ravel(), len(edges)
    start, end = vertex[edges], vertex[following(edges, faces)]
    rank = np.arange(none, dtype=np.int32)
    ends = np.full(count, none, dtype=np.int32)
    np.minimum.at(ends, start, rank)
    np.minimum.at(ends, end, rank)
    free = (ends[start] == rank) & (ends[end] == rank)
    ends[:] = none
    ends[start[free]] = ends[end[free]] = rank[free]
    lower, higher = _meeting(ends[faces], none)
    chosen = np.zeros(none, dtype=bool)
    while free.any():
        beaten = np.zeros(none, dtype=bool)
        beaten[higher[free[lower] & free[higher]]] = True
        chosen |= free & ~beaten
        beaten[higher[chosen[lower]]] = False
        free = beaten
    ends[:] = -1
    ends[start[chosen]] = ends[end[chosen]] = rank[: np.count_nonzero(chosen)]
    return edges[chosen], ends


def _meeting(numbers: Numbers, none: int) -> tuple[Numbers, Numbers]:
    """The lower and the higher of each two numbers in a column (3, n), `none` not being one."""
    pairs = []
    for i in range(3):
        low, high = np.minimum(numbers[i], numbers[i - 1]), np.maximum(numbers[i], numbers[i - 1])
        meet = (low < high) & (high < none)
        pairs.append((low[meet], high[meet]))
    return np.concatenate([low for low, _ in pairs]), np.concatenate([high for _, high in pairs])


@dataclass(frozen=True, eq=False)
class Stars:
    """The faces about E edges, no face about two of them.

    Faces that stay: `corner` (n,) at an end of the edge numbered `edge` (n,), and the `vertices` (3, n) from that corner on.
    Faces that go: the vertices that lie `along` the edge (E, 2) and those `across` it (E, 2). `lost` (E, 2) are those faces.
    """

    apex: int
    corner: Corners
    edge: Numbers
    vertices: Numbers
    lost: Corners
    along: Numbers
    across: Numbers

    @classmethod
    def of(cls, faces: Numbers, ends: Numbers) -> Stars:
        """Faces (3, F) about edges, `ends` (V + 1,) being the number of the edge that each vertex ends, or -1."""
        vertex = faces.ravel()
        ends_at = ends[vertex]
        corner = np.flatnonzero(ends_at >= 0)
        after, before = following(corner, faces), following(corner, faces, 2)
        edge = ends_at[corner]
        starts = ends_at[after] == edge
        stays = ~starts & (ends_at[before] != edge)
        lost = corner[starts][np.argsort(edge[starts], kind="stable")].reshape(-1, 2)
        return cls(
            len(ends) - 1,
            corner[stays],
            edge[stays],
            vertex[np.stack([corner[stays], after[stays], before[stays]])],
            lost % faces.shape[1],
            vertex[lost],
            vertex[following(lost, faces, 2)],
        )

    def simple(self) -> Bools:
        """Where the surface stays one, (E,): the ends have only the vertices across in common, and make no tetrahedron
        with them."""
        count = len(self.across)
        edges = np.concatenate([self.edge, np.repeat(np.arange(count), 2)])
        # Each end's neighbours, but for the other end, once each.
        keys = np.sort(edges * np.int64(self.apex + 1) + np.concatenate([self.vertices[1], self.across.ravel()]))
        common = np.bincount(keys[1:][keys[1:] == keys[:-1]] // (self.apex + 1), minlength=count)
        one, other = self.across[self.edge].T
        _, after, before = self.vertices
        beyond = ((after == one) & (before == other)) | ((after == other) & (before == one))
        return (common == 2) & (np.bincount(self.edge[beyond], minlength=count) < 2)

    def fair(self, points: Array, merged: Array, which: Bools) -> Bools:
        """Which of some edges, (E,), can be merged in points (E, 3) without faces that turn over or become slivers."""
        before, after = np.ones(len(merged)), np.ones(len(merged))
        for some in self._real(which):
            edge = self.edge[some]
            p, a, b = (points.take(vertices[some], axis=0) for vertices in self.vertices)
            old, sharp = _shape(p, a, b)
            new, sharper = _shape(merged.take(edge, axis=0), a, b)
            sharper[~(dots(old, new) > _TURN * np.sqrt(dots(old, old) * dots(new, new)))] = 0.0
            np.minimum.at(before, edge, sharp)
            np.minimum.at(after, edge, sharper)
        rows = np.flatnonzero(which & (after < _SHARPEST**2))
        for across in self.across[rows].T:
            a, b = points[self.along[rows].T]
            before[rows] = np.minimum(before[rows], _shape(a, b, points[across])[1])
        return which & (after >= np.clip(before, _LEAST**2, _SHARPEST**2))

    def near(self, points: Array, merged: Array, which: Bools, near: Near) -> Bools:
        """Which of some edges, (E,), can be merged in points (E, 3) with faces that are all `near`, as told of corners (n, 3)."""
        result = which.copy()
        for some in self._real(which):
            _, a, b = self.vertices[:, some]
            edge = self.edge[some]
            result[edge[~near(merged.take(edge, axis=0), points.take(a, axis=0), points.take(b, axis=0))]] = False
        return result

    def _real(self, which: Bools) -> list[NDArray[np.intp]]:
        """The faces that stay about some edges, (E,), less the cone's; so many at once."""
        real = np.flatnonzero(which[self.edge] & np.all(self.vertices[1:] != self.apex, axis=0))
        return np.array_split(real, len(real) // _AT_ONCE + 1)


def _shape(a: Array, b: Array, c: Array) -> tuple[Array, Array]:
    """Normals (n, 3) of triangles as long as twice their areas, and the square of the sine of the smallest angle."""
    u, v, w = b - a, c - a, c - b
    normal = crosses(u, v)
    x, y, z = dots(u, u), dots(v, v), dots(w, w)
    longest = np.maximum(np.maximum(x * y, y * z), z * x)
    return normal, dots(normal, normal) / np.maximum(longest, 1e-300)
