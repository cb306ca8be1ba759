"""Edges of the grid that the surface crosses, straight ones and those of which an end has moved, and points on them."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .grid import Grid
from .mesh import Array, dots, rows, unit
from .sampling import Samples


class Edges(NamedTuple):
    """Edges of the grid: from `start` (n, 3) along `axis` (n,), so `long` (n,); `ends` (n, 2) are the samples at both ends.

    They are in the order of their axes.
    """

    start: Array
    axis: NDArray[np.int64]
    long: Array
    ends: Samples

    @classmethod
    def of(cls, grid: Grid, node: NDArray[np.int64], axis: NDArray[np.int64], ends: Samples) -> Edges:
        long = [np.diff(grid.nodes[i]).take(node[here, i]) for i, here in enumerate(_by_axis(axis))]
        return cls(grid.points(node), axis, np.concatenate(long), ends)

    def some(self, which: NDArray[np.intp]) -> Edges:
        """Some of them."""
        return Edges(*(rows(values, which) for values in self))

    def at(self, share: Array) -> Array:
        """The points (n, 3) at those shares (n,) of the edges."""
        points = self.start.copy(order="F")
        for i, here in enumerate(_by_axis(self.axis)):
            points[here, i] += self.long[here] * share[here]
        return points

    def aside(self, apart: float, share: Array, points: Array, slopes: Array) -> Array:
        """The points (n, 3) at those shares (n,) moved off the nearer node, along the edge."""
        return self.at(np.clip(share, apart, 1 - apart))

    def gain(self, slopes: Array) -> Array:
        """How much a field with the gradients (n, 3) gains along each, (n,)."""
        return np.concatenate([slopes[here, i] for i, here in enumerate(_by_axis(self.axis))]) * self.long


def _by_axis(axis: NDArray[np.int64]) -> list[slice]:
    """Which of the ascending axes (n,) are the first, the second and the third."""
    ends = np.searchsorted(axis, range(4)).tolist()
    return [slice(*pair) for pair in pairwise(ends)]


class Askew(NamedTuple):
    """Edges of the grid of which an end has moved: from `start` (n, 3) as far as `way` (n, 3); the rest is as for `Edges`."""

    start: Array
    way: Array
    axis: NDArray[np.int64]
    ends: NDArray[np.floating[Any]]

    @classmethod
    def of(cls, grid: Grid, node: NDArray[np.int64], axis: NDArray[np.int64], ends: Samples, aside: Array) -> Askew:
        start = grid.points(node + aside[:, 0])
        return cls(start, grid.points(node + np.eye(3)[axis] + aside[:, 1]) - start, axis, ends)

    def some(self, which: NDArray[np.intp]) -> Askew:
        """Some of them."""
        return Askew(self.start[which], self.way[which], self.axis[which], self.ends[which])

    def at(self, share: Array) -> Array:
        """The points (n, 3) at those shares (n,) of the edges."""
        return self.start + share[:, None] * self.way

    def aside(self, apart: float, share: Array, points: Array, slopes: Array) -> Array:
        """The points (n, 3) at those shares (n,) moved off the nearer node, along the surface, as across a sheet is no room."""
        normal = unit(slopes)
        way = self.way - dots(self.way, normal)[:, None] * normal
        return points + np.where(share < 0.5, apart, -apart)[:, None] * way

    def gain(self, slopes: Array) -> Array:
        """How much a field with the gradients (n, 3) gains along each, (n,)."""
        return dots(slopes, self.way)
