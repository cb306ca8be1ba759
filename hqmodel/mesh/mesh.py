"""A triangle mesh as a plain value, and the one error that meshing ends in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Triangles = NDArray[np.int32]
# The same in numbers of any size.
Faces = NDArray[np.integer[Any]]
_PART = 1 << 13


class MeshError(Exception):
    """There is no mesh to make, and the message says why in one line."""


@dataclass(frozen=True, eq=False)
class Quads:
    """A mesh's faces in fours: its vertices at the `corners` (Q, 4), and their places `uv` (U, 2) in the texture's unit square at
    the `uv_corners` (Q, 4).
    """

    corners: Triangles
    uv: Array
    uv_corners: Triangles


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in counter-clockwise order seen from outside.

    `vertices` (V, 3) and `faces` (F, 3); `normals` (V, 3) are unit and outward, `colors` (V, 3) sRGB in 0..255.
    `surface_error` is the largest measured distance of a face's middle from the true surface, in the mesh's own unit; of a mesh
    within a tolerance it is that of any point of its faces. Where the mesh has `quads`, the triangles are their halves.
    `resolution`: the cells along the longest side that it was made with.
    """

    vertices: Array
    faces: Triangles
    normals: NDArray[np.float32] | None = None
    colors: NDArray[np.uint8] | None = None
    surface_error: float | None = None
    quads: Quads | None = None
    resolution: int | None = None


def marks(marked: NDArray[np.bool_], faces: Faces) -> NDArray[np.uint8]:
    """How many corners of each face, (F,), are marked, (V,)."""
    of_vertex = marked.view(np.uint8)
    return of_vertex.take(faces[:, 0]) + of_vertex.take(faces[:, 1]) + of_vertex.take(faces[:, 2])


def rows(values: NDArray[Any], which: NDArray[np.intp]) -> NDArray[Any]:
    """values[which] for values (n,) or (n, k), which NumPy's indexing is several times slower at."""
    return values.T.take(which, axis=-1).T if values.flags.f_contiguous else values.take(which, axis=0)


def slices(count: int) -> list[slice]:
    """So many rows in parts that stay in a processor's cache."""
    return [slice(start, min(start + _PART, count)) for start in range(0, count, _PART)]


def dots(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """Scalar products (n,) of a and b, (n, 3) each; of no row does the last bit depend on its neighbours, as in np.einsum."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return ax * bx + ay * by + az * bz


def lengths(vectors: Array) -> Array:
    """Euclidean lengths (n,) of vectors (n, 3)."""
    return np.sqrt(dots(vectors, vectors))


def alike(normals: NDArray[np.float32], faces: Faces, cosine: float) -> NDArray[np.bool_]:
    """Whether the unit normals (V, 3) at the corners of each face, (F,), agree to within that cosine."""
    a, b, c = (rows(normals, faces[:, i].astype(np.intp, copy=False)) for i in range(3))
    return np.minimum(np.minimum(dots(a, b), dots(b, c)), dots(c, a)) > cosine


def unit(vectors: Array) -> Array:
    """Vectors (n, 3) divided by their lengths."""
    return vectors / np.maximum(lengths(vectors), 1e-200)[:, None]


def crosses(a: Array, b: Array) -> Array:
    """Vector products (n, 3) of a and b, (n, 3) each."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]).T


def areas(a: Array, b: Array, c: Array) -> Array:
    """Of triangles with corners a, b, c, (n, 3) each, (n,)."""
    return lengths(crosses(b - a, c - a)) / 2


def reflected(mesh: Mesh, axis: int) -> Mesh:
    """The mesh together with its exact mirror image in the plane where coordinate `axis` is 0, joined along it.

    Vertices whose coordinate is exactly 0 are shared; the others must all lie on one side.
    """
    shared = mesh.vertices[:, axis] == 0
    others = np.flatnonzero(~shared)
    flip = np.ones(3, dtype=np.float32)
    flip[axis] = -1
    image_of = (np.cumsum(~shared) - 1 + len(mesh.vertices)).astype(np.int32)
    image_of[shared] = np.flatnonzero(shared)
    normals, colors = mesh.normals, mesh.colors
    return Mesh(
        np.concatenate([mesh.vertices, rows(mesh.vertices, others) * flip]) + 0.0,
        np.concatenate([mesh.faces, image_of.take(mesh.faces)[:, ::-1]]),
        None if normals is None else np.concatenate([normals, rows(normals, others) * flip]),
        None if colors is None else np.concatenate([colors, rows(colors, others)]),
        mesh.surface_error,
    )
