"""H_k from the strips' |h|: the one place where exponents are applied, used by values, derivatives and bounds alike.

|h|^gamma leaves float64 easily (10^1000), so powers saturate at `CEILING`, groups are scaled by their largest member, and where
a positive and a negative power both saturate their logarithms decide.
"""

from __future__ import annotations

from functools import lru_cache

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
            v = power(u, terms.inner)
            return np.minimum(v, CEILING, out=v)
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
    kinds = _kinds(exponents.tobytes())
    if len(kinds) * 4 > len(exponents) and not any(_by_factors(kind) for kind, _ in kinds):
        return base ** exponents[:, None]
    result = np.empty(np.broadcast_shapes(base.shape, (len(exponents), 1)))
    for kind, rows in kinds:
        some = base[rows] if len(base) > 1 else base
        if isinstance(rows, slice):
            _raise(some, kind, result[rows])
        else:
            part = np.empty((len(rows), base.shape[1]))
            _raise(some, kind, part)
            result[rows] = part
    return result


@lru_cache(maxsize=256)
def _kinds(exponents: bytes) -> list[tuple[float, slice | Indices]]:
    """The different ones of float64 exponents, and which are of each kind."""
    values = np.frombuffer(exponents)
    which = [(float(kind), np.flatnonzero(values == kind)) for kind in np.unique(values)]
    return [(kind, slice(rows[0], rows[-1] + 1) if rows[-1] - rows[0] < len(rows) else rows) for kind, rows in which]


def _by_factors(exponent: float) -> bool:
    return exponent % 1 == 0 and 1 <= exponent <= _MOST_FACTORS


def _raise(base: Array, exponent: float, out: Array) -> None:
    """base ** exponent, into `out`."""
    if not _by_factors(exponent):
        np.power(base, exponent, out=out)
        return
    raised = base
    for digit in f"{int(exponent):b}"[1:]:
        raised = np.multiply(raised, raised, out=out)
        if digit == "1":
            out *= base
    if raised is base:
        out[:] = base


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
