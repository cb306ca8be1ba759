"""Edges where two sheets of the surface touch, pulled apart.

Marching cubes may run a diagonal of one cell's polygon along a face where its neighbour, or its own mirror image, does the
same: four triangles then meet in an edge. Each of the two sheets gets a vertex of its own in the middle of that edge. Where
both cells even put a triangle into the face between them, back to back, the two are taken out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .mesh import Array, Mesh, Triangles, marks

_ROUNDS = 8
# How far the new vertex moves from the edge into its sheet.
_ASIDE = 0.1


def parted(mesh: Mesh, suspects: NDArray[np.bool_], still: Callable[[], None]) -> Mesh:
    """The mesh with at most two faces to every edge; itself where that holds already.

    `suspects` (V,) tells the vertices between which other edges may be. `still` is called now and then; whatever it raises ends
    the work.
    """
    still()
    twice = _directed_twice(mesh.faces, suspects)
    if twice:
        mesh = replace(mesh, faces=_without_folds(mesh.faces, np.unique(twice)))
    for _ in range(_ROUNDS):
        still()
        twice = _directed_twice(mesh.faces, suspects)
        if not twice:
            break
        mesh = _parted_once(mesh, twice)
        suspects = np.append(suspects, np.ones(len(mesh.vertices) - len(suspects), dtype=bool))
    return mesh


def _without_folds(faces: Triangles, corners: NDArray[np.int64]) -> Triangles:
    """Faces less those among the corners that lie upon each other back to back, which enclose nothing."""
    suspects = np.flatnonzero(np.all(np.isin(faces, corners), axis=1))
    _, group, count = np.unique(np.sort(faces[suspects], axis=1), axis=0, return_inverse=True, return_counts=True)
    return np.delete(faces, suspects[count[group.reshape(-1)] == 2], axis=0)


def _parted_once(mesh: Mesh, edges: list[tuple[int, int]]) -> Mesh:
    """One round over those edges that share no face with one already parted in it."""
    vertices, drop, added = list[Array](), set[int](), list[tuple[int, int, int]]()
    parents = list[int]()
    for a, b in edges:
        sheets = _sheets(mesh, a, b)
        if drop.intersection(face for sheet in sheets for face in sheet):
            continue
        for left, right in sheets:
            p, q = (int(next(c for c in mesh.faces[face] if c not in (a, b))) for face in (left, right))
            middle = (mesh.vertices[a] + mesh.vertices[b]) / 2
            new = len(mesh.vertices) + len(vertices)
            vertices.append(middle + _ASIDE * ((mesh.vertices[p] + mesh.vertices[q]) / 2 - middle))
            parents.append(a)
            drop |= {left, right}
            added += [(a, new, p), (new, b, p), (b, new, q), (new, a, q)]
    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, vertices]),
        faces=np.concatenate([np.delete(mesh.faces, sorted(drop), axis=0), np.array(added, dtype=np.int32)]),
        normals=None if mesh.normals is None else np.concatenate([mesh.normals, mesh.normals[parents]]),
        colors=None if mesh.colors is None else np.concatenate([mesh.colors, mesh.colors[parents]]),
    )


def _directed_twice(faces: Triangles, suspects: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Edges (a, b), a < b, between suspects (V,) along which more than one face runs in the same direction."""
    if not suspects.any():
        return []
    near = faces[marks(suspects, faces) >= 2].astype(np.int64)
    start, end = near.ravel(), np.roll(near, -1, axis=1).ravel()
    both = suspects[start] & suspects[end]
    keys, times = np.unique(start[both] * len(suspects) + end[both], return_counts=True)
    pairs = (divmod(int(key), len(suspects)) for key in keys[times > 1])
    return sorted({(min(pair), max(pair)) for pair in pairs})


def _sheets(mesh: Mesh, a: int, b: int) -> list[tuple[int, int]]:
    """Pairs of faces about the edge that belong together: of those running a to b each with the nearest running back."""
    around = np.flatnonzero(np.any(mesh.faces == a, axis=1) & np.any(mesh.faces == b, axis=1))
    along = mesh.vertices[b] - mesh.vertices[a]
    forth, back = list[tuple[int, Array]](), list[tuple[int, Array]]()
    for face in around:
        corners = [int(corner) for corner in mesh.faces[face]]
        away = mesh.vertices[next(corner for corner in corners if corner not in (a, b))] - mesh.vertices[a]
        away = away - along * (away @ along) / max(float(along @ along), 1e-300)
        direction = away / max(float(np.linalg.norm(away)), 1e-300)
        (forth if corners[(corners.index(a) + 1) % 3] == b else back).append((int(face), direction))
    pairs = []
    for left, direction in forth:
        nearest = max(range(len(back)), key=lambda i: float(direction @ back[i][1]))
        pairs.append((left, back.pop(nearest)[0]))
    return pairs
