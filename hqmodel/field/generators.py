"""Frames of well-known shapes: slices through hypercubes, and the solids whose faces lie across the axes of a symmetry.

Each is orthonormal in the columns that it has (eqs. 38, 41). At large exponents its body is a slice through a hypercube, all
strips' |h| <= 1; at gamma = 1 one through a cross-polytope, the sum of them at most 1.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from math import sqrt

import numpy as np
from numpy.typing import ArrayLike

from .terms import Array

FEWEST_TERMS = 4
_GOLDEN = (1 + sqrt(5)) / 2


def make_frame(name: str, terms: int = 6, seed: int = 0) -> Array:
    """The frame (N, 4) of one of `FRAMES`, or of so many terms: `hypercube` or `random`.

    Raises KeyError for another name, and ValueError for fewer than four terms.
    """
    if name not in ("hypercube", "random"):
        return FRAMES[name]()
    if terms < FEWEST_TERMS:
        raise ValueError(f"expected at least {FEWEST_TERMS} terms, as a frame has four columns, got {terms}")
    return _hypercube(terms) if name == "hypercube" else _random(terms, seed)


def _hypercube(terms: int) -> Array:
    """The N-dimensional cube cut across its long diagonal, and by the first waves around that; for N = 4 hadamard4, turned."""
    phase = 2 * np.pi * np.arange(terms) / terms
    return _unit_columns(np.cos(phase), np.sin(phase), np.cos(2 * phase), np.ones(terms))


def _random(terms: int, seed: int) -> Array:
    """Any orthonormal frame, each as likely."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(terms, 4)))
    return np.asarray(q * np.sign(np.diag(r)))


def _unit_columns(*columns: ArrayLike) -> Array:
    """Up to four columns (N,), each divided by its length, and zeros for the others."""
    frame = np.zeros((np.size(columns[0]), 4))
    for i, column in enumerate(columns):
        frame[:, i] = np.asarray(column) / np.linalg.norm(column)
    return frame


def _cycled(*rows: tuple[float, float, float]) -> Array:
    """Each row and its cyclic permutations."""
    return np.array([np.roll(row, shift) for row in rows for shift in range(3)])


# The axes about which the octahedron and the icosahedron look the same, by how often they do so in a turn.
_FOUR = np.eye(3)
_THREE = np.array([(x * y, x, y) for x, y in product((1.0, -1.0), repeat=2)])
_TWO = _cycled((1, 1, 0), (1, -1, 0))
_ICO_FIVE = _cycled((0, 1, _GOLDEN), (0, 1, -_GOLDEN))
_ICO_THREE = np.vstack([_THREE, _cycled((0, _GOLDEN, 1 / _GOLDEN), (0, _GOLDEN, -1 / _GOLDEN))])
_ICO_TWO = np.vstack([_FOUR, *(_cycled((x, y / _GOLDEN, _GOLDEN)) for x, y in product((1.0, -1.0), repeat=2))])


def _across(*axes: Array, corner: tuple[float, float, float] | None = None) -> Callable[[], Array]:
    """A frame of strips across axes, (n, 3) of each kind: as wide as the solid with this corner and all its images under the
    symmetry, or, with one kind, as any will.
    """
    widths = [1.0 if corner is None else np.max(np.abs(_unit_rows(rows) @ corner)) for rows in axes]
    rows = np.vstack([_unit_rows(rows) / width for rows, width in zip(axes, widths, strict=True)])
    return lambda: _unit_columns(*rows.T)


def _unit_rows(rows: Array) -> Array:
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


def _simplex3() -> Array:
    """Three strips in the plane, the frame of figures 3, 4 and 7 to 9; t runs along the cube's diagonal."""
    return _unit_columns([1, -1, 0], [1, 1, -2], [1, 1, 1])[:, [0, 1, 3, 2]]


def _simplex5() -> Array:
    """Across the faces of the four-dimensional simplex; t runs from the middle of an edge to that of the triangle opposite."""
    third = 2 * np.pi * np.arange(3) / 3
    return _unit_columns([*np.cos(third), 0, 0], [*np.sin(third), 0, 0], [0, 0, 0, 1, -1], [2, 2, 2, -3, -3])


FRAMES: dict[str, Callable[[], Array]] = {
    "simplex3": _simplex3,
    "cube": _across(_FOUR),
    "hadamard4": lambda: np.column_stack([_THREE, np.ones(4)]) / 2,
    "simplex5": _simplex5,
    "octahedral6": _across(_TWO),
    "ico6": _across(_ICO_FIVE),
    "ico10": _across(_ICO_THREE),
    "ico15": _across(_ICO_TWO),
    "cuboctahedron": _across(_FOUR, _THREE, corner=(0, 1, 1)),
    "truncated-octahedron": _across(_FOUR, _THREE, corner=(0, 1, 2)),
    "truncated-cube": _across(_FOUR, _THREE, corner=(1, 1 + sqrt(2), 1 + sqrt(2))),
    "rhombicuboctahedron": _across(_FOUR, _THREE, _TWO, corner=(1, 1, 1 + sqrt(2))),
    "truncated-cuboctahedron": _across(_FOUR, _THREE, _TWO, corner=(1, 1 + sqrt(2), 1 + 2 * sqrt(2))),
    "icosidodecahedron": _across(_ICO_FIVE, _ICO_THREE, corner=(0, 0, 1)),
    "truncated-icosahedron": _across(_ICO_FIVE, _ICO_THREE, corner=(0, 1, 3 * _GOLDEN)),
    "truncated-dodecahedron": _across(_ICO_FIVE, _ICO_THREE, corner=(1 / _GOLDEN, 0, 2 + _GOLDEN)),
    "rhombicosidodecahedron": _across(_ICO_FIVE, _ICO_THREE, _ICO_TWO, corner=(1, 1, _GOLDEN**3)),
    "truncated-icosidodecahedron": _across(_ICO_FIVE, _ICO_THREE, _ICO_TWO, corner=(1 / _GOLDEN, 1 / _GOLDEN, 3 + _GOLDEN)),
}

# Solids that are another frame's, at large exponents, and the slice t at which they are.
SOLIDS: dict[str, tuple[str, float]] = {
    "tetrahedron": ("hadamard4", 1.0),
    "octahedron": ("hadamard4", 0.0),
    "dodecahedron": ("ico6", 0.0),
    "icosahedron": ("ico10", 0.0),
    "truncated-tetrahedron": ("hadamard4", 0.5),
    "rhombic-dodecahedron": ("octahedral6", 0.0),
    "rhombic-triacontahedron": ("ico15", 0.0),
}
