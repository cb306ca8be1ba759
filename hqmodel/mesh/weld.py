"""Tiles' triangles joined into one mesh as they come, each vertex told by the grid edge it lies on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .mesh import Array, Triangles, rows


@dataclass(frozen=True, eq=False)
class Piece:
    """One tile's triangles. `keys` (n,) name the edges of the vertices `shared` (n,), which other tiles may have too.

    `pulls` (n, 2) is how the smooth faces about each shared vertex pull it; the others are balanced already. `pinched` (V,) tells
    vertices where two sheets may touch, `sharp` (V,) those where a crease may pass; `worst` (k,) are the numbers of the faces
    furthest off the surface.
    """

    keys: NDArray[np.int64]
    shared: NDArray[np.intp]
    vertices: Array
    normals: NDArray[np.float32]
    colors: NDArray[np.uint8]
    pulls: NDArray[np.float32]
    pinched: NDArray[np.bool_]
    sharp: NDArray[np.bool_]
    faces: Triangles
    worst: NDArray[np.intp]


_MARKS = ("pinched", "sharp")
_OF_VERTICES = ("vertices", "normals", "colors", *_MARKS)


class Weld:
    """A mesh that grows by pieces, in memory little larger than itself."""

    def __init__(self) -> None:
        self._keys = np.empty(0, dtype=np.int64)  # of the shared vertices, in order
        self.shared = np.empty(0, dtype=np.int32)  # their numbers
        self.pulls = np.empty((0, 2), dtype=np.float32)  # and what they are pulled by, of all pieces so far
        self._columns: dict[str, _Column] = {}

    def __bool__(self) -> bool:
        return bool(self._columns)

    def add(self, piece: Piece, share: float) -> None:
        """Join a piece on: vertices that an earlier one has already are taken from there. `share` of the mesh is there then."""
        before = len(self._columns["vertices"].rows) if self else 0
        at = np.searchsorted(self._keys, piece.keys)
        old = np.append(self._keys, -1)[at] == piece.keys
        earlier, again, fresh = self.shared[at[old]], piece.shared[old], piece.shared[~old]
        here = np.ones(len(piece.vertices), dtype=bool)
        here[again] = False
        number = np.cumsum(here, dtype=np.int32) + np.int32(before - 1)
        number[again] = earlier
        self.pulls[at[old]] += piece.pulls[old]
        order = np.argsort(piece.keys[~old])
        into = at[~old][order]
        self._keys = np.insert(self._keys, into, piece.keys[~old][order])
        self.shared = np.insert(self.shared, into, number[fresh][order])
        self.pulls = np.insert(self.pulls, into, piece.pulls[~old][order], axis=0)
        for name in _MARKS if before else ():
            self._columns[name].rows[earlier] |= getattr(piece, name)[again]
        new = np.flatnonzero(here)
        for name in _OF_VERTICES:
            self._extend(name, rows(getattr(piece, name), new), share)
        self._extend("worst", piece.worst + (len(self._columns["faces"].rows) if before else 0), share)
        self._extend("faces", number[piece.faces], share)

    def _extend(self, name: str, rows: NDArray[Any], share: float) -> None:
        self._columns.setdefault(name, _Column(rows)).extend(rows, share)

    def longest(self, mirrored: tuple[int, ...]) -> float:
        """The longest side of what is there, with its images on the other side of the planes `mirrored`."""
        ways = self._columns["vertices"].rows.T
        return max(float(x.max() - (-x.max() if i in mirrored else x.min())) for i, x in enumerate(ways))

    def take(self, name: str) -> NDArray[Any]:
        """A part of the pieces, all in one, which is given away."""
        return self._columns.pop(name).rows


class _Column:
    """Rows like the ones given that grow in place. Room is made for all to come; of it only what is filled takes memory."""

    def __init__(self, like: NDArray[Any]) -> None:
        self._store: NDArray[Any] = np.empty((0, *like.shape[1:]), dtype=like.dtype)
        self._count = 0

    @property
    def rows(self) -> NDArray[Any]:
        return self._store[: self._count]

    def extend(self, rows: NDArray[Any], share: float) -> None:
        """Add rows, with which so large a share is there."""
        needed = self._count + len(rows)
        if needed > len(self._store):
            store = np.empty((int(1.1 * needed / share) + 1, *rows.shape[1:]), dtype=rows.dtype)
            store[: self._count] = self.rows
            self._store = store
        self._store[self._count : needed] = rows
        self._count = needed
