"""Sheets and grooves thinner than a cell, which cross an edge of the grid twice and which neither of its ends sees.

Where the field passes its level between two nodes on the same side of it, one of the two is moved there, along the edge. The grid
is bent a little then, but its cells and what joins them stay: what is found so has no holes, however thin and askew it is.

Of the lines of five nodes that run through a block, only the three in the middle move, and by what is known on that line: blocks
keep their sides, those that were culled too, and all blocks at a node move it alike.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .grid import BLOCK
from .mesh import Array
from .sampling import Indices, Numbers, Samples, Sampling

Named = Callable[[NDArray[np.integer[Any]]], Numbers]
# Edges, the share of each at which the field may be on the other side, and the field there.
Found = tuple[NDArray[Any], ...]
_CORNER = (BLOCK + 1,) * 3
_STEPS = np.arange(BLOCK + 1)
# Lines from two sides that meet so many times as far from the level as they come nearer to it by may be those of a sheet: above
# 1, as the field may rise ever faster towards it.
_WITHIN = np.float32(1.25)
_ROUNDS = 8
# An edge passes through a sheet where the field changes along it by this share of its steepest; else it grazes something round.
_THROUGH = 0.25
# Nodes stay so far apart, in cells.
_APART = 1e-3


class Moves(NamedTuple):
    """Nodes at `places` (m,), each once, moved by a `shift` (m,) in cells along an `axis` (m,), and their new `samples` (m,)."""

    places: Indices
    axis: Indices
    shift: Array
    samples: Samples


class _Edges(NamedTuple):
    """Edges (n,) between nodes on the same side: the place of the first node of their line, their axis, the places of both ends,
    and whether the line's nodes before and after are on that side too."""

    line: Indices
    axis: Indices
    start: Indices
    end: Indices
    before: NDArray[np.bool_]
    after: NDArray[np.bool_]


def moves(of_block: NDArray[np.int32], samples: Samples, named: Named, sampling: Sampling) -> Moves | None:
    """The moves that lead nodes into what is between them; None where nothing can be.

    `of_block` (125, n) tells which of the `samples` (p,) belong to each block's nodes in the order of their coordinates, and
    `named` the numbers (m, 3) of the nodes at places (m,).
    """
    parts = list(_in_thin_strips(of_block, samples, named, sampling))
    if not sampling.convex:
        parts.append(_at_peaks(of_block, samples, named, sampling))
    if not parts:
        return None
    line, axis, start, end, before, after, share, value = (np.concatenate(column) for column in zip(*parts, strict=True))
    parted = before | after
    back = np.where(parted, before & (~after | (share < 0.5)), start != line)
    place, shift = np.where(back, start, end), np.where(back, share, share - 1)
    found = (value > 0) == (samples[start] < 0)
    chosen = np.lexsort((axis, np.abs(shift), ~parted, ~found))
    chosen = chosen[(found | parted)[chosen]]
    for key in (line * 3 + axis, place):  # one on each line, so that what parts two sheets stays; one for each node
        chosen = chosen[np.sort(np.unique(key[chosen], return_index=True)[1])]
    return Moves(place[chosen], axis[chosen], shift[chosen], value[chosen])


class _Lines:
    """The nodes of blocks, given by their places (125, n), as lines along each axis; `samples` (p,) by place."""

    def __init__(self, of_block: NDArray[np.int32], samples: Samples) -> None:
        self.places = of_block.reshape(*_CORNER, -1)
        values = samples.take(self.places)
        self.size, self.outside = np.abs(values), values < 0

    def along(self, axis: int) -> list[NDArray[Any]]:
        """The places, the distances from the level, and whether they are outside, of the nodes of all lines, (5, ...) each."""
        return [np.moveaxis(values, axis, 0) for values in (self.places, self.size, self.outside)]

    def edges(self, hits: Callable[[int], Iterable[NDArray[np.bool_]]]) -> _Edges:
        """The edges that are hit, edge by edge of the lines along an axis, where their ends are on the same side."""
        parts = [self._hit(axis, number, hit) for axis in range(3) for number, hit in enumerate(hits(axis))]
        return _Edges(*(np.concatenate(column) for column in zip(*parts, strict=True)))

    def _hit(self, axis: int, number: int, hit: NDArray[np.bool_]) -> _Edges:
        place, size, out = self.along(axis)
        where = np.unravel_index(np.flatnonzero(hit), hit.shape)
        same = (out[number][where] == out[number + 1][where]) & np.isfinite(size[number][where] + size[number + 1][where])
        where = tuple(column[same] for column in where)
        line, start, end = (place[i][where].astype(np.intp) for i in (0, number, number + 1))
        before, after = (
            out[i][where] == out[number][where] if 0 <= i <= BLOCK else np.zeros(len(line), dtype=bool)
            for i in (number - 1, number + 2)
        )
        return _Edges(line, np.full_like(line, axis), start, end, before, after)


def _at_peaks(of_block: NDArray[np.int32], samples: Samples, named: Named, sampling: Sampling) -> Found:
    """Where the samples tell that there may be a peak, as between shapes and in cusps."""
    lines = _Lines(of_block, samples)
    edges = lines.edges(lambda axis: _suspect(*lines.along(axis)[1:]))
    outside = samples[edges.start] < 0
    share, value = _peaks(named(edges.start).astype(float), edges.axis, outside, sampling)
    hit = (value > 0) == outside
    return tuple(column[hit] for column in (*edges, share, value))


def _in_thin_strips(of_block: NDArray[np.int32], samples: Samples, named: Named, sampling: Sampling) -> Iterator[Found]:
    """The middle planes of thin strips: the field may tell nothing of those a cell away."""
    first = named(of_block[0]).astype(float)
    middle = first + BLOCK / 2
    for strip in sampling.thin_strips():
        crossed = np.flatnonzero(np.abs(strip.of(middle)) < np.sum(np.abs(strip.gradient)) * BLOCK / 2)
        crossed = crossed[strip.near(middle[crossed], BLOCK / 2)]
        if not crossed.size:
            continue
        i, j, k = np.multiply.outer(strip.gradient, _STEPS)
        ahead = i[:, None, None, None] + j[:, None, None] + k[:, None] + strip.of(first[crossed]) > 0
        edges = _Lines(of_block[:, crossed], samples).edges(partial(_changes, ahead))
        node = named(edges.start).astype(float)
        share = np.clip(-strip.of(node) / strip.gradient[edges.axis], _APART, 1 - _APART)
        node[np.arange(len(node)), edges.axis] += share
        near = strip.near(node)
        value, outside = sampling.at(node[near]), samples[edges.start[near]] < 0
        kept = (value > 0) == outside
        if strip.thin:
            kept |= outside == strip.adds
        yield *(column[near][kept] for column in (*edges, share)), value[kept]


def _changes(ahead: NDArray[np.bool_], axis: int) -> Iterator[NDArray[np.bool_]]:
    """Which edges of lines along an axis have ends of which one is ahead, (5, 5, 5, n), edge by edge."""
    sides = np.moveaxis(ahead, axis, 0)
    return (sides[number] != sides[number + 1] for number in range(BLOCK))


def _suspect(u: Samples, out: NDArray[np.bool_]) -> Iterator[NDArray[np.bool_]]:
    """Which edges of lines are suspect, edge by edge, by the nodes' distances (5, ...) from the level, and their sides.

    Straight lines through two nodes before and two after reach the level on the edge, or nearly; so does, at the ends of a line,
    the one that there is.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        same, rise = [out[i] == out[i + 1] for i in range(BLOCK)], [u[i + 1] - u[i] for i in range(BLOCK)]
        yield same[0] & same[1] & (u[1] < rise[1])
        for i in range(1, BLOCK - 1):
            before, after = -rise[i - 1], rise[i + 1]
            meeting = u[i] * after + u[i + 1] * before < _WITHIN * before * after
            yield same[i - 1] & same[i] & same[i + 1] & (before > 0) & (after > 0) & meeting
        yield same[-1] & same[-2] & (u[-2] < -rise[-2])


def _peaks(node: Array, axis: Indices, outside: NDArray[np.bool_], sampling: Sampling) -> tuple[Array, Samples]:
    """Where on each edge from `node` (n, 3) the field is furthest to the other side, (n,) as a share of it, and the field there.

    Where tangents to the field meet, or in the middle, by turns.
    """
    count = len(node)
    best, top = np.full(count, 0.5), np.full(count, -np.inf)
    side = np.where(outside, 1.0, -1.0)

    def look(which: Indices, share: Array) -> Array:
        value, slope, steepest = sampling.along(node[which], axis[which], share)
        return np.stack([share, side[which] * value, side[which] * slope, steepest])

    which = np.arange(count)
    low = look(which, np.zeros(count))
    which = np.flatnonzero(low[2] > _THROUGH * low[3])
    high = look(which, np.ones(len(which)))
    through = -high[2] > _THROUGH * high[3]
    low, which, high = low[:, which[through]], which[through], high[:, through]
    for turn in range(_ROUNDS):
        (a, fa, ga, _), (b, fb, gb, _) = low, high
        on = np.flatnonzero((ga > 0) & (gb < 0) & (fb * ga - fa * gb > _WITHIN * (b - a) * ga * gb))
        if not on.size:
            break
        which, low, high = which[on], low[:, on], high[:, on]
        (a, fa, ga, _), (b, fb, gb, _) = low, high
        x = (fb - gb * b - fa + ga * a) / (ga - gb)
        middle = look(which, np.where((turn % 2 == 0) & (x > a) & (x < b), x, a + (b - a) / 2))
        better = middle[1] > top[which]
        best[which[better]], top[which[better]] = middle[:2, better]
        up = middle[2] > 0
        low, high = np.where(up, middle, low), np.where(up, high, middle)
    return best, (side * top).astype(np.float32)
