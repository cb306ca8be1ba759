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
# What adds up over the pieces that share a vertex.
_SUMS = ("pull", "pinched")


class Weld:
    """A mesh that grows by pieces, in memory little larger than itself."""

    def __init__(self) -> None:
        self._known: dict[int, int] = {}
        self._columns: dict[str, _Column] = {}

    def __bool__(self) -> bool:
        return bool(self._columns)

    def add(self, piece: Piece) -> None:
        """Join a piece on: vertices that an earlier one has already are taken from there."""
        before = len(self._columns["vertices"].rows) if self else 0
        new = np.ones(len(piece.vertices), dtype=bool)
        earlier = np.array([self._known.get(key, -1) for key in piece.keys.tolist()], dtype=np.int32)
        old = earlier >= 0
        new[piece.shared[old]] = False
        number = np.cumsum(new, dtype=np.int32) + np.int32(before - 1)
        number[piece.shared[old]] = earlier[old]
        self._known.update(zip(piece.keys[~old].tolist(), number[piece.shared[~old]].tolist(), strict=True))
        for name in _SUMS if before else ():
            self._columns[name].rows[earlier[old]] += getattr(piece, name)[piece.shared[old]]
        for name in _OF_VERTICES:
            self._extend(name, getattr(piece, name)[new])
        self._extend("faces", number[piece.faces])
        self._extend("off", piece.off)

    def _extend(self, name: str, rows: NDArray[Any]) -> None:
        self._columns.setdefault(name, _Column(rows)).extend(rows)

    def take(self, name: str) -> NDArray[Any]:
        """A part of the pieces, all in one, which is given away."""
        return self._columns.pop(name).rows


class _Column:
    """Rows like the ones given that grow in place. Room is made twice as large; of it only what is filled takes memory."""

    def __init__(self, like: NDArray[Any]) -> None:
        self._store: NDArray[Any] = np.empty((0, *like.shape[1:]), dtype=like.dtype)
        self._count = 0

    @property
    def rows(self) -> NDArray[Any]:
        return self._store[: self._count]

    def extend(self, rows: NDArray[Any]) -> None:
        needed = self._count + len(rows)
        if needed > len(self._store):
            store = np.empty((2 * needed, *rows.shape[1:]), dtype=rows.dtype)
            store[: self._count] = self.rows
            self._store = store
        self._store[self._count : needed] = rows
        self._count = needed
