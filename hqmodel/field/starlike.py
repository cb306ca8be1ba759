"""Whether a body is star-shaped, all of its surface seen from one point inside, and about which point.

It is where (x - c) . grad F < 0 all over the surface: every ray from the centre c then leaves it once. That is so about any
point inside a convex term (all exponents at least 1, no sign negative), and about the point where all strips of a term are 0;
else it is proved box by box, as the exact ranges of the strip functions bound that product, too.
"""

from __future__ import annotations

import numpy as np

from .evaluate import log_ratio
from .intervals import box_bounds, box_ranges, term_bounds
from .powers import over_runs
from .rays import first_hits
from .region import Region
from .straight import near_linear_gradient
from .symmetry import mirror_axes
from .terms import Array, Terms

_RAYS = 1500
# How many centres are tried, and how many hidden points of one the next is to see.
_CENTRES, _SPOTS = 3, 100
# In how many of the boxes the surface is looked at for a hidden point, after so many Newton steps to it.
_LOOKS, _STEPS = 2000, 4
_SEED = 1988
# Boxes along a side in the first look, how often those in doubt are split, and how many of them there may be.
_COARSE, _ROUNDS, _MOST = 8, 12, 60_000
_AT_ONCE = 1 << 20
# A strip whose h at the centre is no more than this share of its parts is 0 there: a cusp is seen from its own plane alone.
_ROUNDING = 1e-14


class NotStarShaped(ValueError):
    """There is no point from which all of the surface is seen; the message says where it is turned away."""


def star_centre(terms: Terms, region: Region) -> Array:
    """A point (3,) about which the body is star-shaped: the origin where that will do, else the middle of a term, else the
    point with the most room to all tangent planes that were looked at. In the body's mirror planes through the origin.

    Raises NotStarShaped where none is found.
    """
    points, normals = _seen(terms, region)
    for _ in range(_CENTRES):
        centre = _best_centre(terms, region, points, normals)
        room = np.sum(normals * (points - centre), axis=1)
        if not (np.min(room, initial=np.inf) > 0 and log_ratio(terms, centre) > 0):
            raise _turned_away(centre, points[np.argmin(room)] if len(points) else region.centre)
        hidden = np.empty((0, 3)) if _plainly(terms, centre) else _hidden(terms, region, centre)
        if not len(hidden):
            return centre
        more = _on_surface(terms, hidden)
        points, normals = np.concatenate([points, more[0]]), np.concatenate([normals, more[1]])
    raise _turned_away(centre, hidden[0])


def _best_centre(terms: Terms, region: Region, points: Array, normals: Array) -> Array:
    """The first candidate (3,) that sees all of the points (n, 3) with these outward normals, or at least the last one."""
    flat = np.isin(np.arange(3), mirror_axes(terms, region))
    middles = [_middle(terms.keep(np.arange(len(terms)) == k)) for k in np.flatnonzero(terms.positive)]
    for candidate in (np.zeros(3), *middles):
        centre = np.where(flat, 0.0, candidate)
        if np.all(np.sum(normals * (points - centre), axis=1) > 0) and log_ratio(terms, centre) > 0:
            return centre
    return np.where(flat, 0.0, _roomiest(points, normals, region))


def _turned_away(centre: Array, spot: Array) -> NotStarShaped:
    c, x = (", ".join(f"{value + 0.0:.4g}" for value in point) for point in (centre, spot))
    return NotStarShaped(f"expected a body all seen from one point inside, got one turned away from ({c}) at ({x})")


def _plainly(terms: Terms, centre: Array) -> bool:
    """Whether the one term that there is grows along every ray from the centre: it is convex, or all its strips are 0 there."""
    if len(terms) > 1 or terms.hyperbolic or not terms.positive.all():
        return False
    return bool(np.all(terms.inner >= 1) and np.all(terms.outer >= 1)) or not np.any(_at(terms, centre))


def _at(terms: Terms, centre: Array) -> Array:
    """The strip functions h (S,) at the centre; exactly 0 where rounding alone keeps them from it."""
    at = terms.normal @ centre + terms.offset
    return np.where(np.abs(at) <= _ROUNDING * (np.abs(terms.normal) @ np.abs(centre) + np.abs(terms.offset)), 0.0, at)


def _middle(term: Terms) -> Array:
    """The point (3,) where the strip functions of the one term are least, by squares; 0 for all of them where they can be."""
    return -np.linalg.pinv(term.normal) @ term.offset


def _seen(terms: Terms, region: Region) -> tuple[Array, Array]:
    """Points of the surface that are seen from outside, (n, 3), and its outward unit normals there."""
    rng = np.random.default_rng(_SEED)
    away = rng.normal(size=(_RAYS, 3))
    away *= np.linalg.norm(region.size) / np.linalg.norm(away, axis=1, keepdims=True)
    origins = region.centre + away
    towards = region.centre + rng.uniform(-0.4, 0.4, (_RAYS, 3)) * region.size - origins
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    distance = first_hits(terms, region, origins, towards)[:, None]
    return _on_surface(terms, (origins + distance * towards)[np.isfinite(distance[:, 0])])


def _on_surface(terms: Terms, points: Array) -> tuple[Array, Array]:
    """Points (n, 3) near the surface moved onto it, and its outward unit normals there; without those that don't get there."""
    for _ in range(_STEPS):
        linear, slope = near_linear_gradient(terms, points)
        size = np.linalg.norm(slope, axis=1, keepdims=True)
        smooth = (size[:, 0] > 1e-100) & (size[:, 0] < 1e100)
        size, normals = size[smooth], -slope[smooth] / size[smooth]
        step = linear[smooth, None] / size
        points = points[smooth] + step * normals
    there = np.abs(step[:, 0]) < 1e-6
    return points[there], normals[there]


def _roomiest(points: Array, normals: Array, region: Region) -> Array:
    """The point (3,) deepest below the tangent planes at all the points (n, 3), by linear programming."""
    from scipy.optimize import linprog  # late: it is slow to load

    rows = np.column_stack([normals, np.ones(len(points))])
    bounds = [*zip(region.low, region.high, strict=True), (None, np.linalg.norm(region.size))]
    return np.asarray(linprog((0, 0, 0, -1), rows, np.sum(normals * points, axis=1), bounds=bounds).x[:3])


def _hidden(terms: Terms, region: Region, centre: Array) -> Array:
    """Points (n, 3) of the surface that don't face the centre, or are not proved to; none where all of it does."""
    grid = np.stack(np.meshgrid(*[np.arange(_COARSE)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    side = region.size / _COARSE
    low = region.low + grid * side
    halves = np.stack(np.meshgrid(*[(0.0, 1.0)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    for _ in range(_ROUNDS):
        least, most = box_bounds(terms, low, low + side)
        low = low[(least <= 0) & (most >= 0)]
        low = low[~(_facing(terms, low, low + side, centre) > 0)]
        points, normals = _on_surface(terms, low[:: 1 + len(low) // _LOOKS] + side / 2)
        facing = np.sum(normals * (points - centre), axis=1)
        if np.any(facing < 0):
            worst = np.argsort(facing)[:_SPOTS]
            return points[worst[facing[worst] < 0]]
        if len(low) * 8 > _MOST or not len(low):
            break
        side = side / 2
        low = (low[:, None] + halves * side).reshape(-1, 3)
    return low[:_SPOTS]


def _facing(terms: Terms, low: Array, high: Array, centre: Array) -> Array:
    """A lower bound (n,) of -(x - c) . grad F over boxes (n, 3), in units of the largest term there; NaN where there is none."""
    result = np.empty(len(low))
    step = max(1, _AT_ONCE // len(terms.inner))
    for start in range(0, len(low), step):
        here = slice(start, start + step)
        middle, reach = box_ranges(terms, low[here], high[here])
        t_low, t_high = term_bounds(terms, middle, reach)
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            slope_low, slope_high = _radial_slopes(terms, middle, reach, centre)
            slope = np.where(terms.positive[:, None], slope_low, -slope_high)  # what carves takes away the more the steeper it is
            t = np.where(slope < 0, t_high, t_low) - np.max(t_high, axis=0)
            result[here] = np.sum(np.exp(t) * terms.hardness[:, None] * slope, axis=0)
    return result


def _radial_slopes(terms: Terms, middle: Array, reach: Array, centre: Array) -> tuple[Array, Array]:
    """Bounds of (x - c) . grad H_k, (K, n) each, where h_a lies within `reach` of `middle`, (S, n) each.

    Of a group it is G s^(G/g - 1) sum |h|^(g-1) sign(h) (h - h(c)) with s = sum |h|^g.
    """
    f_low, f_high = (over_runs(f, terms.group_start) for f in _strip_slopes(terms, middle - reach, middle + reach, centre))
    size, g = np.abs(middle), terms.inner[:, None]
    spread = [over_runs(u**g, terms.group_start) for u in (np.maximum(size - reach, 0.0), size + reach)]
    raised = [terms.outer[:, None] * s ** (terms.outer / terms.inner[terms.group_start] - 1)[:, None] for s in spread]
    least, most = np.minimum(*raised), np.maximum(*raised)
    low, high = np.where(f_low < 0, most, least) * f_low, np.where(f_high > 0, most, least) * f_high
    adds = terms.group_sign[:, None] > 0
    low, high = np.where(adds, low, -high), np.where(adds, high, -low)
    return over_runs(low, terms.term_start), over_runs(high, terms.term_start)


def _strip_slopes(terms: Terms, low: Array, high: Array, centre: Array) -> tuple[Array, Array]:
    """Bounds of f = |h|^(g-1) sign(h) (h - h(c)), (S, n) each, for h from low to high.

    With h turned so that h(c) >= 0, f falls up to h = h(c) (g - 1) / g and grows from there on; but for g < 1 it has a pole at
    h = 0, and for g = 1 a leap.
    """
    at = _at(terms, centre)[:, None]
    low, high, at = np.where(at < 0, -high, low), np.where(at < 0, -low, high), np.abs(at)
    g = terms.inner[:, None]

    def f(h: Array) -> Array:
        size = np.abs(h)
        return np.where(at == 0, size**g, np.sign(h) * size ** (g - 1) * (h - at))

    ends = f(low), f(high)
    dip = np.clip(at * (g - 1) / g, low, high)
    across = (low <= 0) & (high >= 0) & (at > 0) & (g <= 1)
    leap = np.where(g < 1, np.inf, at)
    least = np.where(across, -leap, np.minimum(np.minimum(*ends), f(dip)))
    return least, np.where(across, np.maximum(np.maximum(*ends), leap), np.maximum(*ends))
