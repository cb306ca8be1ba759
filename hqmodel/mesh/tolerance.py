"""A mesh within a tolerance of the true surface: triangles many where it curves, few where it is flat.

Faces that are too far off are split; then edges collapse as long as the faces about them stay near; at last every face is
measured at points no further apart than the cells of the grid that it came from, and split where need be.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, curvature, near_linear_gradient

from .creases import crossings
from .decimate import simplified
from .mesh import Array, Mesh, Triangles, areas, dots, lengths, marks
from .splits import ARRIVED, Indices, Part
from .stars import Bools, Near
from .surface import STEPS, Surface

Stage = tuple[Array, Triangles, Array]

# Cells along the longest side that a body is first looked at with, and the fewest and the most that are chosen for a tolerance.
COARSE, FEWEST, MOST = 48, 64, 512
# Cells no larger than the tolerance see all that is, and so many, along the longest side, are taken to see enough.
_ENOUGH = 256
# The share of the surface that cells are to be fine enough for as it curves; the rest is split.
_SMOOTH = 0.75
# Vertices that are further than this share of the side from the surface are within caps.
_THERE = 2e-4
# Triangles' largest size, as a share of the side, and how many there are for one of the integral: of 46 meshes of 26 shapes 29
# had that many within a factor of 1.25 and 39 within 1.5; where crests or tips keep a mesh from being reduced there are more.
_LARGEST, _EACH = 0.5, 0.67
# How many times finer to look again where a tolerance was not met, and how much finer than proportion would have it.
_AGAIN, _FINER = (1.4, 4.0), 1.1
# The shares of the tolerance that faces may be off before edges collapse, while they do, and at last.
_BEFORE, _MEANWHILE, _AT_LAST = 0.5, 0.85, 0.95
# How far off quadrics may think that faces come to lie, in tolerances: they judge on the safe side, ever more so.
_SURELY, _PERHAPS = 0.7, 3.0
_ROUNDS = 12
# How often a mesh is reduced in vain, and how far about faces that came to lie too far off it is left as it is the next time, in
# cells or tolerances, whichever are larger.
_TRIES, _ROOM = 5, 2.0
# How much further off a mesh that misses the tolerance itself may come to be, each time that it is reduced.
_WORSE = 1.35
# Faces whose middles are off by less than this share of the tolerance are not, elsewhere, off by what they may be.
_DOUBTFUL = 0.15


def adapted(
    surface: Surface,
    vertices: Array,
    faces: Triangles,
    off: NDArray[np.float32],
    mirrored: tuple[int, ...],
    tolerance: float,
) -> tuple[Array, Triangles, float]:
    """Vertices and faces of a mesh within `tolerance`, and how far it is off at most as measured, in world units.

    `off` (F,) is how far the middles of the faces given are.
    """
    away = np.abs(off).astype(float)
    doubtful = away > _DOUBTFUL * tolerance
    away[doubtful] = surface.off(vertices, faces[doubtful], _BEFORE * tolerance)
    stage = _refined(surface, vertices, faces, away, _BEFORE * tolerance)
    # First as far as quadrics alone warrant it: that is quick, and little is left to measure.
    for most, near in ((_SURELY, None), (_PERHAPS, surface.near(_MEANWHILE * tolerance))):
        stage = _reduced(surface, stage, mirrored, most * tolerance, near, tolerance)
    vertices, faces, away = stage
    return vertices, faces, float(np.max(away, initial=0.0))


def fineness(terms: Terms, coarse: Mesh, tolerance: float) -> int:
    """How many cells along the longest side a tolerance asks for, judged by a coarse mesh."""
    bending = Bending.of(terms, coarse)
    return bending.cells(tolerance / bending.side)


def finer(cells: int, error: float, tolerance: float) -> int:
    """How many cells would about meet a tolerance that so many missed; creases that they cut off shrink in proportion."""
    return int(np.ceil(cells * np.clip(_FINER * error / tolerance, *_AGAIN)))


class Bending(NamedTuple):
    """How a body bends, judged by a coarse mesh: the sizes of the principal curvatures (eqs. 24-26) at its vertices, `most` (V,)
    and `least` (V,), and the `areas` (V,) that these stand for, all in units of its longest `side`."""

    most: Array
    least: Array
    areas: Array
    side: float

    @classmethod
    def of(cls, terms: Terms, coarse: Mesh) -> Bending:
        """On caps there is no bend."""
        vertices, faces = coarse.vertices, coarse.faces
        side = float(np.max(np.ptp(vertices, axis=0)))
        gaussian, mean = curvature(terms, vertices)
        spread = np.sqrt(np.maximum(mean * mean - gaussian, 0.0))
        linear, slope = near_linear_gradient(terms, vertices)
        there = np.abs(linear) < _THERE * side * lengths(slope)
        a, b, c = vertices[faces.T]
        shares = np.bincount(faces.ravel(), np.repeat(areas(a, b, c) / 3, 3), len(vertices))
        most, least = ((np.abs(mean) + spread) * there, np.abs(np.abs(mean) - spread) * there)
        return cls(most * side, least * side, shares / side**2, side)

    def cells(self, tolerance: float) -> int:
        """How many cells along the longest side a tolerance asks for, which is a share of that side.

        An edge of length l over the curvature k is off by k l^2 / 8; with cells of size sqrt(tolerance / k) their diagonals are
        off by a quarter of the tolerance.
        """
        curved = np.sqrt(float(np.quantile(self.most, _SMOOTH)) / tolerance)
        return int(np.clip(np.ceil(max(min(_ENOUGH, 1 / tolerance), curved)), FEWEST, MOST))

    def faces(self, tolerance: float) -> float:
        """About how many triangles a mesh within that tolerance has.

        The fewest that keep within e of a surface grow in number with the integral of sqrt(k1 k2) / e over it. No triangle is
        larger than some share of the body, as if no curvature were below that by which such a one would be off.
        """
        flat = 8 * tolerance / _LARGEST**2
        return _EACH / tolerance * float(np.sum(self.areas * np.sqrt(np.maximum(self.most, flat) * np.maximum(self.least, flat))))


def _reduced(
    surface: Surface, stage: Stage, mirrored: tuple[int, ...], most: float, near: Near | None, tolerance: float
) -> Stage:
    """The mesh with fewer faces, and how far each is off; where they come to be too far off, it is done again, with more care."""
    vertices, faces, off = stage
    allowed = max(tolerance, _WORSE * float(np.max(off[off > tolerance], initial=0.0)))
    held, room = surface.flat(vertices) > 0, _ROOM * max(surface.cell, tolerance)
    for _ in range(_TRIES):
        fewer = simplified(vertices, faces, 0, held, mirrored, surface.nearest, most, near, surface.still, surface.left)
        result = _refined(surface, *fewer, surface.off(*fewer, _AT_LAST * tolerance), _AT_LAST * tolerance)
        if not np.any(result[2] > allowed):
            return result
        held[surface.beside(vertices, result[0], result[1][result[2] > tolerance], room)] = True
        most, room = most / 2, 2 * room
    return stage


def _refined(surface: Surface, vertices: Array, faces: Triangles, off: Array, most: float) -> Stage:
    """The mesh with faces split that are further off than `most`, and how far each is; `off` (F,) is that before."""
    for _ in range(_ROUNDS):
        surface.still()
        bad = off > most
        if not bad.any():
            break
        marked = np.zeros(len(vertices), dtype=bool)
        marked[faces[bad]] = True
        near = marks(marked, faces) >= 2
        corners, which = np.unique(faces[near], return_inverse=True)
        part = Part(surface.terms, vertices[corners], which.reshape(-1, 3), surface.planes, surface.still)
        edges, middles, there = _splits(surface, part, off[near], most)
        part.split(*crossings(part, edges, surface.cell))
        count = len(part.points)
        there &= np.isin(edges @ (count, 1), part.edges()[0] @ (count, 1))  # those that no crease splits
        part.split(edges[there], middles[there])
        if len(part.points) == len(corners):
            break
        number = np.append(corners, np.arange(len(part.points) - len(corners)) + len(vertices)).astype(np.int32)
        vertices = np.concatenate([vertices, part.points[len(corners) :]])
        fresh = number[part.faces]
        known = off[near][part.origin]
        anew = np.bincount(part.origin)[part.origin] > 1
        known[anew] = surface.off(vertices, fresh[anew], most)
        faces, off = np.concatenate([faces[~near], fresh]), np.concatenate([off[~near], known])
    return vertices, faces, off


def _splits(surface: Surface, part: Part, off: Array, most: float) -> tuple[Indices, Array, Bools]:
    """One side of each face that is further off than `most`, where it may be split by its middle, and whether it can;
    `off` (F,) is how far each face is.

    The side that is off furthest itself, or the longest where none is off by half as much as the face.
    """
    bad = off > most
    sides = np.sort(np.stack([part.faces[bad], np.roll(part.faces[bad], -1, axis=1)], axis=2), axis=2)
    count = len(part.points)
    numbers, which = np.unique(sides.reshape(-1, 2) @ (count, 1), return_inverse=True)
    edges = np.stack(np.divmod(numbers, count), axis=1)
    a, b = part.points[edges.T]
    middles, last = part.settled((a + b) / 2, surface.cell, STEPS, part.held(edges))
    length, away = lengths(b - a), lengths(middles - (a + b) / 2)
    of_side = which.reshape(-1, 3)
    by_length = np.max(away[of_side], axis=1) < 0.5 * off[bad]
    chosen = np.where(by_length, np.argmax(length[of_side], axis=1), np.argmax(away[of_side], axis=1))
    wanted = np.unique(of_side[np.arange(len(chosen)), chosen])
    ahead = dots(part.looking(middles), part.normals[edges].sum(axis=1)) > 0
    there = (last < ARRIVED * surface.cell) & (away < 0.5 * length) & ahead
    return edges[wanted], middles[wanted], there[wanted]
