"""Which terms matter where: a grid of cells over the region, each with a list of them.

A ray, a shadow or a point of the surface then pays only for the shapes around it, whatever their number.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .packing import LIMIT, Packed

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

# Cells for each term that has an end, and most along a side.
_PER_TERM, _MOST = 12, 256
# How far, in the unit frame, a cell's list reaches beyond its borders: more than march.glsl oversteps them by.
_WIDER = 5e-5


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells in order of x, y and then z, each with the terms that are more than negligible somewhere in it."""

    low: Array  # (3,) where they begin
    size: Array  # (3,) of one cell
    counts: tuple[int, int, int]
    first: Indices  # (cells + 1,) where each one's list begins in
    terms: Indices  # the lists, one after the other
    rows: int  # the most rows of terms and strips that one list stands for

    def uniforms(self, start: int) -> dict[str, Any]:
        """What cells.glsl is told where the texels begin with number `start`."""
        return {"cell_rows": start, "cell_counts": self.counts, "cell_size": tuple(self.size), "cells_low": tuple(self.low)}

    def texels(self, start: int) -> NDArray[np.float32]:
        """(n, 4) from texel number `start` on: heads, x a list's first texel and y its length; then the lists."""
        heads = len(self.first) - 1
        texels = np.zeros((heads + len(self.terms), 4), dtype=np.float32)
        texels[:heads, 0] = start + heads + self.first[:-1]
        texels[:heads, 1] = np.diff(self.first)
        texels[heads:, 0] = self.terms
        return texels


def cells(packed: Packed, low: Array, high: Array) -> Cells:
    """Cells over the box from low to high, (3,) each, in the unit frame."""
    terms = packed.terms
    sides = np.maximum(high - low, 1e-6)
    wanted = max(1, _PER_TERM * int(np.count_nonzero(terms["high"][:, 0] < LIMIT)))
    spacing = float(np.prod(sides) / wanted) ** (1 / 3)
    counts = np.clip(np.ceil(sides / spacing), 1, _MOST).astype(int)
    size = sides / counts
    begin, end = (
        np.clip(np.floor((terms[name].astype(float) + wider - low) / size), 0, counts - 1).astype(int)
        for name, wider in (("low", -_WIDER), ("high", _WIDER))
    )
    inside = np.all((terms["high"] >= low - _WIDER) & (terms["low"] <= high + _WIDER), axis=1)
    term, cell = _pairs(begin, np.where(inside[:, None], end - begin + 1, 0))
    near = _near(packed, term, low + (cell + 0.5) * size, size / 2 + _WIDER)
    term, number = term[near], np.ravel_multi_index(tuple(cell[near].T[::-1]), tuple(counts[::-1]))
    order = np.argsort(number, kind="stable")
    first = np.concatenate([[0], np.cumsum(np.bincount(number, minlength=int(np.prod(counts))))])
    rows = np.bincount(number, weights=1 + terms["count"][term], minlength=1)
    return Cells(low, size, (int(counts[0]), int(counts[1]), int(counts[2])), first, term[order], int(np.max(rows)))


def _pairs(begin: Indices, extent: Indices) -> tuple[Indices, Indices]:
    """Every term with every cell (x, y, z) of its block: (n,) and (n, 3)."""
    total = np.prod(extent, axis=1)
    term = np.repeat(np.arange(len(total)), total)
    rest = np.arange(len(term)) - np.repeat(np.cumsum(total) - total, total)
    x, rest = rest % extent[term, 0], rest // extent[term, 0]
    y, z = rest % extent[term, 1], rest // extent[term, 1]
    return term, begin[term] + np.stack([x, y, z], axis=1)


def _near(packed: Packed, term: Indices, centre: Array, half: Array) -> NDArray[np.bool_]:
    """(n,) whether a term matters somewhere in the box about each centre, (n, 3), told strip by strip."""
    near = np.ones(len(term), dtype=bool)
    first, count = (packed.terms[name][term].astype(int) for name in ("first", "count"))
    for place in range(int(np.max(count, initial=0))):
        has = np.flatnonzero(near & (count > place))
        strips = packed.strips[first[has] + place]
        normal = strips["normal"].astype(float)
        h = np.einsum("ni,ni->n", normal, centre[has]) + strips["offset"]
        near[has] = np.abs(h) <= strips["reach"] * (1 + 1e-5) + np.abs(normal) @ half
    return near
