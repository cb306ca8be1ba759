"""Rods, and channels, so thin that they run between the grid's lines: found by the strips that bound each shape, and measured.

What is thin one way only, a sheet, the mesher finds on those lines (see `sheets`).
"""

from __future__ import annotations

from itertools import combinations
from math import ceil
from typing import NamedTuple

import numpy as np
from numpy.random import default_rng
from numpy.typing import NDArray

from hqmodel.field import Region, Terms, log_ratio, mirror_axes, reaches, region
from hqmodel.model import Scene

from .build import USUAL_RESOLUTION
from .grid import make_grid
from .mesh import Array

# Places looked at in each shape's middle planes, and at how many, and what share of them, it has to be missed.
_PLACES, _FEWEST, _SHARE = 400, 10, 0.15
# Sheets thicker than so many times what the grid is sure to see are not looked at.
_THICK = 2.0
_HALVINGS = 20
# Three planes whose normals span less than this don't meet in a point worth speaking of.
_FLAT = 1e-6
# So many cells are enough across something thin, or, where it is seen by lines through its middle plane, along that. No less
# than so many times finer is any better.
_CELLS, _CELLS_WIDE, _FEWEST_FINER = 2.5, 4.0, 1.2


class Thin(NamedTuple):
    """A shape, by its number, that is thinner than the cells are wide, and the resolution that would see all of it."""

    shape: int
    resolution: int


def thin_parts(scene: Scene, resolution: int = USUAL_RESOLUTION) -> list[Thin]:
    """The shapes of which a good part is too thin, or carves too thin a channel, for a mesh of that resolution.

    What is thin along the unit normal n is seen whole by a grid with steps s where it is no thinner than the largest of
    |n_i| s_i, as then each of the grid's lines along that axis has a node in it; of a rod, one way of the two is enough.
    """
    terms = Terms.of(scene)
    where = region(scene, terms)
    if where.empty or not where.bounded:
        return []
    mirrored = mirror_axes(terms, where)
    grid = make_grid(where, resolution, mirrored).nodes
    nodes = [np.concatenate([-axis[:0:-1], axis]) if i in mirrored else axis for i, axis in enumerate(grid)]
    reach = reaches(terms, 0.0)
    reach[~np.isfinite(reach)] = 0.0
    look = _Look(terms, where, nodes, reach)
    needed = dict[int, float]()
    for strip in np.flatnonzero(look.length * look.across * _THICK > 2 * reach).tolist():
        thickness = look.thickness(strip)
        if thickness:
            shape = int(terms.strip_source[strip, 0])
            finer = min(_CELLS * look.across[strip] / thickness, _CELLS_WIDE * look.narrowest(strip))
            needed[shape] = max(needed.get(shape, _FEWEST_FINER), finer)
    return [Thin(shape, ceil(resolution * finer)) for shape, finer in sorted(needed.items())]


class _Look:
    """The middle planes of strips, looked at where a grid's nodes are; `reach` (S,) is how far |h| of each may go in the body.

    `across` (S,): how thick a sheet along each has to be for the grid to be sure to see it.
    """

    def __init__(self, terms: Terms, where: Region, nodes: list[Array], reach: Array) -> None:
        self._terms, self._where, self._nodes, self._reach = terms, where, nodes, reach
        self.length = np.linalg.norm(terms.normal, axis=1)
        self._normal = terms.normal / np.maximum(self.length, 1e-300)[:, None]
        steps = np.abs(self._normal) * [np.max(np.diff(axis)) for axis in nodes]
        self._axis, self.across = np.argmax(steps, axis=1), np.max(steps, axis=1)

    def narrowest(self, strip: int) -> float:
        """How much of a cell's width the shape of a strip has, inverted, where it is narrowest along the plane; 0 if endless."""
        own = (self._terms.term_of_strip == self._terms.term_of_strip[strip]) & (self._reach > 0)
        own[strip] = False
        return float(np.max(self.across[own] * self.length[own] / (2 * self._reach[own]), initial=0.0))

    def thickness(self, strip: int) -> float:
        """How thick the body, or what is carved from it, is about a strip's middle plane where the grid misses it.

        0 where it sees nearly all of it.
        """
        across, normal = self.across[strip], self._normal[strip]
        side = bool(self._terms.positive[self._terms.term_of_strip[strip]])
        places = self._places(strip)

        def within(share: Array | float) -> NDArray[np.bool_]:
            """Whether the places are on their own side that far, in multiples of `across`, along the normal."""
            return (log_ratio(self._terms, places + np.multiply.outer(share, across * normal)) > 0) == side

        places = places[within(0.0)]
        missed = ~within(_THICK / 2) & ~within(-_THICK / 2)
        missed &= (log_ratio(self._terms, self._on_lines(places, strip)) > 0) != side
        if np.count_nonzero(missed) < max(_FEWEST, _SHARE * len(places)):
            return 0.0
        places = places[missed]
        width = np.zeros(len(places))
        for way in (1.0, -1.0):
            low, high = np.zeros(len(places)), np.full(len(places), _THICK / 2)
            for _ in range(_HALVINGS):
                middle = (low + high) / 2
                inside = within(way * middle)
                low, high = np.where(inside, middle, low), np.where(inside, high, middle)
            width += high
        return float(across * np.median(width))

    def _on_lines(self, places: Array, strip: int) -> Array:
        """Where the grid's lines along the steepest axis that are nearest to each place (n, 3) pass the plane."""
        normal, axis = self._normal[strip], int(self._axis[strip])
        found = np.stack([_nearest(nodes, x) for nodes, x in zip(self._nodes, places.T, strict=True)], axis=1)
        found[:, axis] = places[:, axis]
        found[:, axis] -= (found - places) @ normal / normal[axis]
        return found

    def _places(self, strip: int) -> Array:
        """Points (n, 3) spread over a strip's middle plane where its shape may be, in the region."""
        rng, low, high = default_rng(0), self._where.low, self._where.high
        normal, offset, reach = self._terms.normal, self._terms.offset, self._reach
        own = np.flatnonzero((self._terms.term_of_strip == self._terms.term_of_strip[strip]) & (reach > 0))
        frames = np.array([(strip, *pair) for pair in combinations(own[own != strip], 2)], dtype=int).reshape(-1, 3)
        volumes = np.abs(np.linalg.det(self._normal[frames]))
        if np.max(volumes, initial=0.0) > _FLAT:
            chosen = frames[np.argmax(volumes)]
            h = rng.uniform(-1, 1, (_PLACES, 3)) * reach[chosen] * [0, 1, 1]
            places = np.linalg.solve(normal[chosen], (h - offset[chosen]).T).T
        else:
            places = rng.uniform(low, high, (_PLACES, 3))
            away = (places @ normal[strip] + offset[strip]) / self.length[strip]
            places = places - np.outer(away, self._normal[strip])
        return places[np.all((places >= low) & (places <= high), axis=1)]


def _nearest(nodes: Array, x: Array) -> Array:
    """Of ascending nodes those nearest to x (n,)."""
    after = np.clip(np.searchsorted(nodes, x), 1, len(nodes) - 1)
    return np.where(x - nodes[after - 1] < nodes[after] - x, nodes[after - 1], nodes[after])
