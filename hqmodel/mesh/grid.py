"""The sampling grid: where its nodes lie along each axis, and which of them are outside by decree."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Region

from .mesh import Array

BLOCK = 4
# What is added to the number that a cube of cells has for the next one along each axis.
ALONG = np.array([1 << 40, 1 << 20, 1])
# However thin a body is along an axis, it gets this many cells across it.
_FEWEST_CELLS = 8


@dataclass(frozen=True, eq=False)
class Grid:
    """Nodes along each axis, a whole number of blocks of `BLOCK` cells; `outside` marks nodes beyond a cut.

    Along a mirror axis the nodes start at 0 and only the upper half is sampled. At a cut the plane's nodes are repeated once
    as outside nodes, so that the cap lies in cells of no thickness, exactly on the cut.
    """

    nodes: tuple[Array, Array, Array]
    outside: tuple[NDArray[np.bool_], NDArray[np.bool_], NDArray[np.bool_]]

    @property
    def blocks(self) -> tuple[int, int, int]:
        """Blocks along each axis."""
        x, y, z = ((len(nodes) - 1) // BLOCK for nodes in self.nodes)
        return x, y, z

    @cached_property
    def steps(self) -> Array:
        """From node to node along each axis, (3,)."""
        return np.array([np.max(np.diff(nodes)) for nodes in self.nodes])

    @cached_property
    def cell(self) -> float:
        """The longest edge of a cell."""
        return float(np.max(self.steps))

    @property
    def cuts(self) -> list[tuple[int, float, float]]:
        """The planes that cut the body: axis, coordinate, and the side that is cut away."""
        planes = []
        for axis, (nodes, outside) in enumerate(zip(self.nodes, self.outside, strict=True)):
            if outside[0]:
                planes.append((axis, float(nodes[0]), -1.0))
            if outside[-1]:
                planes.append((axis, float(nodes[-1]), 1.0))
        return planes

    def corners(self, blocks: NDArray[np.integer[Any]], size: int) -> tuple[Array, Array]:
        """Corners (n, 3) of cubes of `size` cells, cut off at the grid's end, whose first nodes are `blocks` (n, 3)."""
        return self.points(blocks), self.points(blocks + size)

    def points(self, node: NDArray[Any]) -> Array:
        """World positions (n, 3) of nodes numbered (n, 3), those past the end at it; numbers with fractions lie between nodes."""
        if np.issubdtype(node.dtype, np.floating):
            return np.stack([np.interp(node[:, i], np.arange(len(nodes)), nodes) for i, nodes in enumerate(self.nodes)]).T
        return np.stack([nodes.take(node[:, i], mode="clip") for i, nodes in enumerate(self.nodes)]).T

    def touches_outside(self, blocks: NDArray[np.integer[Any]], size: int) -> NDArray[np.bool_]:
        """Whether cubes of cells hold nodes beyond a cut, (n,)."""
        touching = np.zeros(len(blocks), dtype=bool)
        for i, outside in enumerate(self.outside):
            if not outside.any():
                continue
            count = np.concatenate([[0], np.cumsum(outside)])
            last = np.minimum(blocks[:, i] + size, len(outside) - 1)
            touching |= count[last + 1] > count[blocks[:, i]]
        return touching


def make_grid(region: Region, resolution: int, mirrored: tuple[int, ...]) -> Grid:
    """A grid with `resolution` cells along the region's longest side, half of it along each mirror axis.

    The region's sides fall in the middle of cells, so that a body with flat sides keeps them away from the nodes.
    """
    cell = float(np.max(region.size)) / resolution
    axes = [_axis(region.low[i], region.high[i], cell, i in mirrored, region.cut) for i in range(3)]
    nodes, outside = tuple(axis[0] for axis in axes), tuple(axis[1] for axis in axes)
    return Grid((nodes[0], nodes[1], nodes[2]), (outside[0], outside[1], outside[2]))


def _axis(low: float, high: float, cell: float, mirrored: bool, cut: bool) -> tuple[Array, NDArray[np.bool_]]:
    count = max(_FEWEST_CELLS, ceil((high - low) / cell - 1e-9))
    nodes: Array
    if mirrored:
        nodes = _half_axis(max(high, -low), count, cut)
    elif cut:
        nodes = np.asarray(np.linspace(low, high, count + 1))
    else:
        step = (high - low) / count
        nodes = np.asarray(low + (np.arange(count + 2) - 0.5) * step)
    if not cut:
        return _whole_blocks(nodes, np.zeros(len(nodes), dtype=bool), nodes[-1] - nodes[-2])
    before = 0 if mirrored else 1
    outside = np.concatenate([np.ones(before, dtype=bool), np.zeros(len(nodes), dtype=bool), [True]])
    return _whole_blocks(np.concatenate([[low] * before, nodes, [nodes[-1]]]), outside, 0.0)


def _half_axis(high: float, count: int, cut: bool) -> Array:
    """Nodes from 0 outwards: up to the cut, or half a cell beyond the body."""
    half = (count + 1) // 2
    if cut:
        return np.asarray(np.linspace(0.0, high, half + 1))
    return np.asarray(np.arange(half + 2) * (high / (half + 0.5)))


def _whole_blocks(nodes: Array, outside: NDArray[np.bool_], step: float) -> tuple[Array, NDArray[np.bool_]]:
    """Nodes added at the end until the cells make whole blocks."""
    missing = -(len(nodes) - 1) % BLOCK
    return (
        np.concatenate([nodes, nodes[-1] + step * np.arange(1, missing + 1)]),
        np.concatenate([outside, np.full(missing, step == 0)]),
    )
