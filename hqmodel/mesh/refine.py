"""Bringing marching cubes' vertices onto the surface: exact roots on the grid's edges, Newton steps where those crowd."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_gradient, log_ratio, near_linear, near_linear_slope

from .extract import Patch
from .grid import Grid
from .mesh import Array

# A vertex nearer to a node than this share of the edge is moved off it and back onto the surface sideways, so that the
# vertices around a node that lies almost on the surface stay apart.
_CROWDED = 0.01
# The width of a root's bracket, as a share of its edge.
_PRECISE = 1e-8


def place_vertices(terms: Terms, grid: Grid, patch: Patch) -> Array:
    """World positions (V, 3) of a patch's vertices, on the surface; exactly in the planes of the grid that their edges lie in
    at a mirror plane or a cut."""
    node, axis = patch.edge[:, :3], patch.edge[:, 3]
    start = grid.points(node)
    along = node.copy()
    rows = np.flatnonzero(axis < 3)
    along[rows, axis[rows]] += 1
    end = grid.points(along)
    points = start + (end - start) * 0.5
    free = np.flatnonzero((axis < 3) & np.all(np.isfinite(patch.ends), axis=1) & np.any(start != end, axis=1))
    share = _roots(terms, start[free], end[free], patch.ends[free])
    points[free] = start[free] + (end[free] - start[free]) * share[:, None]
    crowded = free[(share < _CROWDED) | (share > 1 - _CROWDED)]
    if crowded.size:
        fixed = _held(grid, patch.edge[crowded])
        apart = np.clip(share[np.isin(free, crowded, assume_unique=True)], _CROWDED, 1 - _CROWDED)[:, None]
        aside = start[crowded] + (end[crowded] - start[crowded]) * apart
        points[crowded] = _projected(terms, aside, points[crowded], fixed, grid.cell)
    centre = np.flatnonzero(axis == 3)
    if centre.size:
        far = grid.points(node[centre] + 1)
        inner = start[centre] + (far - start[centre]) * patch.place[centre]
        points[centre] = _projected(terms, inner, inner, np.zeros((centre.size, 3), dtype=bool), grid.cell)
    return points


def _held(grid: Grid, edge: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Coordinates (n, 3) that must not change: those in a mirror plane or a cut, across the edge."""
    held = np.zeros((len(edge), 3), dtype=bool)
    for i, (nodes, outside) in enumerate(zip(grid.nodes, grid.outside, strict=True)):
        beside = outside[np.maximum(edge[:, i] - 1, 0)] | outside[np.minimum(edge[:, i] + 1, len(outside) - 1)]
        held[:, i] = (edge[:, 3] != i) & (beside | (nodes[edge[:, i]] == 0))
    return held


def _roots(terms: Terms, start: Array, end: Array, ends: Array) -> Array:
    """Shares (n,) along edges at which the field is 0, by Chandrupatla's method (1997, Adv. Eng. Software 28).

    `ends` (n, 2) are near-linear samples of opposite sign. The bracket of each root shrinks below `_PRECISE` of its edge, by
    inverse quadratic interpolation where that is safe and by halves elsewhere.
    """
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
    moved, last = to_surface(terms, points, 0.05 * cell, 4, fixed)
    arrived = (last < 1e-6 * cell) & (np.linalg.norm(moved - points, axis=1) < 0.1 * cell)
    return np.where(arrived[:, None], moved, otherwise)


def to_surface(
    terms: Terms, points: Array, stride: float, rounds: int, fixed: NDArray[np.bool_] | None = None
) -> tuple[Array, Array]:
    """Points (n, 3) near the surface after Newton steps of at most `stride` towards it, and each last step's length (n,).

    The steps are taken in the near-linear field, so that they neither creep from outside nor leap from inside.
    """
    moved = points
    for _ in range(rounds):
        ratio, slope = log_gradient(terms, moved)
        slope = slope * near_linear_slope(terms, ratio)[:, None]
        if fixed is not None:
            slope = np.where(fixed, 0.0, slope)
        square = np.maximum(np.sum(slope * slope, axis=1), 1e-300)
        step = np.clip(near_linear(terms, ratio) / square, -1e200, 1e200)[:, None] * slope
        length = np.linalg.norm(step, axis=1)
        moved = moved - step * np.minimum(1.0, stride / np.maximum(length, 1e-300))[:, None]
    return moved, length
