"""Loops of points on an outline made into few cubic Bézier curves, each within a tolerance of the true outline.

A point of the outline comes with its tangent, so a piece between two of them is known to the fourth order in its length. Points
are added until every piece is near enough, then left out again wherever one piece does for two; sharp corners are kept.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .contour import Array, Slice

# A turn beyond which two points closer than a few tolerances are a corner, and one that no single piece makes.
_CORNER, _LONGEST_TURN, _STRAIGHT = np.cos(np.radians([20, 100, 0.5]))
_ROUNDS = 28
# Where along a piece its distance from the outline is measured.
_PROBES = np.linspace(0, 1, 9)[1:-1]


@dataclass(frozen=True, eq=False)
class _Loop:
    """Points (n, 2) of a closed curve and unit tangents (n, 2) where it arrives and where it leaves, the same but at corners."""

    points: Array
    arriving: Array
    leaving: Array


def fitted(body: Slice, points: Array, tolerance: float) -> Array:
    """A closed chain of Bézier curves, control points (m, 4, 2), within `tolerance` of the outline that the points lie on."""
    loop = _cornered(_refined(body, _kinked(body, points), tolerance), tolerance)
    smooth = np.sum(loop.arriving * loop.leaving, axis=1) > _CORNER
    kept = np.arange(len(loop.points))
    first, still = 0, 0
    while still < 2 and len(kept) > 4:  # every other point is left out where one piece does for two, the odd ones, then the even
        between = np.arange(first, len(kept) - 1, 2)
        between = between[smooth[kept[between]]]
        start, end = kept[between - 1], kept[between + 1]
        turns = np.sum(loop.leaving[start] * loop.arriving[end], axis=1)
        good = turns > _LONGEST_TURN
        good[good] = _misses(body, _pieces(loop, start[good], end[good])) <= tolerance
        kept = np.delete(kept, between[good])
        first, still = 1 - first, 0 if np.any(good) else still + 1
    return _pieces(loop, kept, np.roll(kept, -1))


def along(curves: Array, shares: Array) -> Array:
    """Points (m, k, 2) of Bézier curves (m, 4, 2) at parameters (k,)."""
    s = shares[:, None]
    a, b, c, d = (curves[:, None, i] for i in range(4))
    return (1 - s) ** 3 * a + 3 * (1 - s) ** 2 * s * b + 3 * (1 - s) * s * s * c + s**3 * d


def flattened(curves: Array, tolerance: float) -> Array:
    """A closed polygon (n, 2), the first point not repeated, within `tolerance` of a closed chain of curves."""
    bend = np.max(np.linalg.norm(np.diff(curves, n=2, axis=1), axis=2), axis=1)
    counts = np.maximum(1, np.ceil(np.sqrt(0.75 * bend / tolerance))).astype(int)
    return np.concatenate([along(curve[None], np.arange(n) / n)[0] for curve, n in zip(curves, counts, strict=True)])


def enclosed(curves: Array) -> float:
    """The area that a closed chain of Bézier curves goes round counter-clockwise, exactly (negative for the other way)."""
    a, b, c, d = (curves[:, i] for i in range(4))
    each = 6 * _cross(a, b) + 3 * _cross(a, c) + _cross(a, d) + 3 * _cross(b, c) + 3 * _cross(b, d) + 6 * _cross(c, d)
    return float(np.sum(each) / 20)


def arc_lengths(curves: Array) -> Array:
    """The lengths (m,) of Bézier curves, by Gauss's rule with 16 points."""
    where, weights = np.polynomial.legendre.leggauss(16)
    s = (where[:, None] + 1) / 2
    a, b, c = (3 * np.diff(curves, axis=1)[:, None, i] for i in range(3))
    speed = np.linalg.norm((1 - s) ** 2 * a + 2 * (1 - s) * s * b + s * s * c, axis=2)
    return speed @ weights / 2


def _cross(a: Array, b: Array) -> Array:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _tangents(body: Slice, points: Array) -> Array:
    """Unit tangents (n, 2) of the outline at points (n, 2), the body to the left."""
    slope = body.slopes(points)[1]
    size = np.linalg.norm(slope, axis=1, keepdims=True)
    return np.column_stack([slope[:, 1], -slope[:, 0]]) / np.where(size > 0, size, 1.0)


def _bent(start: Array, end: Array, leaving: Array, arriving: Array) -> Array:
    """Bézier curves (n, 4, 2) between points with tangents, the handles as long as an arc of a circle would have them."""
    chord = np.linalg.norm(end - start, axis=1)
    half = np.arccos(np.clip(np.sum(leaving * arriving, axis=1), -1, 1)) / 4
    handle = (chord / (3 * np.cos(half) ** 2))[:, None]
    return np.stack([start, start + handle * leaving, end - handle * arriving, end], axis=1)


def _misses(body: Slice, curves: Array) -> Array:
    """The largest distance (n,) of curves from the outline."""
    points = along(curves, _PROBES).reshape(-1, 2)
    value, slope = body.slopes(points)
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = np.abs(value) / np.linalg.norm(slope, axis=1)
    return np.max(np.nan_to_num(distance, nan=np.inf).reshape(len(curves), len(_PROBES)), axis=1)


def _kinked(body: Slice, points: Array) -> _Loop:
    """The loop with its tangents; a point where two straight edges meet takes theirs, as the field has none there."""
    tangents = _tangents(body, points)
    ahead = np.roll(points, -1, axis=0) - points
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-300)
    behind = np.roll(ahead, 1, axis=0)
    along_edges = (np.sum(np.roll(tangents, 1, axis=0) * behind, axis=1) > _STRAIGHT) & (
        np.sum(np.roll(tangents, -1, axis=0) * ahead, axis=1) > _STRAIGHT
    )
    kink = (along_edges & (np.sum(behind * ahead, axis=1) < _CORNER))[:, None]
    return _Loop(points, np.where(kink, behind, tangents), np.where(kink, ahead, tangents))


def _refined(body: Slice, loop: _Loop, tolerance: float) -> _Loop:
    """The loop with points added until the piece between any two neighbours is within the tolerance."""
    fresh = np.ones(len(loop.points), dtype=bool)
    for _ in range(_ROUNDS):
        here = np.flatnonzero(fresh)
        after = (here + 1) % len(loop.points)
        start, end = loop.points[here], loop.points[after]
        gap = np.linalg.norm(end - start, axis=1)
        split = (gap > tolerance) & (_misses(body, _pieces(loop, here, after)) > tolerance)
        if not np.any(split):
            break
        added = _onto(body, (start[split] + end[split]) / 2, gap[split])
        place, tangents = here[split] + 1, _tangents(body, added)
        fresh[:] = False
        fresh[here[split]] = True
        fresh = np.insert(fresh, place, True)
        loop = _Loop(
            np.insert(loop.points, place, added, axis=0),
            np.insert(loop.arriving, place, tangents, axis=0),
            np.insert(loop.leaving, place, tangents, axis=0),
        )
    return loop


def _onto(body: Slice, points: Array, reach: Array) -> Array:
    """Points (n, 2) brought onto the outline by Newton steps, none further than `reach` (n,) in all."""
    moved = points
    for _ in range(8):
        value, slope = body.slopes(moved)
        size = np.maximum(np.linalg.norm(slope, axis=1), 1e-200)
        step = np.clip(value / size, -reach / 4, reach / 4)
        moved = moved - (step / size)[:, None] * slope
    near = np.linalg.norm(moved - points, axis=1) < reach
    return np.where(near[:, None], moved, points)


def _cornered(loop: _Loop, tolerance: float) -> _Loop:
    """Neighbours between which the outline turns sharply within a few tolerances made one point, where their tangents meet."""
    points, leaving, arriving = loop.points.copy(), loop.leaving.copy(), np.roll(loop.arriving, -1, axis=0)
    gap = np.roll(points, -1, axis=0) - points
    sharp = (np.sum(leaving * arriving, axis=1) < _CORNER) & (np.linalg.norm(gap, axis=1) < 4 * tolerance)
    here = np.flatnonzero(sharp & ~np.roll(sharp, 1))  # of two in a row the first
    if len(points) - len(here) < 3:
        return loop
    with np.errstate(divide="ignore", invalid="ignore"):
        share = _cross(gap[here], arriving[here]) / _cross(leaving[here], arriving[here])
    near = np.abs(share) < 4 * tolerance
    points[here] += np.where(near[:, None], share[:, None] * leaving[here], gap[here] / 2)
    leaving[here] = np.roll(loop.leaving, -1, axis=0)[here]
    kept = np.ones(len(points), dtype=bool)
    kept[(here + 1) % len(points)] = False
    return _Loop(points[kept], loop.arriving[kept], leaving[kept])


def _pieces(loop: _Loop, start: NDArray[np.intp], end: NDArray[np.intp]) -> Array:
    return _bent(loop.points[start], loop.points[end], loop.leaving[start], loop.arriving[end])
