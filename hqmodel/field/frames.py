"""Frames of slices through higher-dimensional shapes (eqs. 16-22, 38, 41): judged, restored and turned.

A frame is an array (N, 4): each row is a strip's normal A, B, C and its slice coefficient D. With orthonormal columns the shape
is a slice through an N-dimensional superquadric: at gamma = 2 a sphere of radius sqrt(1 - t^2), at large exponents a slice
through a hypercube, at gamma = 1 one through a cross-polytope. A column that is zero throughout takes no part: planar frames
have no C, and shapes that don't change with t no D.
"""

from __future__ import annotations

import numpy as np

from hqmodel.model import Scene

from .region import reaches, sharing
from .terms import Array, Terms

# The six planes of four-space, each as the columns it mixes.
PLANES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2), "xt": (0, 3), "yt": (1, 3), "zt": (2, 3)}
# Columns whose smallest singular value is below this share of the largest are not independent.
_DEPENDENT = 1e-9


def frame_residual(frame: Array) -> float:
    """How far a frame's columns, those that are not zero, are from orthonormal: the largest entry of |F'F - 1|."""
    columns = frame[:, np.any(frame != 0, axis=0)]
    return float(np.max(np.abs(columns.T @ columns - np.eye(columns.shape[1])), initial=0.0))


def nearest_frame(frame: Array) -> Array:
    """The orthonormal frame nearest to this one: the orthogonal factor of its polar decomposition.

    Zero columns stay zero. Raises ValueError where the others are not independent, so that no frame is nearest.
    """
    used = np.any(frame != 0, axis=0)
    left, sizes, right = np.linalg.svd(frame[:, used], full_matrices=False)
    if len(sizes) < np.count_nonzero(used) or not sizes[-1] > _DEPENDENT * sizes[0]:
        raise ValueError(f"expected {np.count_nonzero(used)} independent columns A, B, C and D, got {frame.tolist()}")
    result = np.zeros_like(frame)
    result[:, used] = left @ right
    return result


def turned_frame(frame: Array, plane: str, angle: float) -> Array:
    """The frame of the shape turned by an angle in radians in one of `PLANES`, from its first axis towards its second."""
    i, j = PLANES[plane]
    cosine, sine = np.round([np.cos(angle), np.sin(angle)], 15)  # a quarter turn leaves nothing behind
    result = frame.copy()
    result[:, i] = cosine * frame[:, i] - sine * frame[:, j]
    result[:, j] = sine * frame[:, i] + cosine * frame[:, j]
    return result


def slice_range(scene: Scene) -> tuple[float, float] | None:
    """The slices t outside which the scene has no body, from lowest to highest; None where there is no such limit.

    Exact for a lone shape at the limits gamma = 1 and infinity, and for the symmetric frames between; never too narrow. From
    the planes: with v_a = |h_a| / reach_a every term that adds has v_a <= 1, and sum v_a^m <= 1 for its largest exponent m, so
    that sum v_a <= S^(1 - 1/m).
    """
    terms = Terms.of(scene.changed(slice=0.0))
    rate = Terms.of(scene.changed(slice=1.0)).offset - terms.offset
    reach = reaches(terms, sharing(terms))
    ranges = []
    for k in np.flatnonzero(terms.positive):
        own = terms.term_of_strip == k
        if np.any(reach[own] < 0):
            continue
        if not np.all(np.isfinite(reach[own])):
            return None
        size = np.maximum(reach[own], 1e-150)[:, None]
        steepest = max(1.0, np.max(terms.inner[own]), np.max(terms.outer[terms.term_of_group == k]))
        planes = np.column_stack([terms.normal[own], rate[own], terms.offset[own]]) / size
        ranges.append(_extent(planes, len(planes) ** (1 - 1 / steepest)))
    low, high = min((r[0] for r in ranges), default=0.0), max((r[1] for r in ranges), default=0.0)
    return (low, high) if low < high and np.isfinite([low, high]).all() else None


def _extent(planes: Array, total: float) -> tuple[float, float]:
    """The least and largest t with |h_a| <= 1 and sum |h_a| <= total for h = planes . (x, y, z, t, 1), (S, 5), by linear
    programming; inf, -inf where no t is.
    """
    from scipy.optimize import linprog  # late: it is slow to load

    count = len(planes)
    above = [np.hstack([sign * planes[:, :4], -np.eye(count)]) for sign in (1, -1)]
    rows = np.vstack([*above, np.r_[np.zeros(4), np.ones(count)]])
    limits = np.r_[-planes[:, 4], planes[:, 4], total]
    bounds = [(None, None)] * 4 + [(0, 1)] * count
    ends = []
    for sign in (1, -1):
        found = linprog(sign * np.eye(4 + count)[3], rows, limits, bounds=bounds)
        ends.append(sign * (found.fun if found.status == 0 else np.inf if found.status == 2 else -np.inf))
    return ends[0], ends[1]
