"""Fewer triangles for the same surface: edges collapse to points, those first that are missed least.

Collapses are done in rounds, many at once: no two of a round share a face, so each finds the mesh as if it were alone. Where
the mesh ends, at mirror planes, a cone of faces over its border closes it, so that every edge has two faces. Nothing
collapses into the cone's apex.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np

from .mesh import Array, Triangles, dots
from .quadrics import area, error, least, quadrics
from .stars import Bits, Bools, Corners, Near, Numbers, Stars, apart, closed, following

Place = Callable[[Array, Bools], Array]

# The cheapest share of all edges that a round looks at, and how many at most for each face that is still to go.
_SHARE = 0.1
_AHEAD = 6
# Costs within a round are made uneven by up to this share: edges of a flat part, which all cost the same, would otherwise be
# cheapest in a row, one after another.
_UNEVEN = 0.3
_GOLDEN = (5**0.5 - 1) / 2
# What the spread of the area that a vertex stands for counts for against the distance from its planes. It keeps the flat
# parts evenly meshed.
_SPREAD = 1e-4
# How many times as far from the surface faces may come to lie as, in the root mean square, a vertex from its planes.
_WORST = 2.5
_AT_ONCE = 1 << 13
# What is known of a vertex: the coordinates held, the mirror planes it lies in, whether it is within a flat part all whose
# vertices are held, whether it stays as it is.
_HELD, _PLANES, _WITHIN, _LOCKED = (np.uint8(bits) for bits in (0b111, 0b111 << 3, 1 << 6, 1 << 7))
_AXES = np.array([1, 2, 4], dtype=np.uint8)


def simplified(
    vertices: Array,
    faces: Triangles,
    target: int,
    held: Bools,
    mirrored: tuple[int, ...] = (),
    place: Place | None = None,
    most: float = inf,
    near: Near | None = None,
    still: Callable[[], None] = lambda: None,
    left: Callable[[int], None] = lambda faces: None,
) -> tuple[Array, Triangles]:
    """Vertices and faces of a mesh, (V, 3) and (F, 3), with `target` faces or one less; with more where that can't be reached.

    A coordinate that is `held`, (V, 3), stays, also in what its vertex is merged into. The mesh may end where a coordinate is
    0 along the axes `mirrored`; its image in those planes joins on soundly if it did before. Where the mesh is no surface it
    is left alone. Bodies, holes and orientation are kept.

    `place` brings points (n, 3) onto the surface and leaves held coordinates, (n, 3), alone; points within a flat part all
    whose vertices are held are not asked for. `most` is about how far faces may come to lie from the surface, in the unit of
    the mesh. `near` tells which triangles, by their corners (n, 3) each, lie near enough to the surface to be made.
    `still` is called again and again, `left` with how many faces there are after each round; whatever they raise ends the work.
    """
    work = _Work.of(vertices, faces, held, mirrored, most, still)
    changed = True
    while (surplus := work.count - target) > 0:
        left(work.count)
        edges = work.cheapest(surplus)
        if len(edges):
            changed |= work.collapse(edges, surplus, place, near)
        elif changed:
            work.price(np.arange(work.faces.size))  # what could not be collapsed may be by now
            changed = False
        else:
            break
    return work.result()


@dataclass(eq=False)
class _Work:
    """A mesh that shrinks. The last of the vertices is the apex; `faces` (3, F) has the cone's at the end, apex last.

    `cost` (3, F) is of the edge from each corner to the next. It is given once for each edge, where the start has the smaller
    number; it is infinite elsewhere, and for edges that can't be collapsed.
    """

    points: Array
    quadrics: Array
    kind: Bits
    faces: Numbers
    cost: Array
    centre: Array
    worst: float
    still: Callable[[], None]
    share: float = _SHARE

    @classmethod
    def of(
        cls, vertices: Array, faces: Triangles, held: Bools, mirrored: tuple[int, ...], most: float, still: Callable[[], None]
    ) -> _Work:
        """The mesh as it is given."""
        kind = np.append(_kinds(vertices, faces, held, mirrored), _LOCKED)
        still()
        whole, odd = closed(faces, kind[:-1] & _PLANES, still)
        kind[odd] |= _LOCKED
        centre = vertices.mean(axis=0)
        points = np.concatenate([vertices, centre[None]])
        forms = quadrics(points - centre, faces, still)
        work = cls(points, forms, kind, whole, np.empty(whole.shape), centre, (most / _WORST) ** 2, still)
        work.price(np.arange(whole.size))
        return work

    @property
    def count(self) -> int:
        """Faces without the cone's."""
        return int(np.count_nonzero(self.faces[2] != len(self.kind) - 1))

    def price(self, edges: Corners) -> None:
        """Work out what edges cost."""
        vertex, cost = self.faces.ravel(), self.cost.ravel()
        for some in np.array_split(edges, len(edges) // _AT_ONCE + 1):
            self.still()
            start, end = vertex[some], vertex[following(some, self.faces)]
            rows = np.flatnonzero((start < end) & self._allowed(start, end))
            cost[some] = inf
            cost[some[rows]] = self.merged(start[rows], end[rows])[1]

    def _allowed(self, start: Numbers, end: Numbers) -> Bools:
        """Whether one end holds all that the other does, in the same place, and both lie in the same mirror planes."""
        one, other = self.kind[start], self.kind[end]
        both = one & other & _HELD
        nested = (both == one & _HELD) | (both == other & _HELD)
        allowed = nested & ((one ^ other) & _PLANES == 0) & (one | other < _LOCKED)
        rows = np.flatnonzero(allowed & (both > 0))
        apart = self.points[start[rows]] != self.points[end[rows]]
        allowed[rows] = ~np.any(apart & _unpacked(both[rows]), axis=1)
        return allowed

    def merged(self, start: Numbers, end: Numbers) -> tuple[Array, Array]:
        """Where the ends of edges are best merged, (n, 3), and what that costs, (n,)."""
        p, q = self.points.take(start, axis=0), self.points.take(end, axis=0)
        one, other = self.quadrics.take(start, axis=0), self.quadrics.take(end, axis=0)
        held, also_held = _unpacked(self.kind[start]), _unpacked(self.kind[end])
        way, share = q - p, area(other) / area(one + other)
        middle = np.where(held, p, np.where(also_held, q, p + way * share[:, None]))
        total, length = area(one + other), dots(way, way)
        step, off = least(one + other, middle - self.centre, ~(held | also_held), _SPREAD * total, length)
        spread = _SPREAD * total * (dots(step, step) + share * (1 - share) * length)
        return middle + step, np.where(off <= self.worst * total, np.maximum(off, 0.0) + spread, inf)

    def cheapest(self, left: int) -> Corners:
        """The edges that a round looks at, about cheapest first, when so many faces are still to go."""
        cost = self.cost.ravel()
        count = min(int(self.share / 2 * cost.size), _AHEAD * left + 100)
        limit = np.partition(cost, count)[count] if count < cost.size else inf
        found = np.flatnonzero((cost <= limit) & (cost < inf))
        uneven = 1 + _UNEVEN * (found * _GOLDEN % 1)
        return found[np.argsort(cost[found] * uneven, kind="stable")]

    def collapse(self, edges: Corners, left: int, place: Place | None, near: Near | None) -> bool:
        """Collapse some of edges, cheapest first, until so many faces are gone; whether any could be."""
        vertex = self.faces.ravel()
        dearest = float(self.cost.ravel()[edges].max())
        edges, ends = apart(self.faces, edges, len(self.kind))
        start, end = vertex[edges], vertex[following(edges, self.faces)]
        self.still()
        stars = Stars.of(self.faces, ends)
        self.still()
        points, good = self._settled(stars, start, end, dearest, place, near)
        self.cost.ravel()[edges[~good]] = inf
        takes = np.where(good, np.count_nonzero(stars.across != stars.apex, axis=1), 0)
        good &= np.cumsum(takes) - takes < left
        self.kind[start[good]] = self._joined(start[good], end[good])
        self.points[start[good]] = points[good]
        self.quadrics[start[good]] += self.quadrics[end[good]]
        moved = good[stars.edge]
        corner = stars.corner[moved]
        vertex[corner] = start[stars.edge[moved]]
        self.price(np.concatenate([corner, following(corner, self.faces, 2)]))
        self.still()
        keep = np.ones(self.faces.shape[1], dtype=bool)
        keep[stars.lost[good]] = False
        self.faces, self.cost = self.faces.compress(keep, axis=1), self.cost.compress(keep, axis=1)
        self.share = _SHARE if np.mean(good) > 0.5 else min(1.0, 2 * self.share)
        return bool(good.any())

    def _settled(
        self, stars: Stars, start: Numbers, end: Numbers, dearest: float, place: Place | None, near: Near | None
    ) -> tuple[Array, Bools]:
        """Where the ends of edges are merged, (E, 3), and whether they can be, (E,).

        In the best place, or else in one of the ends where that costs no more than the dearest edge of the round.
        """
        kind = self._joined(start, end)
        best, _ = self.merged(start, end)
        if place is not None:
            asked = kind & _WITHIN == 0
            self.still()
            found = place(best[asked], _unpacked(kind[asked]))
            way, length = found - best[asked], self.points[end[asked]] - self.points[start[asked]]
            best[asked] = np.where((dots(way, way) <= dots(length, length))[:, None], found, np.nan)  # not if it strays
        one, other = self.quadrics[start], self.quadrics[end]
        points, good = best, np.zeros(len(start), dtype=bool)
        simple = stars.simple()
        tries = (best, kind, inf), (self.points[start], self.kind[start], dearest), (self.points[end], self.kind[end], dearest)
        for trial, its_kind, limit in tries:
            self.still()
            off, also_off = error(one, trial - self.centre), error(other, trial - self.centre)
            cheap = (off <= self.worst * area(one)) & (also_off <= self.worst * area(other)) & (off + also_off <= limit)
            may = stars.fair(self.points, trial, simple & ~good & (its_kind == kind) & cheap)
            if near is not None:
                may = stars.near(self.points, trial, may, near)
            points = np.where(may[:, None], trial, points)
            good |= may
        return points, good

    def _joined(self, start: Numbers, end: Numbers) -> Bits:
        one, other = self.kind[start], self.kind[end]
        return (one | other) & ~_WITHIN | (one & other & _WITHIN)

    def result(self) -> tuple[Array, Triangles]:
        """Vertices and faces, without the cone and what isn't used."""
        faces = self.faces[:, self.faces[2] != len(self.kind) - 1]
        used = np.zeros(len(self.kind), dtype=bool)
        used[faces] = True
        number = (np.cumsum(used) - 1).astype(np.int32)
        return self.points[used], np.ascontiguousarray(number[faces].T)


def _kinds(vertices: Array, faces: Triangles, held: Bools, mirrored: tuple[int, ...]) -> Bits:
    """What is known of vertices from the start, (V,)."""
    planes = (vertices == 0) & np.isin(np.arange(3), mirrored)
    kind = _packed(held | planes) | _packed(planes) << np.uint8(3)
    common = kind[faces[:, 0]] & kind[faces[:, 1]] & kind[faces[:, 2]] & _HELD
    flat = common > 0
    corners = vertices[faces[flat]]
    flat[flat] = np.any(_unpacked(common[flat]) & np.all(corners == corners[:, :1], axis=1), axis=1)
    within = np.ones(len(vertices), dtype=bool)
    within[faces[~flat]] = False
    kind[within] |= _WITHIN
    return kind


def _packed(flags: Bools) -> Bits:
    """Flags (n, 3) as the lowest bits."""
    return flags.view(np.uint8) @ _AXES


def _unpacked(bits: Bits) -> Bools:
    """The lowest bits as flags (n, 3)."""
    return bits[:, None] & _AXES > 0
