"""The field as the mesher asks for it: at nodes of the grid, between them, and where strips are thin."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, lattice_log_ratio, log_ratio, near_linear_gradient, near_linear_single, reaches, sharing

from .cull import relevant
from .grid import ALONG, BLOCK, Grid
from .mesh import Array, lengths

Samples = NDArray[np.float32]
Numbers = NDArray[np.int64]
Indices = NDArray[np.intp]
# Samples this near to the level are rounding: fields that stay at their level throughout (an octahedron's slices) have no body.
_ROUNDING = 1e-13
# Cells along a side of the cubes by which terms are left out: whole blocks.
CUBE = 64
# So many of these are remembered: what two runs of blocks pass through.
_CUBES = 512
# What a strip bounds may be thinner than a cell somewhere when it is thinner than so many at most.
_THIN = 4.0
# It tapers to less than a cell where that takes so many cells.
_TAPERS = 0.25
# Blocks sampled at once: what stays in a processor's cache.
_BLOCKS = 1 << 10
_STEPS = np.arange(BLOCK)[:, None]
# How far beside a thin part nodes belong to it, in cells.
_BESIDE = 1.5


class ThinStrip(NamedTuple):
    """A strip's function of the nodes' numbers: its `gradient` (3,) and what is added, `constant`.

    What it bounds is where all the shape's strips, `gradients` (k, 3) and `constants` (k,), are within the `room` (k,) that they
    have, or a cell and a half from it. It `adds` to the body or carves it, and is `thin` throughout or only tapers.
    """

    gradient: Array
    constant: float
    gradients: Array
    constants: Array
    room: Array
    adds: bool
    thin: bool

    def of(self, numbers: Array) -> Array:
        """The strip's function at numbers (n, 3), (n,)."""
        return numbers @ self.gradient + self.constant

    def near(self, numbers: Array, around: float = 0.0) -> NDArray[np.bool_]:
        """Whether numbers (n, 3), or what is so many cells around them, are where the shape may be, or next to it, (n,)."""
        room = self.room + around * np.sum(np.abs(self.gradients), axis=1)
        return np.all(np.abs(numbers @ self.gradients.T + self.constants) <= room, axis=1)


def by_cube(terms: Terms, grid: Grid) -> Callable[[int], Terms]:
    """The terms that matter in each cube of cells, by its number: of the last ones looked at they are known."""

    @lru_cache(maxsize=_CUBES)
    def within(cube: int) -> Terms:
        return relevant(terms, grid, (cube // ALONG % ALONG[1])[None] * CUBE, CUBE)

    return within


class Sampling:
    """A scene's `terms` on a grid, those that matter in each of its cubes, and those that do `here`, where it is looked at.
    `still` is called before each look; whatever it raises ends the work.

    What a node is told is the same to the last bit whatever else is looked at: terms that don't matter are left out by the cube
    of cells that it lies in.
    """

    def __init__(self, terms: Terms, within: Callable[[int], Terms], here: Terms, grid: Grid, still: Callable[[], None]) -> None:
        self._terms, self._within, self._here, self._grid, self._still = terms, within, here, grid, still

    @property
    def convex(self) -> bool:
        """Whether what is inside is convex: a single shape of exponents from 1, none of its strips hyperbolic."""
        terms = self._terms
        return (
            len(terms) == 1
            and bool(terms.positive[0] and np.all(terms.group_sign > 0))
            and min(float(np.min(terms.inner)), float(np.min(terms.outer))) >= 1
        )

    def at(self, nodes: NDArray[Any]) -> Samples:
        """The near-linear field at nodes (n, 3), whose numbers may have fractions: never 0, and -inf beyond a cut."""
        self._still()
        values = np.empty(len(nodes), dtype=np.float32)
        for which, terms in self._parts(nodes):
            values[which] = near_linear_single(terms, log_ratio(terms, self._grid.points(nodes[which])), _ROUNDING)
        for i, outside in enumerate(self._grid.outside):
            if outside.any():
                values[outside.take(nodes[:, i].astype(np.intp), mode="clip")] = -np.inf
        return values

    def of_blocks(self, first: Numbers) -> Samples:
        """The same at blocks' own nodes, (4, 4, 4, n), by the blocks' first ones (n, 3), to the last bit."""
        values = np.empty((BLOCK, BLOCK, BLOCK, len(first)), dtype=np.float32)
        every = np.arange(len(first))
        for part, terms in self._parts(first):
            here = every[part]
            for which in np.split(here, range(_BLOCKS, len(here), _BLOCKS)):
                self._still()
                ways = [first[which, i] + _STEPS for i in range(3)]
                points = (nodes.take(way, mode="clip") for nodes, way in zip(self._grid.nodes, ways, strict=True))
                values[..., which] = near_linear_single(terms, lattice_log_ratio(terms, *points), _ROUNDING)
        for i, outside in enumerate(self._grid.outside):
            if outside.any():
                np.moveaxis(values, i, 2)[..., outside.take(first[:, i] + _STEPS, mode="clip")] = -np.inf
        return values

    def along(self, nodes: Array, axis: Indices, share: Array) -> tuple[Array, Array, Array]:
        """The same, in double precision, at shares (n,) of the edges from nodes (n, 3) along an axis (n,), what it gains by a
        cell along it, (n,), and the most that it gains by a cell along any line. Nothing is cut."""
        self._still()
        values, slopes = np.empty(len(nodes)), np.empty((len(nodes), 3))
        for which, terms in self._parts(nodes):
            points = nodes[which] + share[which, None] * np.eye(3)[axis[which]]
            values[which], slopes[which] = near_linear_gradient(terms, self._grid.points(points))
        slopes *= self._grid.steps
        return values, slopes[np.arange(len(axis)), axis], lengths(slopes)

    def _parts(self, nodes: NDArray[Any]) -> Iterator[tuple[Indices | slice, Terms]]:
        """The nodes (n, 3) that lie in a cube together, and the terms that matter in it."""
        if len(self._terms) < 2 or not len(nodes):
            yield slice(None), self._terms
            return
        cube = (nodes.astype(np.int64) // CUBE) @ ALONG
        order = np.argsort(cube, kind="stable")
        for which in np.split(order, np.flatnonzero(np.diff(cube[order])) + 1):
            yield which, self._within(int(cube[which[0]]))

    def thin_strips(self) -> Iterator[ThinStrip]:
        """Strips that bound, or carve, something a few cells thick, or that tapers to less than a cell."""
        terms, steps = self._here, self._grid.steps
        gradient = terms.normal * steps
        constant = terms.offset + terms.normal @ self._grid.points(np.ones((1, 3), dtype=np.int64))[0] - np.sum(gradient, axis=1)
        room = reaches(terms, sharing(self._terms))
        with np.errstate(divide="ignore", invalid="ignore"):
            thick = 2 * reaches(terms, 0.0) / np.max(np.abs(gradient), axis=1)
        thin = thick < _THIN
        tapers = np.maximum(thick, 1.0) ** -terms.inner * max(len(nodes) for nodes in self._grid.nodes) > _TAPERS
        for strip in np.flatnonzero((thin | tapers) & (room > 0) & np.isfinite(room)).tolist():
            term = terms.term_of_strip[strip]
            own = terms.term_of_strip == term
            beside = room[own] + _BESIDE * np.sum(np.abs(gradient[own]), axis=1)
            adds = bool(terms.positive[term])
            yield ThinStrip(
                gradient[strip], float(constant[strip]), gradient[own], constant[own], beside, adds, bool(thin[strip])
            )
