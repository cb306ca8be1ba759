"""The surface of a star-shaped body by its radius along directions (section 4, eqs. 27-37).

From an approximate solution Newton's method goes on along each direction, and where it would leave the bracket that the root is
known to be in, or gets on too slowly, the bracket is halved instead (the fail-safe form that the paper calls for).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .evaluate import log_ratio
from .powers import over_runs
from .rays import box_interval
from .region import Region, reaches
from .straight import near_linear_gradient
from .terms import Array, Indices, Terms

# A last step, and an error, this share of the region's diagonal is none.
_PRECISE = 1e-13
_MOST = 200
# So deep inside that of C - H no more than this share differs from C, the near-linear field has lost its digits.
_CANCELLED = 1e-8


@dataclass(frozen=True, eq=False)
class RadialSolution:
    """Where the surface lies along each direction, (n,) each.

    `radius` is the distance from the centre in world units; `iterations` counts the evaluations of the field and its gradient,
    none where the region cuts the body.
    """

    radius: Array
    iterations: Indices
    converged: NDArray[np.bool_]


def radial_solution(
    terms: Terms, region: Region, centre: ArrayLike, directions: ArrayLike, start: ArrayLike | None = None
) -> RadialSolution:
    """The radii of the surface from a centre (3,) within the body along directions (n, 3) of any length but 0.

    The body must be star-shaped about the centre (see `star_centre`); else each radius is that of one of several roots. Where
    the region cuts the body, the cut is its surface. `start` (n,) are first guesses, by default the `approximate_radii`.
    Raises ValueError for a centre outside.
    """
    c, d = np.asarray(centre, dtype=float), np.asarray(directions, dtype=float).reshape(-1, 3)
    d = d / np.linalg.norm(d, axis=1, keepdims=True)
    if not log_ratio(terms, c) > 0:
        raise ValueError(f"expected a centre inside the body, got {tuple(c.tolist())}")
    high = box_interval(region.low, region.high, np.broadcast_to(c, d.shape), d)[1]
    capped = log_ratio(terms, c + high[:, None] * d) > 0
    guess = approximate_radii(terms, c, d) if start is None else np.asarray(start, dtype=float)
    radius = np.where(capped, high, np.where((guess > 0) & (guess < high), guess, high / 2))
    iterations = np.zeros(len(d), dtype=np.intp)
    precise = _PRECISE * float(np.linalg.norm(region.size))
    converged = capped | _newton(terms, c, d, radius, high, iterations, np.flatnonzero(~capped), precise)
    return RadialSolution(radius, iterations, converged)


def _newton(
    terms: Terms, c: Array, d: Array, radius: Array, high: Array, iterations: Indices, active: Indices, precise: float
) -> NDArray[np.bool_]:
    """The root of the near-linear field along each active direction, (36), put into `radius`; which ones converged, (n,).

    It has the root of F(r), (35), but nearly a constant slope, so that Newton neither creeps nor leaps at large exponents.
    """
    low, high, last = np.zeros(len(d)), high.copy(), high.copy()
    deep = 1 - _CANCELLED ** (1 / np.max(terms.outer))
    done = np.zeros(len(d), dtype=bool)
    while active.size and iterations[active[0]] < _MOST:
        r, ray = radius[active], d[active]
        f, slope = near_linear_gradient(terms, c + r[:, None] * ray)
        iterations[active] += 1
        low[active], high[active] = np.where(f > 0, r, low[active]), np.where(f > 0, high[active], r)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            step = -f / np.sum(slope * ray, axis=1)
            near = np.abs(step) <= np.maximum(precise, 4 * np.spacing(r))
            near &= f < deep
            newton = near | (
                (r + step > low[active]) & (r + step < high[active]) & (np.abs(step) < last[active] / 2) & (f < deep)
            )
        half = (low[active] + high[active]) / 2 - r
        step = np.where(newton, step, half)
        radius[active], last[active] = r + step, np.where(newton, np.abs(step), high[active] - low[active])
        done[active] = near | (high[active] - low[active] <= precise)
        active = active[~done[active]]
    return done


def approximate_radii(terms: Terms, centre: Array, directions: Array) -> Array:
    """The distances (n,) from a centre (3,) along unit directions (n, 3) of eq. 37; NaN where no term has any.

    With every exponent 2 the ray meets the surface at h = U (30), on the unit sphere of N-space. The point X = sign(U)
    |U|^(2/gamma) (19) lies on the superquadric there, and the point of space nearest to it is the approximate solution (33). A
    group shares out the part of the sphere that its strips have (7, 14). Frames that are not orthonormal are taken as they
    are, by least squares, and of several terms that add the furthest point counts.
    """
    reach = reaches(terms, 0.0)
    found = np.full((1, len(directions)), np.nan)
    for k in np.flatnonzero(terms.positive):
        own = terms.term_of_strip == k
        if np.all(np.isfinite(reach[own]) & (reach[own] > 0)):
            planes = terms.normal[own] / reach[own, None]
            at = planes @ centre + terms.offset[own] / reach[own]
            x = _on_superquadric(terms.keep(np.arange(len(terms)) == k), _on_sphere(at, planes @ directions.T))
            away = np.linalg.pinv(planes) @ (x - at[:, None])
            found = np.vstack([found, np.linalg.norm(away, axis=0)])
    return np.fmax.reduce(found, axis=0)


def _on_sphere(at: Array, along: Array) -> Array:
    """Where at + along r, (S,) and (S, n), leaves the unit sphere of N-space, (S, n); its nearest point if it misses that."""
    a, b, c = np.sum(along * along, axis=0), at @ along, float(at @ at) - 1
    r = (np.sqrt(np.maximum(b * b - a * c, 0)) - b) / np.maximum(a, 1e-300)
    u = at[:, None] + along * r
    return np.asarray(u / np.maximum(np.linalg.norm(u, axis=0), 1e-300))


def _on_superquadric(term: Terms, u: Array) -> Array:
    """The unit sphere's points U (S, n) mapped to the one term's superquadric in N-space (eq. 19)."""
    shared = np.maximum(over_runs(u * u, term.group_start), 1e-300)
    size = (shared ** (1 / term.outer[:, None]))[term.group_of_strip]
    return np.asarray(np.sign(u) * size * (u * u / shared[term.group_of_strip]) ** (1 / term.inner[:, None]))
