"""What a mesh carries besides its places: normals, which at a cut lean towards the cap, colours, and faces' distances."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hqmodel.field import Terms, mixed_colors
from hqmodel.model import Scene

from .grid import Grid
from .measure import depths
from .mesh import Array, Faces, lengths, unit


def with_caps(normals: Array, vertices: Array, grid: Grid, within: NDArray[np.bool_] | None = None) -> NDArray[np.float32]:
    """The field's unit normals (V, 3) with those of the caps: the cap's own at vertices `within` one, halfway on its rim."""
    if grid.cuts:
        normals = normals.copy() if within is None else np.where(within[:, None], 0.0, normals)
        for axis, plane, side in grid.cuts:
            normals[:, axis] += np.where(vertices[:, axis] == plane, side, 0.0)
        normals = unit(normals)
    return normals.astype(np.float32)


def colored(scene: Scene, terms: Terms, vertices: Array) -> NDArray[np.uint8]:
    """sRGB colours (V, 3), 0 to 255."""
    return np.rint(mixed_colors(scene, terms, vertices) * 255).astype(np.uint8)


def clothed(
    scene: Scene, terms: Terms, grid: Grid, vertices: Array, slopes: Array, faces: Faces, within: NDArray[np.bool_]
) -> tuple[NDArray[np.float32], NDArray[np.uint8], NDArray[np.float32]]:
    """Normals (V, 3), colours (V, 3), and how far faces' middles lie below the surface, (F,) quanta, on caps 0.

    `slopes` (V, 3) are the near-linear field's gradients; `within` (V,) tells the vertices within a cap.
    """
    off = off_surface(terms, grid, vertices, slopes, faces)
    return with_caps(unit(-slopes), vertices, grid, within), colored(scene, terms, vertices), off


def off_surface(terms: Terms, grid: Grid, vertices: Array, slopes: Array, faces: Faces) -> NDArray[np.float32]:
    """How far the middles of faces lie below the surface, (F,) quanta, on caps 0; `slopes` (V, 3) as for `clothed`."""
    off = depths(terms, vertices, faces, lengths(slopes), grid.cell)
    off[on_caps(faces, vertices, grid)] = 0
    return off


def on_caps(faces: Faces, vertices: Array, grid: Grid) -> NDArray[np.bool_]:
    """Whether each face is part of a cap, (F,)."""
    result = np.zeros(len(faces), dtype=bool)
    for axis, plane, _ in grid.cuts:
        result |= np.all((vertices[:, axis] == plane)[faces], axis=1)
    return result
