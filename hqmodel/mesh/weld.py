"""Tiles' triangles joined into one mesh as they come, each vertex told by the grid edge it lies on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .mesh import Array, Triangles


@dataclass(frozen=True, eq=False)
class Piece:
    """One tile's triangles. `keys` (n,) name the edges of the vertices `shared` (n,), which other tiles may have too.

    `off` (F,) is how far each face's middle lies below the surface; `pull` (V, 2) the sum and the number of those of the
    smooth faces about each vertex. `pinched` (V,) tells vertices where two sheets may touch.
    """

    keys: NDArray[np.int64]
    shared: NDArray[np.intp]
    vertices: Array
    normals: NDArray[np.float32]
    colors: NDArray[np.uint8]
    pull: NDArray[np.float32]
    pinched: NDArray[np.bool_]
    faces: Triangles
    off: NDArray[np.float32]


_OF_VERTICES = ("vertices", "normals", "colors", "pull", "pinched")
_OF_FACES = ("faces", "off")
# What adds up over the pieces that share a vertex.
_SUMS = ("pull", "pinched")


class Weld:
    """A mesh that grows by pieces. They are kept as they come; `take` lays one of their parts out in one array."""

    def __init__(self) -> None:
        self._known: dict[int, int] = {}
        self._vertices = 0
        self._late: dict[str, list[tuple[Triangles, NDArray[Any]]]] = {name: [] for name in _SUMS}
        self._parts: dict[str, list[NDArray[Any]]] = {name: [] for name in (*_OF_VERTICES, *_OF_FACES)}

    def __bool__(self) -> bool:
        return self._vertices > 0

    def add(self, piece: Piece) -> None:
        """Join a piece on: vertices that an earlier one has already are taken from there."""
        new = np.ones(len(piece.vertices), dtype=bool)
        earlier = np.array([self._known.get(key, -1) for key in piece.keys.tolist()], dtype=np.int32)
        old = earlier >= 0
        new[piece.shared[old]] = False
        number = np.cumsum(new, dtype=np.int32) + np.int32(self._vertices - 1)
        number[piece.shared[old]] = earlier[old]
        self._known.update(zip(piece.keys[~old].tolist(), number[piece.shared[~old]].tolist(), strict=True))
        self._vertices += int(np.count_nonzero(new))
        for name, late in self._late.items():
            late.append((earlier[old], getattr(piece, name)[piece.shared[old]]))
        for name in _OF_VERTICES:
            self._parts[name].append(getattr(piece, name)[new])
        self._parts["faces"].append(number[piece.faces])
        self._parts["off"].append(piece.off)

    def take(self, name: str) -> NDArray[Any]:
        """A part of the pieces, all in one; they give it away, so that there are never two of it."""
        parts = self._parts.pop(name)
        whole = np.empty((sum(len(part) for part in parts), *parts[0].shape[1:]), dtype=parts[0].dtype)
        end = len(whole)
        while parts:
            part = parts.pop()
            whole[end - len(part) : end] = part
            end -= len(part)
        for rows, values in self._late.get(name, ()):
            whole[rows] += values
        return whole
