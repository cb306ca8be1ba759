"""Where fits begin: sets of directions laid about the cloud, each a body of strips that just holds it."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from .bodies import Array, Bodies
from .distance import gauge

_GOLDEN = (1 + 5**0.5) / 2
_TETRAHEDRAL = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / 3**0.5
_ICOSAHEDRAL = np.array([(0, 1, _GOLDEN), (0, 1, -_GOLDEN), (1, _GOLDEN, 0), (1, -_GOLDEN, 0), (_GOLDEN, 0, 1), (-_GOLDEN, 0, 1)])
_ICOSAHEDRAL /= np.linalg.norm(_ICOSAHEDRAL[0])
# Exponents begun with: pointed between the planes, round (which finds its way from afar), and flat (which knows its faces).
_GAMMAS = 1.2, 3.0, 10.0
# Normals within so many degrees are of one face; further faces are at least so far off.
_ALIKE, _APART = np.cos(np.radians([15.0, 30.0]))


def starts(points: Array, normals: Array, strips: int, rng: np.random.Generator, count: int = 12) -> list[Bodies]:
    """Bodies to begin a fit of points (N, 3) of normals (N, 3) with, of at most so many strips; `count` of them at random."""
    sets = direction_sets(points, normals, strips) + random_sets(strips, rng, count)
    return [held(points, directions, gamma) for directions in sets for gamma in _GAMMAS]


def direction_sets(points: Array, normals: Array, strips: int) -> list[Array]:
    """Sets of directions (S, 3) that the cloud itself suggests: its axes, its faces, and regular frames in its axes."""
    axes = principal_axes(points)
    faces = face_directions(normals, strips)
    sets = [np.eye(3), axes, _TETRAHEDRAL @ axes, _ICOSAHEDRAL @ axes]
    sets += [faces[:n] for n in range(3, len(faces) + 1) if _closes(faces[:n])]
    return [directions for directions in sets if len(directions) <= strips]


def random_sets(strips: int, rng: np.random.Generator, count: int) -> list[Array]:
    """Regular frames of 3, 4 and 6 directions, turned at random."""
    frames = [frame for frame in (np.eye(3), _TETRAHEDRAL, _ICOSAHEDRAL) if len(frame) <= strips]
    turns = [Rotation.from_quat(rng.normal(size=4)).as_matrix() for _ in range(count)]
    return [frames[i % len(frames)] @ turn for i, turn in enumerate(turns)]


def held(points: Array, directions: Array, gamma: float) -> Bodies:
    """The body of these strips, laid about the points (N, 3), whose surface has half of them inside."""
    low, high = np.quantile(points @ directions.T, (0.01, 0.99), axis=0)
    half = np.maximum((high - low) / 2, 1e-3)
    normal, offset, exponent = directions / half[:, None], -(low + high) / 2 / half, np.full(len(directions), gamma)
    size = np.median(gauge(Bodies.lone(normal, offset, exponent), points))
    return Bodies.lone(normal / size, offset / size, exponent)


def principal_axes(points: Array) -> Array:
    """The cloud's principal directions as rows (3, 3), the longest first."""
    return np.linalg.eigh(np.cov(points.T))[1].T[::-1]


def face_directions(normals: Array, most: int) -> Array:
    """The directions (S, 3), up to sign, that most normals agree on, by number."""
    left, found = normals, list[Array]()
    while len(found) < most and len(left) > 0.02 * len(normals):
        some = left[:: max(1, len(left) // 200)]
        popular = some[np.argmax(np.sum(np.abs(left @ some.T) > _ALIKE, axis=0))]
        group = left[np.abs(left @ popular) > _ALIKE]
        found.append(np.linalg.eigh(group.T @ group)[1][:, -1])
        left = left[np.abs(left @ found[-1]) < _APART]
    return np.array(found).reshape(-1, 3)


def _closes(directions: Array) -> bool:
    """Whether strips across these directions (S, 3) make a closed body, and none needlessly long."""
    return bool(np.linalg.svd(directions, compute_uv=False)[2] > 0.3)
