"""The field as the mesher asks for it: at nodes of the grid, between them, and where strips are thin."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, log_ratio, near_linear_gradient, near_linear_single, reaches

from .grid import Grid
from .mesh import Array, lengths

Samples = NDArray[np.float32]
Numbers = NDArray[np.int64]
Indices = NDArray[np.intp]
# Samples this near to the level are rounding: fields that stay at their level throughout (an octahedron's slices) have no body.
_ROUNDING = 1e-13
# What a strip bounds may be thinner than a cell somewhere when it is thinner than so many at most.
_THIN = 4.0
# How far beside a thin part nodes belong to it, in cells.
_BESIDE = 1.5


class ThinStrip(NamedTuple):
    """A strip's function of the nodes' numbers: its `gradient` (3,) and what is added, `constant`.

    What it bounds is where all the shape's strips, `gradients` (k, 3) and `constants` (k,), are within the `room` (k,) that they
    have, or a cell and a half from it.
    """

    gradient: Array
    constant: float
    gradients: Array
    constants: Array
    room: Array

    def of(self, numbers: Array) -> Array:
        """The strip's function at numbers (n, 3), (n,)."""
        return numbers @ self.gradient + self.constant

    def near(self, numbers: Array) -> NDArray[np.bool_]:
        """Whether numbers (n, 3) are where the shape may be, or next to it, (n,)."""
        return np.all(np.abs(numbers @ self.gradients.T + self.constants) <= self.room, axis=1)


class Sampling:
    """A scene's terms on a grid. `still` is called before each look; whatever it raises ends the work."""

    def __init__(self, terms: Terms, grid: Grid, still: Callable[[], None]) -> None:
        self._terms, self._grid, self._still = terms, grid, still

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
        values = near_linear_single(self._terms, log_ratio(self._terms, self._grid.points(nodes)), _ROUNDING)
        for i, outside in enumerate(self._grid.outside):
            if outside.any():
                values[outside.take(nodes[:, i].astype(np.intp), mode="clip")] = -np.inf
        return values

    def along(self, nodes: Array, axis: Indices) -> tuple[Array, Array, Array]:
        """The same at nodes (n, 3) in double precision, what it gains by a cell along an axis (n,), and the most that it gains by
        a cell along any line. Nothing is cut."""
        self._still()
        values, slopes = near_linear_gradient(self._terms, self._grid.points(nodes))
        slopes = slopes * self._grid.steps
        return values, slopes[np.arange(len(axis)), axis], lengths(slopes)

    def thin_strips(self) -> Iterator[ThinStrip]:
        """Strips that bound something of a few cells' thickness, or carve it."""
        terms, steps = self._terms, self._grid.steps
        gradient, reach = terms.normal * steps, reaches(terms, 0.0)
        constant = terms.offset + terms.normal @ self._grid.points(np.ones((1, 3), dtype=np.int64))[0] - np.sum(gradient, axis=1)
        for strip in np.flatnonzero((reach > 0) & (2 * reach < _THIN * np.max(np.abs(gradient), axis=1))).tolist():
            own = terms.term_of_strip == terms.term_of_strip[strip]
            room = reach[own] + _BESIDE * np.sum(np.abs(gradient[own]), axis=1)
            yield ThinStrip(gradient[strip], float(constant[strip]), gradient[own], constant[own], room)
