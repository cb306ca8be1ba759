"""H_k and its derivatives from the strips' h: the one place where exponents are applied, used by values and bounds alike.

Everything goes strip by strip in rows (P,) over the points, which NumPy is quicker with than with all strips at once: a row stays
in the cache, and a lone strip needs nothing that a group does.

|h|^gamma leaves float64 easily (10^1000), so powers saturate at `CEILING`, groups are scaled by their largest member, and where
a positive and a negative power both saturate their logarithms decide.
"""

from __future__ import annotations

import numpy as np

from .terms import HUGE, Array, Indices, Terms

CEILING = 1e300
_STEEP = 1e140
_TINY = float(np.finfo(float).tiny)
# The largest whole exponent that multiplying is quicker for than the library's power.
_MOST_FACTORS = 64


def power(base: Array, exponent: float) -> Array:
    """base ** exponent for bases >= 0; by multiplication where the exponent is a small whole number."""
    if exponent % 1 or not 1 <= exponent <= _MOST_FACTORS:
        return np.power(base, exponent)
    left, square, result = int(exponent), base, None
    while left:
        if left & 1:
            result = square if result is None else result * square
        left >>= 1
        square = square * square if left else square
    assert result is not None
    return result


def strip_functions(terms: Terms, points: Array) -> Array:
    """h (S, P) of every strip at points (P, 3); finite wherever the points are numbers.

    Worked out element by element: a point's value must not depend, to the last bit, on its neighbours in the array, as it
    would with a library's matrix product.
    """
    x, y, z = np.clip(points.T, -HUGE, HUGE, out=np.empty(points.T.shape))
    h, part = np.empty((len(terms.inner), len(x))), np.empty(len(x))
    for row, (nx, ny, nz), offset in zip(h, terms.normal.tolist(), terms.offset.tolist(), strict=True):
        np.multiply(nx, x, out=row)
        row += np.multiply(ny, y, out=part)
        row += np.multiply(nz, z, out=part)
        row += offset
    return h


def scaled(u: Array, inner: float) -> tuple[Array, Array]:
    """Largest and sum (|h| / largest)^g, (P,) each, of a group's u = |h|, (n, P); the sum lies between 1 and n."""
    largest = np.max(u, axis=0)
    share = power(u / np.maximum(largest, _TINY), inner)
    return largest, np.maximum(np.sum(share, axis=0), 1.0)


def group_size(terms: Terms, j: int, u: Array) -> Array:
    """(sum |h|^g)^(1/g) of group j, (P,), from u = |h|, (S, P): to be raised to G.

    Rooted before it is raised: m^G may underflow where s^(G/g) overflows.
    """
    first, end = terms.strips[j]
    if end - first == 1:
        return u[first]
    inner = float(terms.inner[first])
    largest, spread = scaled(u[first:end], inner)
    return largest * spread ** (1 / inner)


def term_sums(terms: Terms, u: Array, taking: Array | None = None) -> tuple[Array, Array]:
    """H from u = |h|, (S, P), and the sums without the signs, (K, P) each; groups of negative sign may have a u of their own."""
    totals, sizes = np.zeros((2, len(terms), u.shape[1]))
    for k, (total, size) in enumerate(zip(totals, sizes, strict=True)):
        groups = [(j, u if taking is None or terms.group_sign[j] > 0 else taking) for j in range(*terms.groups[k])]
        for j, of_group in groups:
            v = np.minimum(power(group_size(terms, j, of_group), float(terms.outer[j])), CEILING)
            size += v
            total += v if terms.group_sign[j] > 0 else -v
        lost = np.flatnonzero(size >= CEILING) if terms.hyperbolic else np.empty(0, dtype=np.intp)
        if lost.size:
            logs = [terms.outer[j] * np.log(group_size(terms, j, of_group[:, lost])) for j, of_group in groups]
            total[lost] = _by_logarithm(terms.group_sign[slice(*terms.groups[k])], np.stack(logs), total[lost])
    return totals, sizes


def _by_logarithm(sign: Array, logs: Array, total: Array) -> Array:
    """H of a term where powers overflow: its sign and saturated size from the powers' signs (n,) and logarithms (n, P)."""
    logs = np.maximum(logs, -1e4)
    top = np.max(logs, axis=0)
    rest = np.sum(sign[:, None] * np.exp(logs - top), axis=0)
    return np.where(top > np.log(CEILING), np.sign(rest) * CEILING, total)


def group_factor(outer: float, inner: float, largest: Array, spread: Array, order: int) -> Array:
    """G m^(G-order) s^(G/g-order), (P,), from a group's exponents and what `scaled` tells of it; 0 at m = 0 but for m^0."""
    # m^(G-order) may underflow where s^(G/g-order) overflows: rooted before it is raised
    raised = np.minimum(power(largest * spread ** (1 / inner), outer - order), _STEEP)
    factor = outer * np.minimum(raised * spread ** (order * (1 / inner - 1)), _STEEP)
    return factor if outer == order else np.where(largest > 0, factor, 0.0)


def share_power(share: Array, inner: float, order: int) -> Array:
    """r^(g-order), (P,); 0 at r = 0 unless the exponent is 0."""
    raised = np.minimum(share ** (inner - order), 1e100)
    return raised if inner == order else np.where(share > 0, raised, 0.0)


def strip_slopes(terms: Terms, h: Array) -> Array:
    """The derivatives (S, P) of the groups by their strips' h, (S, P).

    Of a group with largest member m, shares r = |h|/m and s = sum r^g it is G m^(G-1) s^(G/g-1) r^(g-1) sign(h).
    """
    result = np.sign(h)
    for (first, end), outer in zip(terms.strips, terms.outer.tolist(), strict=True):
        u, slope = np.abs(h[first:end]), result[first:end]
        if end - first == 1:
            steep = np.minimum(outer * np.minimum(power(u, outer - 1), _STEEP), _STEEP)
            slope *= steep if outer >= 1 else np.where(u > 0, steep, 0.0)
            continue
        inner = float(terms.inner[first])
        largest, spread = scaled(u, inner)
        shares = share_power(u / np.maximum(largest, _TINY), inner, 1)
        slope *= np.minimum(group_factor(outer, inner, largest, spread, 1) * shares, _STEEP)
    return result


def over_runs(rows: Array, starts: Indices) -> Array:
    """Sums over runs of rows (n, P) that begin at `starts`, (len(starts), P)."""
    count, runs = len(rows), len(starts)
    if runs == count:
        return rows
    even = count // runs
    if np.array_equal(starts, np.arange(runs) * even) and runs * even == count:
        return rows.reshape(runs, even, -1).sum(axis=1)
    return np.add.reduceat(rows, starts, axis=0)
