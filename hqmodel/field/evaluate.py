"""The field, its derivatives and the curvature of its level sets, in float64 (eqs. 13, 14, 23, 26, 44).

Two forms of one function: F itself, as the contract defines it, and the **log ratio** L = ln P - ln N, where F = P - N, P the sum
of what adds and N of what carves, the level included. L has F's sign and surface, neither over- nor underflows, and is for a
lone shape with c = w = 1 just beta (C - H): what roots are sought and grids are sampled in.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .powers import CEILING, group_factor, scaled, share_power, strip_functions, strip_slopes, term_sums
from .terms import HUGE, Array, Indices, Terms

# Points worked on at once: what stays in a processor's cache.
_CHUNK = 1 << 13
# exp of this is just inside float64.
_TOP = 709.0


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
    return _by_chunk(terms, points, _log_ratio)


def gradient(terms: Terms, points: ArrayLike) -> Array:
    """The gradient of F at points (..., 3), shape (..., 3), per world unit (eq. 23); 0 across a kink."""
    return _by_chunk(terms, points, _gradient, columns=3)


def log_gradient(terms: Terms, points: ArrayLike) -> tuple[Array, Array]:
    """L (...,) and its gradient (..., 3) at points (..., 3); on the surface the gradient is F's in direction."""
    both = _by_chunk(terms, points, _log_gradient, columns=4)
    return both[..., 0], both[..., 1:]


def near_linear_gradient(terms: Terms, points: ArrayLike) -> tuple[Array, Array]:
    """The near-linear field (...,) and its gradient (..., 3) at points (..., 3).

    Their quotient is a Newton step that neither creeps from outside nor leaps from inside.
    """
    both = _by_chunk(terms, points, _near_linear_gradient, columns=4)
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


def near_linear(terms: Terms, ratio: Array) -> Array:
    """L made nearly linear across the surface, (...,): (H/C)^(1/gamma) turned inside out, for a lone shape.

    Same sign as L, 1 at most; what to hand to anything that interpolates.
    """
    hard, steep = _typical(terms)
    return 1.0 - np.maximum(1.0 - ratio / hard, 1e-300) ** (1.0 / steep)


def near_linear_single(terms: Terms, ratio: Array, rounding: float = 0.0) -> NDArray[np.float32]:
    """The same to single precision, some five times as quickly; the sign, and only it, is exact.

    Negative, too, where the field is no further above its level than `rounding`.
    """
    hard, steep = _typical(terms)
    root = np.log(np.clip(1.0 - ratio / hard, 1e-37, 1e37).astype(np.float32))
    root /= np.float32(steep)
    size = np.maximum(np.abs(1.0 - np.exp(root, out=root), out=root), np.float32(1e-37), out=root)
    return np.where(ratio > rounding * hard * steep, size, -size)


def _typical(terms: Terms) -> tuple[float, float]:
    """The largest hardness of what adds, and the largest exponent."""
    return float(np.max(terms.hardness[terms.positive], initial=1e-300)), float(np.max(terms.outer, initial=1.0))


def exponents(terms: Terms, h_sums: Array) -> Array:
    """T_k = ln |c_k| + beta_k (C_k - H_k), (K, P), from H, (K, P): finite always."""
    t = terms.hardness[:, None] * (terms.constant[:, None] - h_sums) + terms.log_coefficient[:, None]
    return np.clip(t, -CEILING, CEILING)


def log_balance(terms: Terms, t: Array, t_carving: Array | None = None) -> Array:
    """L (P,) from the exponents T (K, P); for bounds the carving terms may take theirs from another array."""
    p, n = log_side(terms, t, True), log_side(terms, t if t_carving is None else t_carving, False)
    return np.full(t.shape[1], p - n if np.all(p > -np.inf) else -np.inf)


def log_side(terms: Terms, t: Array, adding: bool) -> Array | float:
    """ln P, or ln N if not `adding`, from the exponents T (K, P), the level included; -inf where there is nothing to add."""
    rows: list[Array | float] = [t[k] for k in terms.sides[adding]]
    if terms.level and (terms.level < 0) == adding:
        rows.append(terms.log_level)
    if len(rows) < 2:
        return rows[0] if rows else -np.inf
    top = reduce(np.maximum, rows)
    return top + np.log(sum(np.exp(row - top) for row in rows))


class _Field:
    """h (S, P) and T (K, P) at points (P, 3), and what follows from them."""

    def __init__(self, terms: Terms, points: Array) -> None:
        self.terms = terms
        self.h = strip_functions(terms, points)
        self.t = exponents(terms, term_sums(terms, np.abs(self.h))[0])

    def slope(self) -> Array:
        """The gradient of every H, (K, 3, P)."""
        terms, by_strip = self.terms, strip_slopes(self.terms, self.h)
        result = np.zeros((len(terms), 3, self.h.shape[1]))
        for term, (begin, end) in zip(result, terms.groups, strict=True):
            for j in range(begin, end):
                for a in range(*terms.strips[j]):
                    for row, factor in zip(term, (terms.group_sign[j] * terms.normal[a]).tolist(), strict=True):
                        row += factor * by_strip[a]
        return np.clip(result, -HUGE, HUGE, out=result)

    def bend(self) -> Array:
        """The second derivatives of every H, (K, P, 3, 3).

        Of a group with largest member m, shares r = |h|/m and s = sum r^g those by |h_a| and |h_b| are
        G m^(G-2) s^(G/g-2) [(G-g) r_a^(g-1) r_b^(g-1) + delta_ab (g-1) s r_a^(g-2)].
        """
        terms = self.terms
        result = np.zeros((len(terms), self.h.shape[1], 3, 3))
        for j, (k, (first, end)) in enumerate(zip(terms.term_of_group, terms.strips, strict=True)):
            u, inner, outer = np.abs(self.h[first:end]), float(terms.inner[first]), float(terms.outer[j])
            if end - first == 1:
                inner = outer
            largest, spread = scaled(u, inner)
            share = u / np.maximum(largest, np.finfo(float).tiny)
            factor = group_factor(outer, inner, largest, spread, 2) * terms.group_sign[j]
            own = share_power(share, inner, 2) * (factor * spread * (inner - 1))
            lean = (share_power(share, inner, 1) * np.sign(self.h[first:end])).T @ terms.normal[first:end]
            result[k] += np.einsum("ap,ai,aj->pij", own, terms.normal[first:end], terms.normal[first:end])
            result[k] += np.einsum("p,pi,pj->pij", factor * (outer - inner), lean, lean)
        return result

    def share(self) -> tuple[Array, Array]:
        """Signed terms divided by the largest (K, P), and the logarithm of that (P,)."""
        top = np.max(self.t, axis=0, initial=-CEILING)
        return np.sign(self.terms.coefficient)[:, None] * np.exp(self.t - top), top


def _value(field: _Field) -> Array:
    share, top = field.share()
    return np.nan_to_num(np.sum(share, axis=0) * np.exp(np.minimum(top, _TOP)) - field.terms.level)


def _log_ratio(field: _Field) -> Array:
    return log_balance(field.terms, field.t)


def _gradient(field: _Field) -> Array:
    share, top = field.share()
    lean = share * field.terms.hardness[:, None]
    return np.nan_to_num(-np.einsum("kp,kip->ip", lean, field.slope()) * np.exp(np.minimum(top, _TOP)))


def _log_gradient(field: _Field) -> Array:
    terms, t = field.terms, field.t
    result = np.zeros((4, t.shape[1]))
    result[0] = log_balance(terms, t)
    sides = {adding: log_side(terms, t, adding) for adding in (False, True)}
    for k, (hardness, slope) in enumerate(zip(terms.hardness, field.slope(), strict=True)):
        adding = bool(terms.positive[k])
        # not by np.einsum: of no point may the last bit depend on its neighbours
        result[1:] += np.exp(t[k] - sides[adding]) * (-hardness if adding else hardness) * slope
    return result


def _near_linear_gradient(field: _Field) -> Array:
    result = _log_gradient(field)
    hard, steep = _typical(field.terms)
    inner = np.maximum(1.0 - result[0] / hard, 1e-300)
    root = inner ** (1.0 / steep)
    result[0] = 1.0 - root
    result[1:] = np.clip(result[1:] * (root / inner / (hard * steep)), -HUGE, HUGE)
    return result


def _term_weights(field: _Field) -> Array:
    share = np.abs(field.share()[0])
    return share / np.sum(share, axis=0)


def _shaping_strip(field: _Field) -> Array:
    terms = field.terms
    if not len(terms):
        return np.zeros(field.h.shape[1])
    weight = (np.abs(field.share()[0]) * terms.hardness[:, None])[terms.term_of_strip]
    length = np.linalg.norm(terms.normal, axis=1)[:, None]
    return np.argmax(np.abs(strip_slopes(terms, field.h)) * weight * length, axis=0).astype(float)


def _curvature(field: _Field) -> Array:
    hardness, slope = field.terms.hardness[:, None], field.slope()
    lean = field.share()[0] * hardness
    g = -np.einsum("kp,kip->pi", lean, slope)
    bend = np.einsum("kp,kip,kjp->pij", lean * hardness, slope, slope)
    bend -= np.einsum("kp,kpij->pij", lean, field.bend())
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


def _by_chunk(terms: Terms, points: ArrayLike, work: Callable[[_Field], Array], columns: int = 0) -> Array:
    """Apply `work` to points (..., 3) a cacheful at a time; the result is (...,) or (..., columns).

    `work` returns (P,) or (columns, P); the result too keeps each column together in memory, which is what NumPy is quick with.
    """
    where = np.asarray(points, dtype=float)
    flat = where.reshape(-1, 3)
    result = np.empty((max(columns, 1), len(flat)))
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        for start in range(0, len(flat), _CHUNK):
            result[:, start : start + _CHUNK] = work(_Field(terms, flat[start : start + _CHUNK]))
    return result.T.reshape(*where.shape[:-1], columns) if columns else result.reshape(where.shape[:-1])
