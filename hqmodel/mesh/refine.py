"""Bringing marching cubes' vertices onto the surface: exact roots on the grid's edges, Newton steps where those crowd."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_ratio, near_linear, near_linear_gradient

from .edges import Askew, Edges
from .extract import AT_NODE
from .grid import Grid
from .mesh import Array, lengths, rows
from .sampling import Samples

# A vertex nearer to a node than this share of the edge is moved off it and back onto the surface sideways, so that the
# vertices around a node that lies almost on the surface stay apart.
_CROWDED = 0.05
# The same of an edge that a sheet has drawn an end of into itself.
_SPREAD = 0.25
# Where that fails, at a kink or a tip, it stays on its edge, this share of it away from the node.
_APART = 1e-3
# A Newton step shorter than this share of its edge ends where another would be shorter than a hundred-thousandth.
_NEARLY = 5e-3
# A Newton step shorter than this share of the longest is the last, where the field is no more than this off its level.
_STILL = 1e-9
# The width of a root's bracket, as a share of its edge.
_PRECISE = 1e-8


def place_vertices(
    terms: Terms,
    grid: Grid,
    node: NDArray[np.int64],
    axis: NDArray[np.int64],
    ends: Samples,
    aside: Array | None,
    still: Callable[[], None],
) -> tuple[Array, Array]:
    """World positions (V, 3), on the surface, of the vertices on the grid's edges from `node` (V, 3) along `axis` (V,), and the
    near-linear field's gradients there, (V, 3). `ends`, `aside` and their order, by axis, are a patch's.

    Exactly in the planes of the grid that their edges lie in at a mirror plane or a cut. `still` is called now and then;
    whatever it raises ends the work.
    """
    caps, bent = axis == AT_NODE, np.zeros(len(axis), dtype=bool) if aside is None else aside.any(axis=(1, 2))
    straight = np.flatnonzero(~(caps | bent))
    if len(straight) == len(axis):
        return _placed(terms, grid, Edges.of(grid, node, axis, ends), node, _CROWDED, still)
    points, slopes = np.empty((len(axis), 3), order="F"), np.empty((len(axis), 3), order="F")
    points[caps] = grid.points(node[caps] if aside is None else node[caps] + aside[caps, 0])
    slopes[caps] = near_linear_gradient(terms, points[caps])[1]
    if straight.size:
        edges = Edges.of(grid, rows(node, straight), axis[straight], ends[straight])
        points[straight], slopes[straight] = _placed(terms, grid, edges, rows(node, straight), _CROWDED, still)
    bent &= ~caps
    if aside is not None and bent.any():
        askew = Askew.of(grid, node[bent], axis[bent], ends[bent], aside[bent])
        points[bent], slopes[bent] = _placed(terms, grid, askew, node[bent], _SPREAD, still)
    return points, slopes


def _placed(
    terms: Terms, grid: Grid, edges: Edges | Askew, node: NDArray[np.int64], apart: float, still: Callable[[], None]
) -> tuple[Array, Array]:
    """As `place_vertices`; none stays nearer to a node than the share `apart` of its edge."""
    points, slopes, share = _on_edges(terms, edges, still)
    still()
    near = np.flatnonzero((share < apart) | (share > 1 - apart))
    if near.size:
        crowded, share = edges.some(near), share.take(near)
        held = _held(grid, rows(node, near), crowded.axis)
        aside = crowded.aside(apart, share, rows(points, near), np.where(held, 0.0, rows(slopes, near)))
        points[near] = _projected(terms, aside, crowded.at(np.clip(share, _APART, 1 - _APART)), held, grid.cell)
        slopes[near] = near_linear_gradient(terms, points[near])[1]
    return points, slopes


def _on_edges(terms: Terms, edges: Edges | Askew, still: Callable[[], None]) -> tuple[Array, Array, Array]:
    """Where edges meet the surface: the points (n, 3), the gradients there (n, 3), and the shares of the edges (n,).

    One Newton step from where the samples at the ends put it, as these are nearly linear; where that is not enough, a root.
    """
    share = edges.ends[:, 0] / (edges.ends[:, 0] - edges.ends[:, 1]).astype(float)
    values, slopes = near_linear_gradient(terms, edges.at(share))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        step = -values / edges.gain(slopes)
        near = (np.abs(step) < _NEARLY) & (share + step > 0) & (share + step < 1)
    share += np.where(near, step, 0.0)
    rest = np.flatnonzero(~near)
    share[rest] = _roots(terms, edges.some(rest), still)
    still()
    points = edges.at(share)
    slopes[rest] = near_linear_gradient(terms, points[rest])[1]
    return points, slopes, share


def crossed(terms: Terms, start: Array, end: Array, still: Callable[[], None]) -> tuple[Array, NDArray[np.bool_]]:
    """Where ways from start to end, (n, 3) each, pass through the surface, (n, 3), and whether they do: end beyond it, (n,)."""
    ends = np.stack([near_linear(terms, log_ratio(terms, points)) for points in (start, end)]).T
    through = (ends[:, 0] > 0) != (ends[:, 1] > 0)
    ways = Askew(start, end - start, np.zeros(len(start), dtype=np.int64), ends).some(np.flatnonzero(through))
    points = end.copy()
    points[through] = ways.at(_roots(terms, ways, still))
    return points, through


def _held(grid: Grid, node: NDArray[np.int64], axis: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Coordinates (n, 3) that must not change: those in a mirror plane or a cut, across the edge."""
    held = np.zeros(node.shape, dtype=bool)
    for i, (nodes, outside) in enumerate(zip(grid.nodes, grid.outside, strict=True)):
        at = node[:, i]
        beside = outside[np.maximum(at - 1, 0)] | outside[np.minimum(at + 1, len(outside) - 1)]
        held[:, i] = (axis != i) & (beside | (nodes[at] == 0))
    return held


def _roots(terms: Terms, edges: Edges | Askew, still: Callable[[], None]) -> Array:
    """Shares (n,) of edges at which the field is 0, by Chandrupatla's method (1997, Adv. Eng. Software 28).

    The samples at the ends are of opposite sign. The bracket of each root shrinks below `_PRECISE` of its edge, by inverse
    quadratic interpolation where that is safe and by halves elsewhere.
    """
    ends = edges.ends.astype(float)
    share = np.where(ends[:, 0] == 0, 0.0, 1.0)
    active = np.flatnonzero((ends[:, 0] != 0) & (ends[:, 1] != 0))
    edges = edges.some(active)
    a, b, c = np.ones(active.size), np.zeros(active.size), np.ones(active.size)
    fa, fb, fc = ends[active, 1], ends[active, 0], ends[active, 1]
    scale = np.abs(fa - fb)
    step = np.clip(np.abs(fa) / scale, 0.05, 0.95)  # a straight line first: the samples are nearly linear
    while active.size:
        still()
        x = a + step * (b - a)
        f = near_linear(terms, log_ratio(terms, edges.at(x)))
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
        edges = edges.some(np.flatnonzero(go_on))
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
    moved, last = points.copy(), np.full(len(points), np.inf)
    going = np.arange(len(points))
    for _ in range(rounds):
        linear, slope = near_linear_gradient(terms, rows(moved, going))
        if fixed is not None:
            slope[rows(fixed, going)] = 0.0
        size = np.maximum(lengths(slope), 1e-200)
        distance = np.clip(linear / size, -stride, stride)
        slope *= (distance / size)[:, None]
        moved[going] -= slope
        last[going] = np.abs(distance)
        going = going[(np.abs(distance) > _STILL * stride) | (np.abs(linear) > _STILL)]
        if not going.size:
            break
    return moved, last
