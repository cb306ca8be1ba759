"""The field on dense grids, as well as that way allows: what the other meshers are handed.

float32, in slabs that fit the cache, on all cores, near-linear across the surface, whole exponents by multiplication. Powers
are kept clear of float32's ends, where underflow would make them many times slower.
"""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms

Floats = NDArray[np.float32]

# The box that every mesher covers, whatever the body.
LOW, HIGH = -1.5, 1.5
_SLAB = 1 << 18
_LEAST, _MOST = 1.2e-38, 1e37
# exp of minus this is still a normal float32.
_FAINT = 80.0


def axis(cells: int) -> Floats:
    """The nodes along each side of the box, (cells + 1,)."""
    return np.linspace(LOW, HIGH, cells + 1, dtype=np.float32)


def volume(terms: Terms, cells: int) -> Floats:
    """The near-linear field at all nodes of the box, (cells + 1,) * 3: positive inside."""
    nodes = axis(cells)
    values = np.empty([len(nodes)] * 3, dtype=np.float32)
    rows = max(1, _SLAB // len(nodes) ** 2)

    def fill(start: int) -> None:
        values[start : start + rows] = near_linear(terms, nodes[start : start + rows], nodes, nodes)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(fill, range(0, len(nodes), rows)))
    return values


def near_linear(terms: Terms, x: Floats, y: Floats, z: Floats) -> Floats:
    """The near-linear field on the grid of three axes, for shapes of lone strips that add, coefficient and level 1."""
    root = 1 / float(terms.outer.max())
    if len(terms) == 1:
        return 1 - _power(_h_sum(terms, 0, x, y, z), root)
    total = np.zeros((len(x), len(y), len(z)), dtype=np.float32)
    for k in range(len(terms)):
        t = terms.hardness[k].astype(np.float32) * (terms.constant[k].astype(np.float32) - _h_sum(terms, k, x, y, z))
        total += np.exp(np.maximum(t, -_FAINT, out=t), out=t)
    ratio = np.log(total, out=total) / np.float32(terms.hardness.max())
    return 1 - _power(np.maximum(1 - ratio, np.float32(_LEAST)), root)


def _h_sum(terms: Terms, k: int, x: Floats, y: Floats, z: Floats) -> Floats:
    """H of term k: the sum of |h|^gamma over its strips."""
    total = np.zeros((len(x), len(y), len(z)), dtype=np.float32)
    for a in np.flatnonzero(terms.term_of_strip == k):
        gamma, (nx, ny, nz) = float(terms.inner[a]), terms.normal[a].astype(np.float32)
        h = (nx * x + np.float32(terms.offset[a]))[:, None, None] + (ny * y)[:, None] + nz * z
        least, most = max(_LEAST ** (1 / gamma), _LEAST), min(_MOST ** min(1 / gamma, 1.0), _MOST)
        total += _power(np.clip(np.abs(h, out=h), least, most, out=h), gamma)
    return total


def _power(base: Floats, exponent: float) -> Floats:
    """base ** exponent; many times quicker than NumPy's power wherever that has no vector instructions for it."""
    if exponent % 1 or exponent < 1:
        logs = np.log(base)
        return np.exp(np.multiply(logs, np.float32(exponent), out=logs), out=logs)
    left, square, result = int(exponent), base, None
    while left:
        if left & 1:
            result = square if result is None else result * square
        left >>= 1
        square = square * square if left else square
    assert result is not None
    return result
