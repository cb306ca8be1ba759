"""Tiles' triangles joined into one mesh as they come, each vertex told by the grid edge it lies on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .mesh import Array, Mesh, Triangles


@dataclass(frozen=True, eq=False)
class Piece:
    """One tile's triangles. `keys` (V,) name the edges of the vertices; `shared` tells those that other tiles may have too."""

    keys: NDArray[np.int64]
    shared: NDArray[np.bool_]
    vertices: Array
    faces: Triangles
    normals: NDArray[np.float32] | None
    colors: NDArray[np.uint8] | None
    error: float


class Weld:
    """A mesh that grows by pieces, in memory little larger than itself."""

    def __init__(self) -> None:
        self._known: dict[int, int] = {}
        self._columns = {name: _Column(dtype) for name, dtype in _TYPES.items()}
        self._error = 0.0

    def __bool__(self) -> bool:
        return len(self._columns["faces"].rows) > 0

    def add(self, piece: Piece) -> None:
        """Join a piece on: vertices that an earlier one has already are taken from there."""
        count = len(self._columns["vertices"].rows)
        new = np.ones(len(piece.keys), dtype=bool)
        border = np.flatnonzero(piece.shared)
        earlier = np.array([self._known.get(key, -1) for key in piece.keys[border].tolist()], dtype=np.int32)
        new[border] = earlier < 0
        number = (np.cumsum(new) - 1 + count).astype(np.int32)
        number[border[earlier >= 0]] = earlier[earlier >= 0]
        fresh = border[earlier < 0]
        self._known.update(zip(piece.keys[fresh].tolist(), number[fresh].tolist(), strict=True))
        self._columns["faces"].extend(number[piece.faces])
        for name in ("vertices", "normals", "colors"):
            rows = getattr(piece, name)
            if rows is not None:
                self._columns[name].extend(rows[new])
        self._error = max(self._error, piece.error)

    def mesh(self) -> Mesh:
        """What has been joined."""
        vertices, faces, normals, colors = (self._columns[name].rows for name in _TYPES)
        bare = len(normals) < len(vertices)
        return Mesh(vertices, faces, None if bare else normals, None if bare else colors, self._error)


_TYPES = {"vertices": np.float64, "faces": np.int32, "normals": np.float32, "colors": np.uint8}


class _Column:
    """Rows of three that grow in place."""

    def __init__(self, dtype: type) -> None:
        self._store: NDArray[Any] = np.empty((0, 3), dtype=dtype)
        self._count = 0

    @property
    def rows(self) -> NDArray[Any]:
        return self._store[: self._count]

    def extend(self, rows: NDArray[Any]) -> None:
        needed = self._count + len(rows)
        if needed > len(self._store):
            self._store.resize((max(needed, len(self._store) * 9 // 8, 1024), 3), refcheck=False)
        self._store[self._count : needed] = rows
        self._count = needed
