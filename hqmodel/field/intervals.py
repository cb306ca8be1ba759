"""Sound bounds of the log ratio L over boxes and along segments.

Every h_a is affine, so its range over a box or a segment is known exactly, and with it the range of each power; sums and
exponentials are monotone. Rounding is covered by padding outwards.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from .evaluate import exponents, log_balance
from .powers import group_powers, over_runs, strip_functions, term_sums
from .terms import HUGE, Array, Terms

_EPS = np.finfo(float).eps
_CELLS = 1 << 16
_Ranges = Callable[[Terms, Array, Array], tuple[Array, Array]]


def box_bounds(terms: Terms, low: ArrayLike, high: ArrayLike) -> tuple[Array, Array]:
    """Lower and upper bound of L, (n,) each, over the boxes from low to high, (n, 3) each."""
    return _in_slices(terms, box_ranges, np.asarray(low, dtype=float), np.asarray(high, dtype=float))


def box_tops(terms: Terms, low: ArrayLike, high: ArrayLike) -> Array:
    """Only the upper bound of L, (n,), over the boxes from low to high, (n, 3) each, with half the work."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    if not len(terms):
        return box_bounds(terms, low, high)[1]
    tops = np.empty(len(low))
    sides = [(side, terms.keep(side), sign) for side, sign in ((terms.positive, 1), (~terms.positive, -1)) if side.any()]
    for here in _slices(terms, len(low)):
        t = np.empty((len(terms), len(tops[here])))
        for side, own, sign in sides:
            middle, reach = box_ranges(own, low[here], high[here])
            size = np.abs(middle)
            least, most = np.maximum(size - reach, 0.0), size + reach
            bound, pad = _exponents(own, *((least, most) if sign > 0 else (most, least)))
            t[side] = bound + sign * pad
        tops[here] = log_balance(terms, t)
    return tops


def segment_bounds(terms: Terms, start: ArrayLike, end: ArrayLike) -> tuple[Array, Array]:
    """Lower and upper bound of L, (n,) each, along the straight segments from start to end, (n, 3) each."""
    return _in_slices(terms, _segment_ranges, np.asarray(start, dtype=float), np.asarray(end, dtype=float))


def term_bounds(terms: Terms, middle: Array, reach: Array) -> tuple[Array, Array]:
    """Bounds of every exponent T_k, (K, n) each, where h_a lies within `reach` of `middle`, (S, n) each."""
    size = np.abs(middle)
    least, most = np.maximum(size - reach, 0.0), size + reach
    t_low, low_pad = _exponents(terms, most, least)
    t_high, high_pad = _exponents(terms, least, most)
    return t_low - low_pad, t_high + high_pad


def _exponents(terms: Terms, adding: Array, taking: Array) -> tuple[Array, Array]:
    """T with positive groups at |h| = adding and negative ones at |h| = taking, and how far rounding may have moved it."""
    if terms.hyperbolic:
        adding = np.where((terms.group_sign > 0)[terms.group_of_strip][:, None], adding, taking)
    v = group_powers(terms, adding)
    sums = term_sums(terms, v, adding)
    size = over_runs(v, terms.term_start) if terms.hyperbolic else sums
    with np.errstate(over="ignore"):
        fixed = terms.hardness * np.abs(terms.constant) + np.abs(terms.log_coefficient) + 1
        pad = 64 * _EPS * np.minimum(terms.hardness[:, None] * size + fixed[:, None], 1e300)
    return exponents(terms, sums), pad


def _slices(terms: Terms, count: int) -> list[slice]:
    """What is worked on at once, of so many boxes or segments."""
    step = max(1, _CELLS // len(terms.inner))
    return [slice(begin, begin + step) for begin in range(0, count, step)]


def _in_slices(terms: Terms, ranges: _Ranges, first: Array, second: Array) -> tuple[Array, Array]:
    count = len(first)
    if not len(terms):
        empty = np.full(count, -np.inf if terms.level >= 0 else np.inf)
        return empty, empty
    lower, upper = np.empty(count), np.empty(count)
    for here in _slices(terms, count):
        t_low, t_high = term_bounds(terms, *ranges(terms, first[here], second[here]))
        lower[here], upper[here] = log_balance(terms, t_low, t_high), log_balance(terms, t_high, t_low)
    return lower, upper


def box_ranges(terms: Terms, low: Array, high: Array) -> tuple[Array, Array]:
    low, high = np.clip(low, -HUGE, HUGE), np.clip(high, -HUGE, HUGE)
    centre, half = low / 2 + high / 2, high / 2 - low / 2
    middle = strip_functions(terms, centre)
    size = np.abs(terms.normal)
    reach = size @ half.T
    reach += 8 * _EPS * (size @ np.abs(centre).T + np.abs(terms.offset)[:, None] + reach)
    return middle, reach


def _segment_ranges(terms: Terms, start: Array, end: Array) -> tuple[Array, Array]:
    first, second = strip_functions(terms, start), strip_functions(terms, end)
    size = np.abs(terms.normal) @ np.clip(np.maximum(np.abs(start), np.abs(end)), 0, HUGE).T
    pad = 8 * _EPS * (size + np.abs(terms.offset)[:, None])
    return (first + second) / 2, np.abs(second - first) / 2 + pad


def relevant_terms(terms: Terms, low: ArrayLike, high: ArrayLike, negligible: float = 50.0) -> Terms:
    """Only the terms that can matter for the surface in the box from low to high, (3,) each.

    On the surface P = N, so a term below both by more than exp(negligible) moves it by less than float64 resolves.
    """
    if len(terms) < 2:
        return terms
    t_low, t_high = term_bounds(terms, *box_ranges(terms, np.atleast_2d(low), np.atleast_2d(high)))
    sides = [float(np.max(t_low[side], initial=-np.inf)) for side in (terms.positive, ~terms.positive)]
    sides.append(float(np.log(abs(terms.level))) if terms.level else -np.inf)
    return terms.keep(t_high[:, 0] >= max(sides) - negligible)
