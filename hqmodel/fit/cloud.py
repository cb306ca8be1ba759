"""The cloud made ready: checked, thinned out, and brought into the frame of the fit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import ConvexHull, cKDTree

from .bodies import Array

# More points than these tell nothing more of a shape.
MOST = 100_000
FEWEST = 12
# A cloud thinner than this share of its length lies in a plane, or on a line.
_FLAT = 1e-4
_NEIGHBOURS = 12
# A point whose neighbours are so many times further than the median of all is likely an outlier.
_LONELY = 3.0


class FitError(ValueError):
    """The points can't be fitted; one line says why."""


@dataclass(frozen=True, eq=False)
class Frame:
    """World = centre + size (rotation^T local): rows of `rotation` are the frame's axes in the world.

    `mirror_axis` is the world axis (0, 1, 2) that the frame's plane x = 0 is the plane through the origin of, if it is.
    """

    centre: Array  # (3,)
    size: float
    rotation: Array  # (3, 3)
    mirror_axis: int | None = None

    def local(self, points: Array) -> Array:
        """World points (N, 3) in the frame."""
        return (points - self.centre) / self.size @ self.rotation.T


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points (N, 3) in the frame of the fit, in random order, and their unit normals: outward if `oriented`, else of any sign."""

    points: Array
    normals: Array
    oriented: bool
    frame: Frame

    @cached_property
    def spacing(self) -> float:
        """The median distance to the nearest neighbour."""
        return float(np.median(cKDTree(self.points).query(self.points[:2000], 2)[0][:, 1]))

    @cached_property
    def span(self) -> float:
        """How far outliers lie from any surface: they fill the cloud's box, so many times as large as it has area."""
        x, y, z = np.maximum(np.ptp(self.points @ self.frame.rotation, axis=0), _FLAT)
        return float(x * y * z / (2 * (x * y + y * z + z * x)))

    @cached_property
    def trusted(self) -> NDArray[np.bool_]:
        """(N,) which points have company: a surface's points do, outliers seldom."""
        reach = neighbours(self.points)[0][:, -1]
        return np.asarray(reach < _LONELY * np.median(reach))

    def part(self, count: int) -> Cloud:
        """The first so many points: a random sample."""
        return self.only(slice(count)) if count < len(self.points) else self

    def reframed(self, frame: Frame) -> Cloud:
        """The same points in another frame of the same size."""
        turn = self.frame.rotation.T
        where = self.points @ turn * self.frame.size + self.frame.centre
        return replace(self, points=frame.local(where), normals=self.normals @ turn @ frame.rotation.T, frame=frame)

    def only(self, chosen: slice | NDArray[np.bool_]) -> Cloud:
        """Some of the points."""
        return Cloud(self.points[chosen], self.normals[chosen], self.oriented, self.frame)


def prepared(points: ArrayLike, normals: ArrayLike | None, rng: np.random.Generator) -> Cloud:
    """The cloud of points (N, 3), thinned out to `MOST`; normals (N, 3) of any length are estimated where none are given.

    Raises FitError for what is no cloud of a body.
    """
    where = _checked(points, "points")
    towards = None if normals is None else _checked(normals, "normals")
    if towards is not None and len(towards) != len(where):
        raise FitError(f"normals: expected {len(where)}, one a point, got {len(towards)}")
    chosen = rng.permutation(len(where))[: 2 * MOST]
    where, first = np.unique(where[chosen], axis=0, return_index=True)
    order = rng.permutation(len(where))[:MOST]
    where = where[order]
    frame = _frame(where)
    local = frame.local(where)
    if towards is None:
        return Cloud(local, estimated_normals(local), False, frame)
    towards = towards[chosen][first][order]
    length = np.linalg.norm(towards, axis=1, keepdims=True)
    whole = bool(np.all(length > 0))
    return Cloud(local, towards / length, True, frame) if whole else Cloud(local, estimated_normals(local), False, frame)


def neighbours(points: Array) -> tuple[Array, NDArray[np.intp]]:
    """Distances and numbers (N, k) of each point's nearest, itself first."""
    count = min(_NEIGHBOURS, len(points))
    distance, number = cKDTree(points).query(points, count)
    return distance, number


def estimated_normals(points: Array) -> Array:
    """Each point's normal (N, 3), of either sign, from its neighbours."""
    near = neighbours(points)[1]
    patch = points[near] - points[near].mean(axis=1, keepdims=True)
    return np.linalg.eigh(np.einsum("nki,nkj->nij", patch, patch))[1][:, :, 0]


def beyond_hull(points: Array, share: float, count: int, rng: np.random.Generator) -> tuple[Array, float]:
    """Points (count, 3) outside the convex hull of points (N, 3) by a share of its size, and the cloud's least deviation.

    They are even over the hull as it is when the cloud is stretched to be as thick as long, so that a plate's rim has its part.
    """
    deviation, axes = np.linalg.eigh(np.cov(points.T))
    deviation = np.sqrt(np.maximum(deviation, 1e-12))
    middle = points.mean(axis=0)
    hull = ConvexHull((points - middle) @ axes / deviation, qhull_options="QJ")
    corners = hull.points[hull.simplices]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    face = rng.choice(len(area), count, p=area / area.sum())
    on_hull = np.einsum("nk,nki->ni", rng.dirichlet(np.ones(3), count), corners[face])
    return middle + (on_hull + share * hull.equations[face, :3]) * deviation @ axes.T, float(deviation[0])


def _checked(values: ArrayLike, name: str) -> Array:
    table = np.asarray(values, dtype=float)
    if table.ndim != 2 or table.shape[1] != 3:
        raise FitError(f"{name}: expected rows of 3 numbers, got an array of shape {table.shape}")
    wrong = np.flatnonzero(~np.isfinite(table).all(axis=1))
    if len(wrong):
        raise FitError(f"{name}[{wrong[0]}]: expected finite numbers, got {table[wrong[0]].tolist()}")
    return table


def _frame(points: Array) -> Frame:
    if len(points) < FEWEST:
        raise FitError(f"points: expected at least {FEWEST} that differ, got {len(points)}")
    low, high = points.min(axis=0), points.max(axis=0)
    with np.errstate(over="ignore"):
        size = float(np.linalg.norm(high - low))
    if not np.isfinite(size) or size < 1e-150 or np.spacing(np.max(np.abs([low, high]))) > 1e-6 * size:
        raise FitError(f"points: expected coordinates that float64 can tell apart, got a cloud {size:.3g} long")
    frame = Frame((low + high) / 2, size, np.eye(3))
    local = frame.local(points)
    spread = np.linalg.svd(local - local.mean(axis=0), compute_uv=False)
    if spread[2] < _FLAT * spread[0]:
        got = "points on a line" if spread[1] < _FLAT * spread[0] else "points in a plane"
        raise FitError(f"points: expected the surface of a body, got {got}")
    return frame
