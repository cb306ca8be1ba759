"""What is done to the joined mesh as a whole: faces laid evenly about the surface, creases put back, mirror images joined."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, near_linear_gradient
from hqmodel.model import Scene

from .creases import creased
from .decimate import simplified
from .grid import Grid
from .manifold import parted
from .measure import depths, largest_distance
from .mesh import Array, Mesh, Triangles, alike, lengths, reflected
from .refine import to_surface
from .shade import clothed, colored, on_caps, with_caps
from .splits import Plane
from .tolerance import Surface, adapted
from .weld import Weld

# Vertices on the surface leave the triangles between them on one side of it. Moved out by this share of how far their faces'
# middles lie off, faces lie on both sides, at well under half the distance on average.
_SHARE = 0.75
# But never further than this share of the longest side, and not after faces that are further off than this share of a cell or
# whose corners' normals have a cosine below this.
_FURTHEST = 4e-5
_SMOOTH = 0.02
_ALIKE = 0.9
# The share of a cell that sums of distances count in whole multiples of, so as not to depend on the order of the faces.
_QUANTUM = 2.0**-20


def pulls(faces: Triangles, off: NDArray[np.float32], normals: NDArray[np.float32], cell: float) -> NDArray[np.float32]:
    """The sum of `off` (F,), in quanta, over the smooth faces about each vertex, and their number, (V, 2); `normals` (V, 3)."""
    smooth = (np.abs(off) < _SMOOTH * cell) & alike(normals, faces, _ALIKE)
    off = np.where(smooth, np.rint(off / (cell * _QUANTUM)), 0)
    result = np.zeros((2, len(normals)))
    for i in range(3):
        result[0] += np.bincount(faces[:, i], off, len(normals))
        result[1] += np.bincount(faces[:, i], smooth, len(normals))
    return result.T.astype(np.float32)


def finished(
    scene: Scene,
    terms: Terms,
    grid: Grid,
    weld: Weld,
    mirrored: tuple[int, ...],
    target_faces: int | None,
    tolerance: float | None,
    still: Callable[[], None],
) -> Mesh:
    """The whole mesh from its welded pieces: the part on one side of the mirror planes, and its images.

    `still` is called again and again; whatever it raises ends the work.
    """
    vertices, faces, off, normals = (weld.take(name) for name in ("vertices", "faces", "off", "normals"))
    _balance(vertices, normals, faces, off, weld.take("pull"), grid, mirrored)
    still()
    pinched, colors = weld.take("pinched"), weld.take("colors")
    planes = [(axis, plane) for axis, plane, _ in grid.cuts] + [(axis, 0.0) for axis in mirrored]
    split = creased(terms, vertices, normals, faces, off, grid.cell, planes, pinched, still)
    if split is not None:
        vertices, faces = np.concatenate([vertices, split.points]), split.faces
        normals = np.concatenate([normals, with_caps(split.normals, split.points, grid)])
        colors = np.concatenate([colors, colored(scene, terms, split.points)])
        pinched = np.append(pinched, np.zeros(len(split.points), dtype=bool))
        off = _measured(terms, grid, vertices, faces, off[split.origin], split.origin)
    still()
    share = len(faces) if target_faces is None else target_faces // 2 ** len(mirrored)
    error = 0.0
    if tolerance is not None or share < len(faces):
        if tolerance is not None:
            vertices, faces, error = adapted(Surface(terms, planes, grid.cell, still), vertices, faces, off, mirrored, tolerance)
        else:
            vertices, faces = _fewer(terms, grid, vertices, faces, mirrored, planes, share, still)
        within = np.ones(len(vertices), dtype=bool)
        within[faces[~on_caps(faces, vertices, grid)]] = False
        slopes = near_linear_gradient(terms, vertices)[1]
        normals, colors, off = clothed(scene, terms, grid, vertices, slopes, faces, within)
        pinched = np.full(len(vertices), pinched.any())
    still()
    mesh = Mesh(vertices, faces, normals, colors, max(error, largest_distance(terms, vertices, faces, off, grid.cell)))
    for axis in mirrored:
        still()
        pinched = np.append(pinched, pinched[mesh.vertices[:, axis] != 0])
        mesh = reflected(mesh, axis)
    return parted(mesh, pinched)


def _fewer(
    terms: Terms,
    grid: Grid,
    vertices: Array,
    faces: Triangles,
    mirrored: tuple[int, ...],
    planes: list[Plane],
    target: int,
    still: Callable[[], None],
) -> tuple[Array, Triangles]:
    """Vertices and faces of the part with so many faces, what lies in the planes kept in them."""
    held = np.zeros(vertices.shape, dtype=bool)
    for axis, plane in planes:
        held[:, axis] |= vertices[:, axis] == plane

    def place(points: Array, held: NDArray[np.bool_]) -> Array:
        return to_surface(terms, points, grid.cell, 5, held)[0]

    return simplified(vertices, faces, target, held, mirrored, place, still=still)


def _balance(
    vertices: Array,
    normals: NDArray[np.float32],
    faces: Triangles,
    off: NDArray[np.float32],
    pull: NDArray[np.float32],
    grid: Grid,
    mirrored: tuple[int, ...],
) -> None:
    """Move vertices along their normals, in place, so that the faces lie evenly on both sides of the surface; `off` follows.

    Vertices in a mirror plane stay in it, those in a cut where they are.
    """
    furthest = _FURTHEST * float(np.max(np.ptp(vertices, axis=0)))
    step = np.clip(np.float32(_SHARE * _QUANTUM * grid.cell) * pull[:, 0] / np.maximum(pull[:, 1], 1), -furthest, furthest)
    for axis, plane, _ in grid.cuts:
        step[vertices[:, axis] == plane] = 0
    for i in range(3):
        way = step * normals[:, i]
        if i in mirrored:
            way[vertices[:, i] == 0] = 0
        vertices[:, i] += way
    for i in range(3):
        off -= step[faces[:, i]] / 3


def _measured(
    terms: Terms, grid: Grid, vertices: Array, faces: Triangles, off: NDArray[np.float32], origin: NDArray[np.intp]
) -> NDArray[np.float32]:
    """`off` (F,) with that of the faces that are parts of others measured anew."""
    parts = np.flatnonzero(np.bincount(origin)[origin] > 1)
    parts = parts[~on_caps(faces[parts], vertices, grid)]
    corners, which = np.unique(faces[parts], return_inverse=True)
    slopes = lengths(near_linear_gradient(terms, vertices[corners])[1])
    off[parts] = depths(terms, vertices[corners], which.reshape(-1, 3).astype(np.int32), slopes)
    return off
