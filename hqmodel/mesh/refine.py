"""Bringing marching cubes' vertices onto the surface: exact roots on the grid's edges, Newton steps where those crowd."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_ratio, near_linear, near_linear_gradient

from .extract import AT_NODE, Samples
from .grid import Grid
from .mesh import Array, dots, lengths

# A vertex nearer to a node than this share of the edge is moved off it and back onto the surface sideways, so that the
# vertices around a node that lies almost on the surface stay apart.
_CROWDED = 0.05
# Where that fails, at a kink or a tip, it stays on its edge, this share of it away from the node.
_APART = 1e-3
# A Newton step shorter than this share of its edge ends where another would be shorter than a hundred-thousandth.
_NEARLY = 5e-3
# The width of a root's bracket, as a share of its edge.
_PRECISE = 1e-8


def place_vertices(
    terms: Terms, grid: Grid, node: NDArray[np.int64], axis: NDArray[np.int64], ends: Samples
) -> tuple[Array, Array]:
    """World positions (V, 3), on the surface, of the vertices on the grid's edges from `node` (V, 3) along `axis` (V,), and the
    near-linear field's gradients there, (V, 3). `ends` are a patch's.

    Exactly in the planes of the grid that their edges lie in at a mirror plane or a cut.
    """
    points, slopes = grid.points(node), np.empty((3, len(node))).T
    free = np.flatnonzero(axis < AT_NODE)
    start, end = points[free], points[free].copy()
    for i, nodes in enumerate(grid.nodes):
        along = axis[free] == i
        end[along, i] = nodes[node[free[along], i] + 1]
    points[free], slopes[free], share = _on_edges(terms, start, end, ends[free])
    again = np.flatnonzero(axis == AT_NODE)
    near = np.flatnonzero((share < _CROWDED) | (share > 1 - _CROWDED))
    if near.size:
        way, share = end[near] - start[near], share[near, None]
        aside, beside = (start[near] + way * np.clip(share, d, 1 - d) for d in (_CROWDED, _APART))
        points[free[near]] = _projected(terms, aside, beside, _held(grid, node[free[near]], axis[free[near]]), grid.cell)
        again = np.append(again, free[near])
    slopes[again] = near_linear_gradient(terms, points[again])[1]
    return points, slopes


def _on_edges(terms: Terms, start: Array, end: Array, ends: Samples) -> tuple[Array, Array, Array]:
    """Where edges from start to end (n, 3) meet the surface: the points (n, 3), the gradients there (n, 3), and the shares of the
    edges (n,).

    One Newton step from where the samples at the ends put it, as these are nearly linear; where that is not enough, a root.
    """
    share = ends[:, 0] / (ends[:, 0] - ends[:, 1]).astype(float)
    points = start + (end - start) * share[:, None]
    values, slopes = near_linear_gradient(terms, points)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        step = -values / dots(slopes, end - start)
        near = (np.abs(step) < _NEARLY) & (share + step > 0) & (share + step < 1)
    share[near] += step[near]
    rest = np.flatnonzero(~near)
    share[rest] = _roots(terms, start[rest], end[rest], ends[rest])
    points = start + (end - start) * share[:, None]
    slopes[rest] = near_linear_gradient(terms, points[rest])[1]
    return points, slopes, share


def _held(grid: Grid, node: NDArray[np.int64], axis: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Coordinates (n, 3) that must not change: those in a mirror plane or a cut, across the edge."""
    held = np.zeros(node.shape, dtype=bool)
    for i, (nodes, outside) in enumerate(zip(grid.nodes, grid.outside, strict=True)):
        at = node[:, i]
        beside = outside[np.maximum(at - 1, 0)] | outside[np.minimum(at + 1, len(outside) - 1)]
        held[:, i] = (axis != i) & (beside | (nodes[at] == 0))
    return held


def _roots(terms: Terms, start: Array, end: Array, ends: Array | Samples) -> Array:
    """Shares (n,) along edges at which the field is 0, by Chandrupatla's method (1997, Adv. Eng. Software 28).

    `ends` (n, 2) are near-linear samples of opposite sign. The bracket of each root shrinks below `_PRECISE` of its edge, by
    inverse quadratic interpolation where that is safe and by halves elsewhere.
    """
    ends = ends.astype(float)
    share = np.where(ends[:, 0] == 0, 0.0, 1.0)
    active = np.flatnonzero((ends[:, 0] != 0) & (ends[:, 1] != 0))
    a, b, c = np.ones(active.size), np.zeros(active.size), np.ones(active.size)
    fa, fb, fc = ends[active, 1], ends[active, 0], ends[active, 1]
    scale = np.abs(fa - fb)
    step = np.clip(np.abs(fa) / scale, 0.05, 0.95)  # a straight line first: the samples are nearly linear
    while active.size:
        x = a + step * (b - a)
        f = near_linear(terms, log_ratio(terms, start[active] + (end[active] - start[active]) * x[:, None]))
        same = (f > 0) == (fa > 0)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, f
        nearer = np.abs(fa) < np.abs(fb)
        share[active] = np.where(nearer, a, b)
        margin = _PRECISE / np.abs(b - c)
        go_on = (margin <= 0.5) & (np.abs(f) > _PRECISE * 0.1 * scale)
        step = _step_share(a, b, c, fa, fb, fc, margin)[go_on]
        a, b, c, fa, fb, fc, scale, active = (values[go_on] for values in (a, b, c, fa, fb, fc, scale, active))
    return share


def _step_share(a: Array, b: Array, c: Array, fa: Array, fb: Array, fc: Array, margin: Array) -> Array:
    """Where between a and b to look next."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        quadratic = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        safe = (phi * phi < xi) & ((1 - phi) ** 2 < 1 - xi) & np.isfinite(quadratic)
    margin = np.minimum(margin, 0.5)
    return np.clip(np.where(safe, quadratic, 0.5), margin, 1 - margin)


def _projected(terms: Terms, points: Array, otherwise: Array, fixed: NDArray[np.bool_], cell: float) -> Array:
    """Points (n, 3) moved onto the surface by Newton steps along the gradient, held coordinates kept.

    A point that does not arrive, or would go further than a tenth of a cell, becomes `otherwise`.
    """
    moved, last = to_surface(terms, points, 0.05 * cell, 3, fixed)
    arrived = (last < 1e-6 * cell) & (lengths(moved - points) < 0.1 * cell)
    return np.where(arrived[:, None], moved, otherwise)


def to_surface(
    terms: Terms, points: Array, stride: float, rounds: int, fixed: NDArray[np.bool_] | None = None
) -> tuple[Array, Array]:
    """Points (n, 3) near the surface after Newton steps of at most `stride` towards it, and each last step's length (n,).

    Coordinates that are `fixed`, (n, 3), stay.
    """
    moved = points
    for _ in range(rounds):
        linear, slope = near_linear_gradient(terms, moved)
        if fixed is not None:
            slope = np.where(fixed, 0.0, slope)
        size = np.maximum(lengths(slope), 1e-200)
        distance = np.clip(linear / size, -stride, stride)
        moved = moved - (distance / size)[:, None] * slope
    return moved, np.abs(distance)
