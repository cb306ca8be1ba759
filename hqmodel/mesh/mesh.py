"""A triangle mesh as a plain value, and the one error that meshing ends in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Triangles = NDArray[np.int64]


class MeshError(Exception):
    """There is no mesh to make, and the message says why in one line."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in counter-clockwise order seen from outside.

    `vertices` (V, 3) and `faces` (F, 3); `normals` (V, 3) are unit and outward, `colors` (V, 3) sRGB in 0..1.
    `surface_error` is the largest measured distance of a face's middle from the true surface, in the mesh's own unit.
    """

    vertices: Array
    faces: Triangles
    normals: Array | None = None
    colors: Array | None = None
    surface_error: float | None = None


def reflected(mesh: Mesh, axis: int) -> Mesh:
    """The mesh together with its exact mirror image in the plane where coordinate `axis` is 0, joined along it.

    Vertices whose coordinate is exactly 0 are shared; the others must all lie on one side.
    """
    shared = mesh.vertices[:, axis] == 0
    flip = np.ones(3)
    flip[axis] = -1
    image_of = np.cumsum(~shared) - 1 + len(mesh.vertices)
    image_of[shared] = np.flatnonzero(shared)

    def both(values: Array | None, signs: Array | float) -> Array | None:
        return None if values is None else np.concatenate([values, values[~shared] * signs])

    vertices = both(mesh.vertices, flip)
    assert vertices is not None
    return Mesh(
        vertices + 0.0,
        np.concatenate([mesh.faces, image_of[mesh.faces][:, ::-1]]),
        both(mesh.normals, flip),
        both(mesh.colors, 1.0),
        mesh.surface_error,
    )
