"""Bringing marching cubes' vertices onto the surface: exact roots on the grid's edges, Newton steps where those crowd."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_gradient, log_ratio, near_linear

from .extract import Patch
from .grid import Grid
from .mesh import Array

# A vertex nearer to a node than this share of the edge is moved off it and back onto the surface sideways, so that the
# vertices around a node that lies almost on the surface stay apart.
_CROWDED = 0.02
_ROUNDS = 60
_PRECISE = 1e-12


def place_vertices(terms: Terms, grid: Grid, patch: Patch) -> Array:
    """World positions (V, 3) of a patch's vertices, on the surface; exactly in the planes of the grid that their edges lie in
    at a mirror plane or a cut."""
    node, axis = patch.edge[:, :3], patch.edge[:, 3]
    start = _positions(grid, node)
    along = node.copy()
    rows = np.flatnonzero(axis < 3)
    along[rows, axis[rows]] += 1
    end = _positions(grid, along)
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
        far = _positions(grid, node[centre] + 1)
        inner = start[centre] + (far - start[centre]) * patch.place[centre]
        points[centre] = _projected(terms, inner, inner, np.zeros((centre.size, 3), dtype=bool), grid.cell)
    return points


def _positions(grid: Grid, node: NDArray[np.int64]) -> Array:
    return np.stack([nodes[np.minimum(node[:, i], len(nodes) - 1)] for i, nodes in enumerate(grid.nodes)], axis=1)


def _held(grid: Grid, edge: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Coordinates (n, 3) that must not change: those in a mirror plane or a cut, across the edge."""
    held = np.zeros((len(edge), 3), dtype=bool)
    for i, (nodes, outside) in enumerate(zip(grid.nodes, grid.outside, strict=True)):
        beside = outside[np.maximum(edge[:, i] - 1, 0)] | outside[np.minimum(edge[:, i] + 1, len(outside) - 1)]
        held[:, i] = (edge[:, 3] != i) & (beside | (nodes[edge[:, i]] == 0))
    return held


def _roots(terms: Terms, start: Array, end: Array, ends: Array) -> Array:
    """Shares (n,) along edges at which the field is 0, by the Illinois method, bisecting where that is slow.

    `ends` (n, 2) are near-linear samples of opposite sign.
    """
    low, high = np.zeros(len(start)), np.ones(len(start))
    f_low, f_high = ends[:, 0].copy(), ends[:, 1].copy()
    share = np.where(f_low == 0, 0.0, np.where(f_high == 0, 1.0, 0.5))
    active = np.flatnonzero((f_low != 0) & (f_high != 0))
    for round_ in range(_ROUNDS):
        if not active.size:
            break
        a, b, fa, fb = low[active], high[active], f_low[active], f_high[active]
        guess = (a + b) / 2 if round_ % 4 == 3 else np.clip(a + (b - a) * (fa / (fa - fb)), a, b)
        f = near_linear(terms, log_ratio(terms, start[active] + (end[active] - start[active]) * guess[:, None]))
        same = (f > 0) == (fb > 0)
        share[active] = guess
        low[active], high[active] = np.where(same, a, guess), np.where(same, guess, b)
        f_low[active] = np.where(same, fa * 0.5, f)
        f_high[active] = np.where(same, f, fb * 0.5)
        done = (np.abs(f) < _PRECISE * 1e-1) | (high[active] - low[active] < _PRECISE)
        active = active[~done]
    return share


def _projected(terms: Terms, points: Array, otherwise: Array, fixed: NDArray[np.bool_], cell: float) -> Array:
    """Points (n, 3) moved onto the surface by Newton steps along the gradient, held coordinates kept.

    A point that does not arrive, or would go further than a tenth of a cell, becomes `otherwise`.
    """
    moved = points.copy()
    for _ in range(6):
        ratio, slope = log_gradient(terms, moved)
        linear, rate = _linear_slope(terms, ratio)
        slope = np.where(fixed, 0.0, slope * rate[:, None])
        square = np.maximum(np.sum(slope * slope, axis=1), 1e-300)
        step = np.clip(linear / square, -1e300, 1e300)[:, None] * slope
        length = np.linalg.norm(step, axis=1, keepdims=True)
        moved = moved - step * np.minimum(1.0, 0.05 * cell / np.maximum(length, 1e-300))
    arrived = (length[:, 0] < 1e-6 * cell) & (np.linalg.norm(moved - points, axis=1) < 0.1 * cell)
    return np.where(arrived[:, None], moved, otherwise)


def _linear_slope(terms: Terms, ratio: Array) -> tuple[Array, Array]:
    """The near-linear field and its derivative by L, (n,) each."""
    linear = near_linear(terms, ratio)
    small = 1e-6 * (1 + np.abs(ratio))
    return linear, np.maximum(near_linear(terms, ratio + small) - near_linear(terms, ratio - small), 1e-300) / (2 * small)
