"""Where a plane cuts the body's surface: squares culled by exact bounds, marched, and joined to closed loops.

What bounds cannot rule out but samples do not show is looked at more closely, and where a part turns up that way the whole grid
is made fine enough for it: nothing thicker than `THIN` of the outline's size is missed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Plane, Region, Terms, box_bounds, log_ratio, near_linear, near_linear_gradient

Array = NDArray[np.float64]
Cells = NDArray[np.int64]

# Squares along the longer side: what is always sampled, and the finest that hidden parts are looked for with.
_CELLS, _FINEST = 512, 1 << 15
# Parts thinner than this share of the longer side are left out.
THIN = 1e-5
# Samples no further above their level are rounding, and outside.
_ROUNDING = 1e-13
_BISECTIONS = 48
# The grid's side, by that of the rectangle that holds the outline: no whole number of squares, so that flat sides miss the nodes.
_MARGIN = 1.00237
_CORNERS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])


@dataclass(frozen=True, eq=False)
class Slice:
    """The body in a plane's coordinates: the near-linear field, and the sides of the box that cuts the body, if one does."""

    terms: Terms
    low: Array  # (2,)
    high: Array  # (2,)
    sides: Array  # (k, 3): inside is sides . (u, v, 1) >= 0

    @property
    def size(self) -> float:
        """The longer side of the rectangle that holds the outline."""
        return float(np.max(self.high - self.low))

    def values(self, points: Array) -> Array:
        """The field (n,) at points (n, 2): positive inside, nearly linear across the outline."""
        field = near_linear(self.terms, log_ratio(self.terms, _flat(points)))
        return np.minimum(field, np.min(self._depths(points), axis=0, initial=np.inf))

    def slopes(self, points: Array) -> tuple[Array, Array]:
        """The field (n,) and its gradient (n, 2) at points (n, 2)."""
        value, slope = near_linear_gradient(self.terms, _flat(points))
        depth, slope = self._depths(points), slope[:, :2].copy()
        for side, d in zip(self.sides, depth, strict=True):
            nearer = d < value
            value, slope[nearer] = np.where(nearer, d, value), side[:2] / self.size
        return value, slope

    def crossed(self, low: Array, high: Array) -> NDArray[np.bool_]:
        """Whether the outline may pass through rectangles from low to high, (n, 2) each."""
        least, most = box_bounds(self.terms, _flat(low), _flat(high))
        centre, half = (low + high) / 2, (high - low) / 2
        middle, reach = self._depths(centre), np.abs(self.sides[:, :2]) @ half.T / self.size * (1 + 1e-9)
        most = np.minimum(most, np.min(middle + reach, axis=0, initial=np.inf))
        least = np.minimum(least, np.min(middle - reach, axis=0, initial=np.inf))
        return (most > 0) & (least <= 0)

    def _depths(self, points: Array) -> Array:
        """How deep points (n, 2) lie inside each side, (k, n), in sizes."""
        return (self.sides[:, :2] @ points.T + self.sides[:, 2:]) / self.size


def slice_of(terms: Terms, where: Region, plane: Plane) -> Slice | None:
    """The body's slice by the plane; None where the plane passes by the box that holds the body."""
    corners = _polygon(where, plane)
    if corners is None:
        return None
    low, high = np.min(corners, axis=0), np.max(corners, axis=0)
    if not np.all(high > low):
        return None
    sides = np.empty((0, 3))
    if where.cut:
        across = plane.axes[:2].T  # world x_i = origin_i + across_i . (u, v)
        sides = np.concatenate(
            [np.column_stack([across, plane.origin - where.low]), np.column_stack([-across, where.high - plane.origin])]
        )
    return Slice(plane.terms(terms), low, high, sides)


def loops(body: Slice) -> list[Array]:
    """The closed curves that bound the slice, points (n, 2) each on the outline, the body to the left."""
    cells = _CELLS
    while True:
        active, doubtful = _signs(body, _squares(body, cells), cells)
        needed = _needed(body, doubtful, cells)
        if needed <= cells:
            return _joined(body, active, cells)
        cells = needed


def _flat(points: Array) -> Array:
    return np.column_stack([points, np.zeros(len(points))])


def _polygon(where: Region, plane: Plane) -> Array | None:
    """The corners (n, 2), in no order, of the polygon that the plane cuts out of the region; None where it passes by."""
    choice = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    corners = np.where(choice, where.high, where.low)
    local = (corners - plane.origin) @ plane.axes.T
    found = [local[local[:, 2] == 0, :2]]
    for a in range(8):
        for b in range(a + 1, 8):
            if np.sum(choice[a] != choice[b]) == 1 and local[a, 2] * local[b, 2] < 0:
                share = local[a, 2] / (local[a, 2] - local[b, 2])
                found.append((local[a] + (local[b] - local[a]) * share)[None, :2])
    points = np.concatenate(found)
    return points if len(points) else None


def _place(body: Slice, nodes: Array | Cells, cells: int) -> Array:
    """Points (n, 2) of nodes (n, 2) of a grid with so many squares along a side."""
    return (body.low + body.high) / 2 + (nodes / cells - 0.5) * (_MARGIN * body.size)


def _alive(body: Slice, squares: Cells, cells: int) -> NDArray[np.bool_]:
    """Whether the outline may pass through squares (n, 2), named by their lower left nodes."""
    return body.crossed(_place(body, squares, cells), _place(body, squares + 1, cells))


def _squares(body: Slice, cells: int) -> Cells:
    """The squares of the grid that the outline may pass through."""
    squares, across = np.zeros((1, 2), dtype=np.int64), 1
    while across < cells:
        squares, across = _quarters(squares), across * 2
        squares = squares[_alive(body, squares, across)]
    return squares


def _quarters(squares: Cells) -> Cells:
    return (2 * squares[:, None] + _CORNERS).reshape(-1, 2)


def _signs(body: Slice, squares: Cells, cells: int) -> tuple[tuple[Cells, NDArray[np.bool_]], Cells]:
    """The squares whose corners differ, with which of them (n, 4) are inside; and the squares whose corners agree."""
    nodes = squares[:, None] + _CORNERS
    keys, back = np.unique(nodes[..., 0] * (cells + 1) + nodes[..., 1], return_inverse=True)
    inside = body.values(_place(body, np.column_stack(np.divmod(keys, cells + 1)), cells)) > _ROUNDING
    corners = inside[back.reshape(-1, 4)]
    count = np.sum(corners, axis=1)
    mixed = (count > 0) & (count < 4)
    return (squares[mixed], corners[mixed]), squares[~mixed]


def _needed(body: Slice, doubtful: Cells, cells: int) -> int:
    """How many squares along the longer side show all that squares with corners of one sign may hide."""
    needed = cells
    was = body.values(_place(body, doubtful, cells)) > _ROUNDING
    while len(doubtful) and cells < _FINEST:
        cells *= 2
        doubtful, was = _quarters(doubtful), np.repeat(was, 4)
        alive = _alive(body, doubtful, cells)
        doubtful, was = doubtful[alive], was[alive]
        value, slope = body.slopes(_place(body, doubtful + np.full(2, 0.5), cells))
        deep = np.abs(value) > THIN * body.size * np.linalg.norm(slope, axis=1)
        if np.any(((value > 0) != was) & deep):
            needed = min(2 * cells, _FINEST)
    return needed


def _joined(body: Slice, active: tuple[Cells, NDArray[np.bool_]], cells: int) -> list[Array]:
    """Loops through the roots on the edges of the active squares.

    Going round a square, the outline enters it where a corner inside is followed by one outside, the body to its left.
    """
    squares, inside = active
    if not len(squares):
        return []
    starts = inside & ~np.roll(inside, -1, axis=1)  # the edges are numbered by the corner that they follow
    square, first = np.nonzero(starts)
    split = (np.sum(starts, axis=1) == 2) & ~(body.values(_place(body, squares + np.full(2, 0.5), cells)) > 0)
    steps = np.arange(1, 4)
    turn = (first[:, None] + np.where(split[square], -1, 1)[:, None] * steps) % 4
    ends = ~inside[square[:, None], turn] & inside[square[:, None], (turn + 1) % 4]
    last = turn[np.arange(len(turn)), np.argmax(ends, axis=1)]
    begin, low, high = _edges(squares[square], first, cells)
    end, _, _ = _edges(squares[square], last, cells)
    points = _roots(body, _place(body, low, cells), _place(body, high, cells))
    return _traced(begin, end, points)


def _edges(squares: Cells, corner: Cells, cells: int) -> tuple[Cells, Cells, Cells]:
    """Of the edges that follow a corner: keys (n,) that the squares on both sides share, and the nodes at their ends."""
    start, end = squares + _CORNERS[corner], squares + _CORNERS[(corner + 1) % 4]
    low = np.minimum(start, end)
    upright = (start[:, 0] == end[:, 0]).astype(np.int64)
    return (low[:, 0] * (cells + 1) + low[:, 1]) * 2 + upright, start, end


def _roots(body: Slice, inside: Array, outside: Array) -> Array:
    """Points (n, 2) of the outline between points inside and points outside, by bisection."""
    a, b = np.zeros(len(inside)), np.ones(len(inside))
    for _ in range(_BISECTIONS):
        middle = (a + b) / 2
        within = body.values(inside + (outside - inside) * middle[:, None]) > _ROUNDING
        a, b = np.where(within, middle, a), np.where(within, b, middle)
    return inside + (outside - inside) * b[:, None]


def _traced(begin: Cells, end: Cells, points: Array) -> list[Array]:
    """Closed loops of points (n, 2) from segments that lead from edge to edge."""
    order = np.argsort(begin)
    follows = order[np.searchsorted(begin[order], end)].tolist()
    seen, found = np.zeros(len(begin), dtype=bool), []
    for first in range(len(begin)):
        if seen[first]:
            continue
        loop, at = [first], follows[first]
        while at != first:
            loop.append(at)
            at = follows[at]
        seen[loop] = True
        found.append(points[loop])
    return found
