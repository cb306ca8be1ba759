"""All-quad meshes of star-shaped bodies: the grid of a cube blown up onto the surface, by Newton's radii (eqs. 34-37).

The paper's own grid, latitude by longitude, is drawn together at its poles; a cube's has none, and nearly even cells. Unfolded,
the cube's faces make a cross, which gives texture coordinates: their only seams are its outline.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import (
    NotStarShaped,
    Region,
    Terms,
    mirror_axes,
    near_linear_gradient,
    radial_solution,
    region,
    star_centre,
)
from hqmodel.model import Scene

from .build import Progress
from .measure import depths, furthest, largest_distance
from .mesh import Array, Mesh, MeshError, Quads, lengths, unit
from .room import quads_must_have_room
from .shade import colored

Integers = NDArray[np.int64]
# Directions that are solved between two reports of progress.
_AT_ONCE = 1 << 14
# Of each face of the cube its direction, what is right and what is up on it as seen from outside, and its place in the cross.
_FACES = [
    ((0, -1, 0), (1, 0, 0), (0, 0, 1), (1, 1)),
    ((1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 1)),
    ((0, 1, 0), (-1, 0, 0), (0, 0, 1), (3, 1)),
    ((-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 1)),
    ((0, 0, 1), (1, 0, 0), (0, 1, 0), (1, 2)),
    ((0, 0, -1), (1, 0, 0), (0, -1, 0), (1, 0)),
]


class _Cube(NamedTuple):
    """The grid on a cube's faces, n cells to an edge: points (V, 3) from -n to n in steps of 2, and the cells' corners (6 n^2, 4)
    among them; the same for the cross, (U, 2) from 0 to 4 n and (6 n^2, 4).
    """

    points: Integers
    cells: Integers
    cross: Integers
    cross_cells: Integers


def radial_quads(scene: Scene, around: int = 256, progress: Progress | None = None) -> Mesh:
    """The scene's body as a closed mesh of quads in world units, with normals, colours and texture coordinates.

    `around`: how many quads there are round the equator, to the nearest multiple of 8. `faces` are the quads cut along their
    shorter diagonals. A scene that is its own mirror image gives a mesh that is, to the last bit. Raises MeshError where there
    is no body, one that is cut, or one that is not star-shaped, and where there is no memory for it.
    """
    tell = progress or (lambda share, doing: None)
    quads_must_have_room(around)
    tell(0.0, "Finding a centre")
    terms = Terms.of(scene)
    where = region(scene, terms)
    if where.empty:
        raise MeshError("no surface: the field is below its level everywhere")
    try:
        centre = star_centre(terms, where)
    except NotStarShaped as error:
        raise MeshError(str(error)) from None
    cube = _cube(2 * max(1, round(around / 8)))
    mesh = _blown_up(scene, terms, where, centre, cube, tell)
    tell(1.0, "Done")
    return replace(mesh, resolution=around)


def _cube(n: int) -> _Cube:
    j, i = np.divmod(np.arange((n + 1) ** 2), n + 1)
    corner = np.flatnonzero((i < n) & (j < n))
    cell = np.stack([corner, corner + 1, corner + n + 2, corner + n + 1], axis=1)
    points, cross = [], []
    for out, right, up, place in _FACES:
        points.append(n * np.array(out) + np.outer(2 * i - n, right) + np.outer(2 * j - n, up))
        cross.append(n * np.array(place) + np.stack([i, j], axis=1))
    cells = np.concatenate([cell + face * len(i) for face in range(len(_FACES))])
    unique, which = _distinct(np.concatenate(points))
    unfolded, place_of = _distinct(np.concatenate(cross))
    return _Cube(unique, which[cells], unfolded, place_of[cells])


def _distinct(rows: Integers) -> tuple[Integers, NDArray[np.intp]]:
    """The rows (m, k) that differ, in order, and which of them each of (n, k) is, (n,): by a number for each, to be quick."""
    low = rows.min(axis=0)
    numbers = np.ravel_multi_index(tuple((rows - low).T), tuple(rows.max(axis=0) - low + 1))
    _, first, which = np.unique(numbers, return_index=True, return_inverse=True)
    return rows[first], which


def _blown_up(scene: Scene, terms: Terms, where: Region, centre: Array, cube: _Cube, tell: Progress) -> Mesh:
    """The mesh about the centre: worked out on one side of the mirror planes, and put on the other by a change of sign."""
    n = int(np.max(cube.points))
    mirrored = np.isin(np.arange(3), mirror_axes(terms, where))
    own, which = _distinct(np.where(mirrored, np.abs(cube.points), cube.points))
    directions = unit(np.tan(np.pi / 4 * own / n))
    points = centre + _radii(terms, where, centre, directions, tell)[:, None] * directions
    slopes = near_linear_gradient(terms, points)[1]
    steepness = lengths(slopes)
    normals = np.where(steepness[:, None] > 0, unit(-slopes), directions)
    signs = np.where(mirrored & (cube.points < 0), -1.0, 1.0)
    vertices = points[which] * signs
    faces = _triangles(vertices, cube.cells, n)
    cell = float(np.max(where.size)) / n
    worst = furthest(depths(terms, vertices, faces, steepness[which], cell))
    return Mesh(
        vertices,
        faces,
        (normals[which] * signs).astype(np.float32),
        colored(scene, terms, points)[which],
        largest_distance(terms, vertices, faces[worst], cell),
        Quads(cube.cells.astype(np.int32), cube.cross / (4 * n) + (0, 0.125), cube.cross_cells.astype(np.int32)),
    )


def _radii(terms: Terms, where: Region, centre: Array, directions: Array, tell: Progress) -> Array:
    """The surface's distances (n,) along directions (n, 3), some thousand at a time."""
    radii = np.empty(len(directions))
    for start in range(0, len(directions), _AT_ONCE):
        tell(0.1 + 0.8 * start / len(directions), "Solving")
        here = slice(start, start + _AT_ONCE)
        solution = radial_solution(terms, where, centre, directions[here])
        if np.any(solution.iterations == 0):
            raise MeshError("expected a body that ends by itself, got one that its bounds, or a flat shape's plate, cut")
        radii[here] = solution.radius
    return radii


def _triangles(vertices: Array, cells: Integers, n: int) -> NDArray[np.int32]:
    """Cells (Q, 4) cut along their shorter diagonals; where both are as long, along that to the middle of the cube's face."""
    a, b, c, d = (vertices[cells[:, i]] for i in range(4))
    first, second = lengths(a - c), lengths(b - d)
    row, column = np.divmod(np.arange(len(cells)) % (n * n), n)
    inwards = (2 * row + 1 > n) == (2 * column + 1 > n)
    along = np.where(first == second, inwards, first < second)
    start = np.where(along, 0, 1)[:, None]
    turned = np.take_along_axis(cells, (np.arange(4) + start) % 4, axis=1)
    return np.concatenate([turned[:, :3], turned[:, [0, 2, 3]]]).astype(np.int32)
