"""The field, its derivatives and the curvature of its level sets, in float64 (eqs. 13, 14, 23, 26, 44).

Two forms of one function: F itself, as the contract defines it, and the **log ratio** L = ln P - ln N, where F = P - N, P the sum
of what adds and N of what carves, the level included. L has F's sign and surface, neither over- nor underflows, and is for a
lone shape with c = w = 1 just beta (C - H): what roots are sought and grids are sampled in.
"""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .powers import CEILING, group_powers, lattice_functions, over_runs, power, scaled, strip_functions, term_sums
from .terms import HUGE, Array, Indices, Terms

# Strips times points worked on at once: what stays in a processor's cache.
_CHUNK = 1 << 18
# exp of this is just inside float64.
_TOP = 709.0
_STEEP = 1e140


class Curvature(NamedTuple):
    """Gaussian and mean curvature, each (...,), in world units; mean positive on a sphere."""

    gaussian: Array
    mean: Array


def value(terms: Terms, points: ArrayLike) -> Array:
    """F at points (..., 3), shape (...,): positive inside, saturating at +-1.8e308 instead of overflowing (eq. 44)."""
    return _by_chunk(terms, points, _value)


def log_ratio(terms: Terms, points: ArrayLike) -> Array:
    """L = ln P - ln N at points (..., 3), shape (...,): positive inside, zero on the surface.

    Infinite only where the scene has nothing that adds, or nothing to hold against it: neither level nor carving shape.
    """
    return _by_chunk(terms, points, lambda t, p: log_balance(t, exponents(t, _sums(t, p))))


def lattice_log_ratio(terms: Terms, x: Array, y: Array, z: Array) -> Array:
    """The same, to the last bit, at lattices of points x[i, p], y[j, p], z[k, p], of (a, n), (b, n) and (c, n): (a, b, c, n)."""
    shape = len(x), len(y), len(z), x.shape[1]
    if not len(terms):
        return np.full(shape, log_ratio(terms, np.zeros(3)))
    result = np.empty(shape)
    step = max(1, _CHUNK // (len(terms.inner) * prod(shape[:3])))
    for here in (slice(start, start + step) for start in range(0, shape[3], step)):
        u = lattice_functions(terms, x[:, here], y[:, here], z[:, here])
        balance = log_balance(terms, exponents(terms, _sums_of(terms, np.abs(u, out=u))))
        result[..., here] = balance.reshape(*shape[:3], -1)
    return result


def gradient(terms: Terms, points: ArrayLike) -> Array:
    """The gradient of F at points (..., 3), shape (..., 3), per world unit (eq. 23); 0 across a kink."""
    return _by_chunk(terms, points, _gradient, columns=3)


def log_gradient(terms: Terms, points: ArrayLike) -> tuple[Array, Array]:
    """L (...,) and its gradient (..., 3) at points (..., 3); on the surface the gradient is F's in direction."""
    both = _by_chunk(terms, points, _log_gradient, columns=4)
    return both[..., 0], both[..., 1:]


def curvature(terms: Terms, points: ArrayLike) -> Curvature:
    """Curvatures at points (..., 3) of the level set through each (eq. 26; Goldman 2005, CAGD 22, sections 4.1 and 4.2).

    At kinks (h = 0 under an exponent below 2), where they do not exist, the kinked strip is left out.
    """
    both = _by_chunk(terms, points, _curvature, columns=2)
    return Curvature(both[..., 0], both[..., 1])


def shaping_strip(terms: Terms, points: ArrayLike) -> Indices:
    """For each point (..., 3) the strip whose share of the field's slope is largest: the face that a point belongs to."""
    return _by_chunk(terms, points, _shaping_strip).astype(np.intp)


def term_weights(terms: Terms, points: ArrayLike) -> Array:
    """Each term's share of sum |c_k| exp(beta_k (C_k - H_k)) at points (..., 3): (..., K), adding up to 1."""
    if not len(terms):
        return np.zeros((*np.shape(points)[:-1], 0))
    return _by_chunk(terms, points, _term_weights, columns=len(terms))


def exponents(terms: Terms, h_sums: Array) -> Array:
    """T_k = ln |c_k| + beta_k (C_k - H_k), (K, P), from H, (K, P): finite always."""
    t: Array = terms.constant[:, None] - h_sums
    with np.errstate(over="ignore"):
        t *= terms.hardness[:, None]
    t += terms.log_coefficient[:, None]
    return np.clip(t, -CEILING, CEILING, out=t)


def log_balance(terms: Terms, t: Array, t_carving: Array | None = None) -> Array:
    """L (P,) from the exponents T (K, P); for bounds the carving terms may take theirs from another array."""
    return _difference(*_log_sides(terms, t, t if t_carving is None else t_carving))


def _difference(p: Array, n: Array) -> Array:
    with np.errstate(invalid="ignore"):
        return np.where(p == n, 0.0, p - n)


def _log_sides(terms: Terms, t_adding: Array, t_carving: Array) -> tuple[Array, Array]:
    """ln P and ln N, (P,) each, from the exponents T (K, P) of what adds and of what carves."""
    adds, level = terms.positive, terms.level
    gain, loss = (t_adding, t_carving[:0]) if adds.all() else (t_adding[adds], t_carving[~adds])
    if level != 0:
        flat = np.full((1, t_adding.shape[1]), np.log(abs(level)))
        gain, loss = (_joined(gain, flat), loss) if level < 0 else (gain, _joined(loss, flat))
    return log_sum(gain), log_sum(loss)


def _joined(rows: Array, more: Array) -> Array:
    return np.concatenate([rows, more]) if len(rows) else more


def log_sum(t: Array) -> Array:
    """ln sum exp over the first axis; -inf where there is nothing to add."""
    if len(t) <= 1:
        return t[0] if len(t) else np.full(t.shape[1], -np.inf)
    top = np.max(t, axis=0)
    rest = t - top
    return top + np.log(np.sum(np.exp(rest, out=rest), axis=0))


def _sums(terms: Terms, points: Array) -> Array:
    h = strip_functions(terms, points)
    return _sums_of(terms, np.abs(h, out=h))


def _sums_of(terms: Terms, u: Array) -> Array:
    return term_sums(terms, group_powers(terms, u), u)


def _relative(terms: Terms, t: Array) -> tuple[Array, Array]:
    """Signed terms divided by the largest (K, P), and the logarithm of that (P,)."""
    top = np.max(t, axis=0)
    return np.sign(terms.coefficient)[:, None] * np.exp(t - top), top


def _value(terms: Terms, points: Array) -> Array:
    share, top = _relative(terms, exponents(terms, _sums(terms, points)))
    with np.errstate(over="ignore"):
        total = np.sum(share, axis=0) * np.exp(np.minimum(top, _TOP)) - terms.level
    return np.nan_to_num(total)


def _gradient(terms: Terms, points: Array) -> Array:
    jet = _Jet(terms, points)
    share, top = _relative(terms, jet.t)
    with np.errstate(over="ignore"):
        g = -np.einsum("kp,kip->ip", share * terms.hardness[:, None], jet.slope) * np.exp(np.minimum(top, _TOP))
    return np.nan_to_num(g)


def _log_gradient(terms: Terms, points: Array) -> Array:
    jet = _Jet(terms, points)
    p, n = _log_sides(terms, jet.t, jet.t)
    weights = jet.t - (p if terms.positive.all() else np.where(terms.positive[:, None], p, n))
    np.exp(weights, out=weights)
    weights *= -(np.sign(terms.coefficient) * terms.hardness)[:, None]
    jet.slope *= weights[:, None]
    result = np.empty((4, len(points)))
    result[0] = _difference(p, n)
    np.sum(jet.slope, axis=0, out=result[1:])  # not by np.einsum: of no point may the last bit depend on its neighbours
    return result


def _term_weights(terms: Terms, points: Array) -> Array:
    share = np.abs(_relative(terms, exponents(terms, _sums(terms, points)))[0])
    return share / np.sum(share, axis=0)


def _shaping_strip(terms: Terms, points: Array) -> Array:
    jet = _Jet(terms, points)
    share, _ = _relative(terms, jet.t)
    pull = np.abs(jet.by_strip) * (np.abs(share) * terms.hardness[:, None])[terms.term_of_strip]
    return np.argmax(pull * np.linalg.norm(terms.normal, axis=1)[:, None], axis=0).astype(float)


def _curvature(terms: Terms, points: Array) -> Array:
    jet = _Jet(terms, points)
    share, _ = _relative(terms, jet.t)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        lean = share * terms.hardness[:, None]
        g = -np.einsum("kp,kip->pi", lean, jet.slope)
        bend = np.einsum("kp,kip,kjp->pij", lean * terms.hardness[:, None], jet.slope, jet.slope)
        bend -= np.einsum("kp,kpij->pij", lean, jet.bend())
        length = np.linalg.norm(g, axis=1)
        n = g / length[:, None]
        bend /= length[:, None, None]
        gaussian = np.einsum("pi,pij,pj->p", n, _adjugate(bend), n)
        mean = (np.einsum("pi,pij,pj->p", n, bend, n) - np.trace(bend, axis1=1, axis2=2)) / 2
    return np.nan_to_num(np.stack([gaussian, mean]))


def _adjugate(m: Array) -> Array:
    """The adjugate of symmetric 3 x 3 matrices (P, 3, 3)."""
    a, b, c = m[:, 0], m[:, 1], m[:, 2]
    return np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=2)


class _Jet:
    """T (K, P), the gradient of every H, (K, 3, P), and on demand their second derivatives.

    Of a group with largest member m, shares r = |h|/m and s = sum r^g the derivatives by |h_a| are
    G m^(G-1) s^(G/g-1) r_a^(g-1) and G m^(G-2) s^(G/g-2) [(G-g) r_a^(g-1) r_b^(g-1) + delta_ab (g-1) s r_a^(g-2)].
    """

    def __init__(self, terms: Terms, points: Array) -> None:
        self.terms = terms
        h = strip_functions(terms, points)
        u = np.abs(h)
        self.sign = np.sign(h, out=h)
        if terms.grouped:
            self.largest, self.spread = scaled(terms, u)
            self.share = u / np.maximum(self.largest, np.finfo(float).tiny)[terms.group_of_strip]
        else:
            self.largest, self.spread, self.share = u, np.ones(1), np.ones(1)
        first = self._group_factor(1)
        self.t = exponents(terms, term_sums(terms, self._powers(u, first), u))
        first *= terms.outer[:, None]
        if terms.grouped:
            first = first[terms.group_of_strip] * self._share_power(1)
        self.by_strip = np.minimum(first, _STEEP, out=first)
        self.by_strip *= self.sign
        signed = self.by_strip * terms.group_sign[terms.group_of_strip][:, None] if terms.hyperbolic else self.by_strip
        self.slope = self._to_terms(signed)

    def _powers(self, u: Array, first: Array) -> Array:
        """The groups' powers, (G, P), from the lone strips' u^(g-1) where that is quicker."""
        if self.terms.grouped or np.any(self.terms.outer < 1):
            return group_powers(self.terms, u)
        with np.errstate(over="ignore"):
            v: Array = first * u
        return np.minimum(v, CEILING, out=v)

    def _group_factor(self, order: int) -> Array:
        """m^(G-order) s^(G/g-order), (G, P); 0 at m = 0 unless the exponent is 0."""
        terms = self.terms
        lowered = (terms.outer - order)[:, None]
        with np.errstate(over="ignore", divide="ignore"):
            size = self.largest
            if terms.grouped:  # m^(G-order) may underflow where s^(G/g-order) overflows: rooted before it is raised
                inner = terms.inner[terms.group_start][:, None]
                size = size * self.spread ** (1 / inner)
            result = power(size, terms.outer - order)
            np.minimum(result, _STEEP, out=result)
            if terms.grouped:
                result = np.minimum(result * self.spread ** (order * (1 / inner - 1)), _STEEP)
        return np.where((self.largest > 0) | (lowered >= 0), result, 0.0) if np.any(lowered < 0) else result

    def _share_power(self, order: int) -> Array:
        """r^(g-order), (S, P); 0 at r = 0 unless the exponent is 0."""
        if not self.terms.grouped:
            return self.share
        lowered = (self.terms.inner - order)[:, None]
        with np.errstate(over="ignore", divide="ignore"):
            raised = np.minimum(self.share**lowered, 1e100)
        return np.where((self.share > 0) | (lowered == 0), raised, 0.0)

    def _to_terms(self, by_strip: Array) -> Array:
        """Sum of by_strip (S, P) times the normals over each term's strips, (K, 3, P)."""
        terms = self.terms
        first_strip = terms.group_start[terms.term_start]
        result, part = np.empty((len(terms), 3, by_strip.shape[1])), np.empty_like(by_strip)
        for i in range(3):
            result[:, i] = over_runs(np.multiply(by_strip, terms.normal[:, i, None], out=part), first_strip)
        return np.clip(result, -HUGE, HUGE, out=result)

    def bend(self) -> Array:
        """The second derivatives of every H, (K, P, 3, 3)."""
        terms = self.terms
        sign = terms.group_sign[:, None]
        factor = self._group_factor(2) * terms.outer[:, None]
        diagonal = self._share_power(2) * ((factor * self.spread * sign)[terms.group_of_strip] * (terms.inner - 1)[:, None])
        first_strip = terms.group_start[terms.term_start]
        mixed = self._share_power(1) * self.sign
        lean = np.stack([over_runs(mixed * terms.normal[:, i, None], terms.group_start) for i in range(3)])
        cross = factor * sign * (terms.outer - terms.inner[terms.group_start])[:, None]
        result = np.empty((len(terms), diagonal.shape[1], 3, 3))
        for i in range(3):
            for j in range(i + 1):
                own = diagonal * (terms.normal[:, i] * terms.normal[:, j])[:, None]
                entry = over_runs(own, first_strip) + over_runs(cross * lean[i] * lean[j], terms.term_start)
                result[:, :, i, j] = result[:, :, j, i] = entry
        return result


def _by_chunk(terms: Terms, points: ArrayLike, work: Callable[[Terms, Array], Any], columns: int = 0) -> Array:
    """Apply `work` to points (..., 3) a cacheful at a time; the result is (...,) or (..., columns).

    `work` returns (P,) or (columns, P); the result too keeps each column together in memory, which is what NumPy is quick with.
    A scene with nothing in it has F = -level everywhere.
    """
    where = np.asarray(points, dtype=float)
    flat = where.reshape(-1, 3)
    result = np.zeros((max(columns, 1), len(flat)))
    if not len(terms):
        _fill_empty(terms, work, result)
    else:
        step = max(1, _CHUNK // len(terms.inner))
        for start in range(0, len(flat), step):
            result[:, start : start + step] = work(terms, flat[start : start + step])
    return result.T.reshape(*where.shape[:-1], columns) if columns else result.reshape(where.shape[:-1])


def _fill_empty(terms: Terms, work: Callable[[Terms, Array], Any], result: Array) -> None:
    if work is _value:
        result[:] = -terms.level
    elif len(result) == 1 or work is _log_gradient:
        result[0] = -np.inf if terms.level >= 0 else np.inf
