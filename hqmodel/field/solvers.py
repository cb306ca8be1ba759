"""The paper's two other ways to solve H = C (section 4): searching a lattice, and growing a sphere along the normals.

Both ask nothing of the body: it may have holes and several parts. `radial_solution` needs a star-shaped one, and pays it back.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .evaluate import log_ratio
from .region import Region
from .straight import near_linear_gradient
from .terms import Array, Indices, Terms

_PRECISE = 1e-12
_MOST = 400
# The longest step of a point on its way, as a share of the region's diagonal.
_STRIDE = 0.03


class Lattice(NamedTuple):
    """The lattice's points within the body, (n, 3), and which of them have a neighbour without, (n,)."""

    points: Array
    outermost: NDArray[np.bool_]


class Evolved(NamedTuple):
    """Where points have come to, (n, 3), in how many evaluations of the field and its gradient, and which have arrived, (n,)."""

    points: Array
    iterations: Indices
    converged: NDArray[np.bool_]


def lattice_search(terms: Terms, region: Region, cells: int) -> Lattice:
    """All points within the body of a lattice that has so many cells along each side of its region.

    The surface passes within a cell of each of the outermost ones.
    """
    sides = [np.linspace(low, high, cells + 1) for low, high in zip(region.low, region.high, strict=True)]
    points = np.stack(np.meshgrid(*sides, indexing="ij"), axis=-1)
    inside = np.pad(log_ratio(terms, points) > 0, 1)
    core = (slice(1, -1),) * 3
    buried = np.logical_and.reduce([np.roll(inside, step, axis=axis)[core] for axis in range(3) for step in (1, -1)])
    return Lattice(points[inside[core]], ~buried[inside[core]])


def normal_evolution(terms: Terms, region: Region, directions: ArrayLike) -> Evolved:
    """Points of the surface grown from those of a sphere about the region, in directions (n, 3), along the field's gradient (23).

    Each goes on by Newton steps, cut to a short stride, until another would move it by less than rounding does. Where they end
    they are not laid out evenly: hollows get few, and of a part that others hide there may be none.
    """
    d = np.asarray(directions, dtype=float).reshape(-1, 3)
    diagonal = float(np.linalg.norm(region.size))
    points = region.centre + diagonal / 2 * d / np.linalg.norm(d, axis=1, keepdims=True)
    iterations = np.zeros(len(d), dtype=np.intp)
    converged = np.zeros(len(d), dtype=bool)
    active = np.arange(len(d))
    for _ in range(_MOST):
        linear, slope = near_linear_gradient(terms, points[active])
        size = np.maximum(np.linalg.norm(slope, axis=1), 1e-200)
        step = np.clip(linear / size, -_STRIDE * diagonal, _STRIDE * diagonal)
        points[active] -= (step / size)[:, None] * slope
        iterations[active] += 1
        converged[active] = np.abs(step) < _PRECISE * diagonal
        active = active[~converged[active]]
        if not active.size:
            break
    return Evolved(points, iterations, converged)
