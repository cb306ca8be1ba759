"""What is done to the joined mesh as a whole: seams balanced, creases put back, faces reduced, mirror images joined."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import log

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, near_linear_gradient
from hqmodel.model import Scene

from .balance import Balance
from .creases import creased
from .decimate import simplified
from .grid import Grid
from .manifold import parted
from .measure import QUANTUM, furthest, largest_distance
from .mesh import Array, Mesh, Triangles, reflected, slices
from .refine import to_surface
from .shade import clothed, colored, off_surface, on_caps, with_caps
from .surface import Surface
from .tolerance import adapted
from .weld import Weld

# A tolerance leaves about one of so many faces: what its progress is told by.
_TOLERABLE = 20


@dataclass
class _Told:
    """The share of the finishing that is done: by how many faces are left, from `most` to `fewest`. It never falls."""

    tell: Callable[[float], None]
    most: int = 0
    fewest: float = 0.0
    done: float = 0.0

    def still(self) -> None:
        """Tell it once more."""
        self.tell(self.done)

    def left(self, faces: int) -> None:
        """So many faces are left."""
        share = log(self.most / max(faces, 1)) / log(self.most / max(self.fewest, 1))
        self.done = min(max(self.done, share), 1.0)
        self.still()


def finished(
    scene: Scene,
    terms: Terms,
    balance: Balance,
    weld: Weld,
    target_faces: int | None,
    tolerance: float | None,
    tell: Callable[[float], None],
) -> Mesh:
    """The whole mesh from its welded pieces: the part on one side of the mirror planes, and its images.

    `tell` is told the share done (0..1) again and again; whatever it raises ends the work.
    """
    told = _Told(tell)
    still = told.still
    grid, mirrored = balance.grid, balance.mirrored
    vertices, faces, worst, normals = (weld.take(name) for name in ("vertices", "faces", "worst", "normals"))
    step = np.zeros(len(vertices), dtype=np.float32)
    step[weld.shared] = balance.steps(weld.pulls)
    for here in slices(len(vertices)):
        balance.move(vertices[here], normals[here], step[here])
    del step
    still()
    pinched, colors = weld.take("pinched"), weld.take("colors")
    planes = [(axis, plane) for axis, plane, _ in grid.cuts] + [(axis, 0.0) for axis in mirrored]
    split = creased(terms, vertices, normals, faces, weld.take("sharp"), grid.cell, planes, pinched, still)
    if split is not None:
        vertices, faces = np.concatenate([vertices, split.points]), split.faces
        normals = np.concatenate([normals, with_caps(split.normals, split.points, grid)])
        colors = np.concatenate([colors, colored(scene, terms, split.points)])
        pinched = np.append(pinched, np.zeros(len(split.points), dtype=bool))
        worst = _worst_of_parts(terms, grid, vertices, faces, worst, split.origin)
    still()
    share = len(faces) if target_faces is None else target_faces // 2 ** len(mirrored)
    error = 0.0
    if tolerance is not None or share < len(faces):
        told.most, told.fewest = len(faces), share if tolerance is None else len(faces) / _TOLERABLE
        surface = Surface(terms, planes, len(grid.cuts), grid.cell, still, told.left)
        if tolerance is not None:
            slopes = near_linear_gradient(terms, vertices)[1]
            off = off_surface(terms, grid, vertices, slopes, faces) * (QUANTUM * grid.cell)
            vertices, faces, error = adapted(surface, vertices, faces, off, mirrored, tolerance)
        else:
            vertices, faces = _fewer(surface, vertices, faces, mirrored, share)
        within = np.ones(len(vertices), dtype=bool)
        within[faces[~on_caps(faces, vertices, grid)]] = False
        slopes = near_linear_gradient(terms, vertices)[1]
        normals, colors, off = clothed(scene, terms, grid, vertices, slopes, faces, within)
        worst = furthest(off)
        pinched = np.full(len(vertices), pinched.any())
    still()
    mesh = Mesh(vertices, faces, normals, colors, max(error, largest_distance(terms, vertices, faces[worst], grid.cell)))
    for axis in mirrored:
        still()
        pinched = np.append(pinched, pinched[mesh.vertices[:, axis] != 0])
        mesh = reflected(mesh, axis)
    return parted(mesh, pinched, still)


def _fewer(
    surface: Surface, vertices: Array, faces: Triangles, mirrored: tuple[int, ...], target: int
) -> tuple[Array, Triangles]:
    """Vertices and faces of the part with so many faces, what lies in the planes kept in them."""

    def place(points: Array, held: NDArray[np.bool_]) -> Array:
        return to_surface(surface.terms, points, surface.cell, 5, held)[0]

    return simplified(
        vertices, faces, target, surface.flat(vertices) > 0, mirrored, place, still=surface.still, left=surface.left
    )


def _worst_of_parts(
    terms: Terms, grid: Grid, vertices: Array, faces: Triangles, worst: NDArray[np.integer], origin: NDArray[np.intp]
) -> NDArray[np.intp]:
    """The worst of the faces, those that are parts of others measured anew; `worst` are the numbers of what they are parts of."""
    parts = np.flatnonzero(np.bincount(origin)[origin] > 1)
    corners, which = np.unique(faces[parts], return_inverse=True)
    points = vertices[corners]
    off = off_surface(terms, grid, points, near_linear_gradient(terms, points)[1], which.reshape(-1, 3).astype(np.int32))
    return np.append(np.flatnonzero(np.isin(origin, np.setdiff1d(worst, origin[parts]))), parts[furthest(off)])
