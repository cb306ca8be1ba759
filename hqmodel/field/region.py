"""Where the body is: the box that holds it, from the bounding planes and tightened by exact bounds alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hqmodel.model import Scene

from .intervals import box_tops, relevant_terms
from .powers import CEILING
from .terms import HUGE, Array, Indices, Terms

# A flat shape (dimension 2) is shown and exported as a plate this share of its longest side thick, to either side of z = 0.
PLATE = 0.01
# Cells along a side in the first look, and in the last.
_COARSE, _FINE = 8, 64
_MOST_CELLS = 20_000
# From so many terms on each of so many parts along a side of the box has a list of those that are not too faint there, by this
# power of e; all others change L by less than the last number.
_FEW, _PARTS, _FAINT, _LEFT_OUT = 48, 3, 30.0, 1e-9
# How far out, in the scene's own size, a body is taken to be without end.
_FAR = 1e6


@dataclass(frozen=True, eq=False)
class Region:
    """The box from low to high, (3,) each, that holds the body.

    `cut`: the box cuts the body, and the cuts are closed (the preset's bounds, an endless body, a flat shape's plate).
    `bounded`: false when the body itself runs on without end. `empty`: there is no body; the box is a unit one.
    """

    low: Array
    high: Array
    cut: bool = False
    bounded: bool = True
    empty: bool = False

    @property
    def size(self) -> Array:
        """Its sides, (3,)."""
        return self.high - self.low

    @property
    def centre(self) -> Array:
        """Its middle, (3,)."""
        return (self.low + self.high) / 2


def region(scene: Scene, terms: Terms | None = None, loosely: bool = False) -> Region:
    """The region of a scene: its `bounds` if it has any, else worked out from the planes; tight to a few hundredths.

    `loosely`: of what could be body without the shapes that carve, which takes much less time where there are many.
    """
    terms = Terms.of(scene) if terms is None else terms
    if loosely and terms.level > 0 and not terms.positive.all():
        uncarved = region(scene, terms.keep(terms.positive))
        if uncarved.bounded:
            return uncarved
    flat = scene.dimension == 2
    if scene.bounds is not None:
        start, bounded = np.array(scene.bounds, dtype=float), True
    else:
        start, bounded = _start(terms, flat)
    hull = _tightened(terms, start, flat)
    if hull is None:
        return Region(-np.ones(3), np.ones(3), empty=True)
    if not bounded:
        bounded = not bool(np.any((hull == start)[:, : 2 if flat else 3]))
        if not bounded:
            hull = _tightened(terms, _within_sight(terms, hull), flat, rounds=1) if not flat else _within_sight(terms, hull)
            hull = np.stack([-np.ones(3), np.ones(3)]) if hull is None else hull
    if flat and scene.bounds is None:
        thickness = PLATE * np.max((hull[1] - hull[0])[:2])
        hull[:, 2] = -thickness, thickness
    return Region(hull[0], hull[1], cut=flat or not bounded or scene.bounds is not None, bounded=bounded)


def sharing(terms: Terms) -> float:
    """The margin for `reaches` within which, wherever F >= w, one of the K adding terms is: it alone comes to w / K."""
    return float(np.log(max(1, int(np.count_nonzero(terms.positive)))))


def reaches(terms: Terms, margin: float) -> Array:
    """(S,) the largest |h_a| where the strip's term alone comes to exp(-margin) of the level.

    That is where H_k <= C_k + (ln(c_k / w) + margin) / beta_k.
    Negative where it never does; inf for hyperbolic terms, and where there is no level above 0 to measure by.
    """
    if terms.level <= 0 or not len(terms):
        return np.full(len(terms.inner), np.inf)
    with np.errstate(over="ignore", invalid="ignore"):
        slack = (terms.log_coefficient - np.log(terms.level) + margin) / np.maximum(terms.hardness, 1e-300)
        most = np.clip(terms.constant + slack, -CEILING, CEILING)[terms.term_of_group]
        reach = np.sign(most) * np.minimum(np.abs(most) ** (1 / terms.outer), HUGE)
    hyperbolic = np.minimum.reduceat(terms.group_sign, terms.term_start)[terms.term_of_group] < 0
    return np.where(hyperbolic, np.inf, reach)[terms.group_of_strip]


def _start(terms: Terms, flat: bool) -> tuple[Array, bool]:
    """A box that holds the body for certain, (2, 3), or one so large that what touches it has no end."""
    boxes = []
    reach = reaches(terms, sharing(terms))
    for k in np.flatnonzero(terms.positive):
        own = terms.term_of_strip == k
        if np.any(reach[own] < 0):
            continue
        box = _polytope_box(terms.normal[own], terms.offset[own], reach[own], 2 if flat else 3)
        if box is None:
            return _far_box(terms), False
        boxes.append(box)
    if not boxes:
        return _far_box(terms), terms.level > 0
    return np.stack([np.min([box[0] for box in boxes], axis=0), np.max([box[1] for box in boxes], axis=0)]), True


def _polytope_box(normal: Array, offset: Array, reach: Array, dimension: int) -> Array | None:
    """A box, (2, 3), around |normal . x + offset| <= reach; None where these planes leave a direction open.

    With M the pseudo-inverse of the scaled normals, x = M (h - d) and |h| <= 1 give |x_i + (M d)_i| <= sum_a |M_ia|.
    """
    if not np.all(np.isfinite(reach)):
        return None
    inside = np.maximum(reach, 1e-150)
    planes, shift = normal[:, :dimension] / inside[:, None], offset / inside
    size = np.max(np.abs(planes))
    if not 0 < size < HUGE or np.linalg.matrix_rank(planes / size, tol=1e-9) < dimension:
        return None
    inverse = np.linalg.pinv(planes / size) / size
    half = np.sum(np.abs(inverse), axis=1) * (1 + 1e-9)
    box = np.zeros((2, 3))
    box[:, :dimension] = -inverse @ shift - half, -inverse @ shift + half
    return box


def _scale(terms: Terms) -> float:
    """How far out the scene's planes lie, near enough."""
    if not len(terms):
        return 1.0
    length = np.maximum(np.linalg.norm(terms.normal, axis=1), 1e-100)
    return float(np.max((1 + np.abs(terms.offset)) / length))


def _far_box(terms: Terms) -> Array:
    return np.outer([-1.0, 1.0], np.full(3, _FAR * _scale(terms)))


def _within_sight(terms: Terms, hull: Array) -> Array:
    """The part of an endless hull that is shown."""
    low, high = hull
    near = 2.5 * _scale(terms)
    shift = np.where(low >= near, low + near, np.where(high <= -near, high - near, 0.0))  # a body that begins further out
    return np.stack([np.maximum(low, shift - near), np.minimum(high, shift + near)])


def _tightened(terms: Terms, box: Array, flat: bool, rounds: int = 60) -> Array | None:
    """The hull, (2, 3), of all that may be body in the box; None where nothing is."""
    for _ in range(rounds):
        hull = _hull(terms, box, flat)
        if hull is None:
            return None
        done = bool(np.all(hull[1] - hull[0] >= 0.8 * (box[1] - box[0])))
        box = hull
        if done:
            break
    return box


def _hull(terms: Terms, box: Array, flat: bool) -> Array | None:
    """One look at the box: cells that hold nothing are dropped, those at the hull's sides split and looked at again."""
    counts = np.array([_COARSE, _COARSE, 1 if flat else _COARSE])
    cells = np.stack(np.meshgrid(*[np.arange(n) for n in counts], indexing="ij"), axis=-1).reshape(-1, 3)
    kept = np.empty((2, 0, 3))
    parts = _Parts(terms, box)
    while True:
        low, high = _cell_box(box, counts, cells)
        alive = parts.alive(cells * _PARTS // counts, low, high)
        cells, low, high = cells[alive], low[alive], high[alive]
        corners = np.concatenate([kept, np.stack([low, high])], axis=1)
        if not corners.shape[1]:
            return None
        hull = np.stack([corners[0].min(axis=0), corners[1].max(axis=0)])
        outer = np.any(((low == hull[0]) | (high == hull[1]))[:, : 2 if flat else 3], axis=1)
        if counts[0] >= _FINE or np.count_nonzero(outer) * 8 > _MOST_CELLS:
            return hull
        kept = np.concatenate([kept, np.stack([low[~outer], high[~outer]])], axis=1)
        halves = np.stack(np.meshgrid([0, 1], [0, 1], [0] if flat else [0, 1], indexing="ij"), axis=-1).reshape(-1, 3)
        split = np.array([2, 2, 1 if flat else 2])
        cells = (cells[outer][:, None] * split + halves).reshape(-1, 3)
        counts = counts * split


class _Parts:
    """A box in parts along each side; a cell asks only the terms that can matter in its part."""

    def __init__(self, terms: Terms, box: Array) -> None:
        self._terms, self._box = terms, box
        self._own: dict[bytes, Terms] = {}

    def alive(self, parts: Indices, low: Array, high: Array) -> NDArray[np.bool_]:
        """(n,) whether cells from low to high, (n, 3), may hold some of the body; `parts` (n, 3) says in which each lies."""
        if len(self._terms) < _FEW:
            return box_tops(self._terms, low, high) > 0
        alive = np.empty(len(low), dtype=bool)
        every, which = np.unique(parts, axis=0, return_inverse=True)
        for number, part in enumerate(every):
            here = which == number
            alive[here] = box_tops(self._of(part), low[here], high[here]) > -_LEFT_OUT
        return alive

    def _of(self, part: Indices) -> Terms:
        key = part.tobytes()
        if key not in self._own:
            low, high = _cell_box(self._box, np.full(3, float(_PARTS)), part)
            self._own[key] = relevant_terms(self._terms, low, high, _FAINT)
        return self._own[key]


def _cell_box(box: Array, counts: Array, cells: Array | Indices) -> tuple[Array, Array]:
    """Corners of cells, numbered along each axis; the outermost lie exactly on the box."""
    low, high = box
    share = cells / counts, (cells + 1) / counts
    return low * (1 - share[0]) + high * share[0], low * (1 - share[1]) + high * share[1]
