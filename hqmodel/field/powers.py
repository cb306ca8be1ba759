"""H_k from the strips' |h|: the one place where exponents are applied, used by values, derivatives and bounds alike.

|h|^gamma leaves float64 easily (10^1000), so powers saturate at `CEILING`, groups are scaled by their largest member, and where
a positive and a negative power both saturate their logarithms decide.
"""

from __future__ import annotations

import numpy as np

from .terms import HUGE, Array, Indices, Terms

CEILING = 1e300
# The largest whole exponent that multiplying is quicker for than the library's power.
_MOST_FACTORS = 64


def strip_functions(terms: Terms, points: Array) -> Array:
    """h (S, P) of every strip at points (P, 3); finite wherever the points are numbers.

    Worked out element by element: a point's value must not depend, to the last bit, on its neighbours in the array, as it
    would with a library's matrix product.
    """
    x, y, z = np.clip(points.T, -HUGE, HUGE, out=np.empty(points.T.shape))
    h: Array = terms.normal[:, 0, None] * x
    h += terms.offset[:, None]
    part = terms.normal[:, 1, None] * y
    h += part
    h += np.multiply(terms.normal[:, 2, None], z, out=part)
    return h


def lattice_functions(terms: Terms, x: Array, y: Array, z: Array) -> Array:
    """The same, to the last bit, at lattices of points x[i, p], y[j, p], z[k, p], of (a, n), (b, n) and (c, n): (S, a b c n).

    It takes little more than one addition each.
    """
    (nx, ny, nz), (x, y, z) = terms.normal.T[..., None, None], (np.clip(way, -HUGE, HUGE) for way in (x, y, z))
    h = nx * x + terms.offset[:, None, None]
    h = h[:, :, None] + (ny * y)[:, None]
    h = h[:, :, :, None] + (nz * z)[:, None, None]
    return np.asarray(h.reshape(len(h), -1))


def group_powers(terms: Terms, u: Array) -> Array:
    """(sum |h|^g)^(G/g) of every group, (G, P), from u = |h|, (S, P)."""
    with np.errstate(over="ignore"):
        if not terms.grouped:
            return np.minimum(power(u, terms.inner), CEILING)
        largest, spread = scaled(terms, u)
        # Rooted before it is raised: m^G may underflow where s^(G/g) overflows.
        size = largest * spread ** (1 / terms.inner[terms.group_start])[:, None]
        return np.minimum(power(size, terms.outer), CEILING)


def scaled(terms: Terms, u: Array) -> tuple[Array, Array]:
    """Each group's largest |h| and sum (|h| / largest)^g, both (G, P); the sum lies between 1 and the number of strips."""
    largest = np.maximum.reduceat(u, terms.group_start, axis=0)
    share = u / np.maximum(largest, np.finfo(float).tiny)[terms.group_of_strip]
    return largest, np.maximum(over_runs(power(share, terms.inner), terms.group_start), 1.0)


def term_sums(terms: Terms, v: Array, u: Array) -> Array:
    """H (K, P) from the group powers v (G, P); u only settles what overflowed."""
    if not terms.hyperbolic:
        return over_runs(v, terms.term_start)
    total = over_runs(v * terms.group_sign[:, None], terms.term_start)
    lost = np.flatnonzero(np.any(v >= CEILING, axis=0))
    if lost.size:
        total[:, lost] = _by_logarithm(terms, u[:, lost], total[:, lost])
    return total


def over_runs(rows: Array, starts: Indices) -> Array:
    """Sums over runs of rows (n, P) that begin at `starts`, (len(starts), P)."""
    count, runs = len(rows), len(starts)
    if runs == count:
        return rows
    even = count // runs
    if runs == 1 or (runs * even == count and np.array_equal(starts, np.arange(runs) * even)):
        return rows.reshape(runs, even, -1).sum(axis=1)
    totals = rows[starts]
    for total, start, end in zip(totals, (starts + 1).tolist(), [*starts[1:].tolist(), count], strict=True):
        for row in rows[start:end]:  # far quicker than `np.add.reduceat`, and the same whatever P is
            total += row
    return totals


def power(base: Array, exponents: Array) -> Array:
    """base ** exponents[:, None], (n, P), for bases >= 0; by multiplication where an exponent is a small whole number."""
    if np.all(exponents == exponents[0]):
        return _raised(base, float(exponents[0]))
    kinds = np.unique(exponents)
    if len(kinds) * 4 > len(exponents) and not np.any((kinds <= _MOST_FACTORS) & (kinds % 1 == 0)):
        return base ** exponents[:, None]
    result = np.empty(np.broadcast_shapes(base.shape, (len(exponents), 1)))
    for kind in kinds:
        rows = exponents == kind
        result[rows] = _raised(base[rows], float(kind))
    return result


def _raised(base: Array, exponent: float) -> Array:
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


def _by_logarithm(terms: Terms, u: Array, total: Array) -> Array:
    """H where powers overflow: its sign and saturated size from the logarithms of the powers."""
    with np.errstate(divide="ignore"):
        largest, spread = scaled(terms, u)
        ratio = terms.outer / terms.inner[terms.group_start]
        logs = np.maximum(terms.outer[:, None] * np.log(largest) + ratio[:, None] * np.log(spread), -1e4)
    top = np.maximum.reduceat(logs, terms.term_start, axis=0)
    parts = terms.group_sign[:, None] * np.exp(logs - top[terms.term_of_group])
    rest = over_runs(parts, terms.term_start)
    return np.where(top > np.log(CEILING), np.sign(rest) * CEILING, total)
