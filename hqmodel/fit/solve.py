"""Robust least squares: Levenberg-Marquardt steps on the likelihood of a mixture of surface points and outliers.

A point's distance is normal about 0, or the point has nothing to do with the surface and lies anywhere; how wide and how many is
estimated along the way (as in Liu et al., CVPR 2022, and as usual with mixtures: the expectation step weighs the points).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from .bodies import Array, Bodies
from .distance import Measured

_FEWEST = 1e-3
# The share of the diagonal that is added to it at first, and steps that are tried in a round.
_DAMPING, _TRIALS = 1e-2, 6
# Times that numbers at the end of their range are looked for.
_HELD = 3
# The deviation to begin with, at least.
_WIDE = 2e-3
_NONE = np.empty((0, 3))


@dataclass(frozen=True, eq=False)
class Evidence:
    """What is known: points (N, 3) of the surface, and points that lie outside (M, 3) and inside (L, 3) of the body.

    `away` (N,) is where a surface point should lie instead of at distance 0. A point on the wrong side by more than about the
    `softness`, or the noise if that is more, costs the likelihood exp(-doubt), and no more however deep it lies. `outliers` is
    the largest share there may be; each is anywhere in a `span` of distance.
    """

    surface: Array
    away: Array
    outside: Array = field(default_factory=lambda: _NONE)
    inside: Array = field(default_factory=lambda: _NONE)
    softness: float = 0.02
    doubt: float = 0.1
    outliers: float = 0.6
    span: float = 0.1

    def near(self, middle: Array, reach: float) -> Evidence:
        """What is known within a ball."""
        far = np.linalg.norm(self.surface - middle, axis=1)
        outside, inside = (points[np.linalg.norm(points - middle, axis=1) < reach] for points in (self.outside, self.inside))
        return replace(self, surface=self.surface[far < reach], away=self.away[far < reach], outside=outside, inside=inside)

    def measured(self, bodies: Bodies) -> Measured:
        """The distances of all points, surface, outside and inside."""
        points = np.concatenate([self.surface, self.outside, self.inside])
        return Measured(bodies, points, np.repeat([0.0, 1.0, -1.0], [len(self.surface), len(self.outside), len(self.inside)]))

    def misses(self, distance: Array) -> Array:
        """How far each of these points is from where it should be: those on the right side are."""
        n, m = len(self.surface), len(self.outside)
        surface, outside, inside = np.split(distance, [n, n + m])
        return np.concatenate([surface - self.away, np.minimum(outside, 0.0), np.maximum(inside, 0.0)])

    def cost(self, noise: Noise, miss: Array) -> float:
        """The negative log-likelihood of how far all points are from where they should be."""
        surface, sides = np.split(miss, [len(self.surface)])
        soft = max(self.softness, noise.sigma)
        return noise.cost(surface) - self.doubt * float(np.sum(np.expm1(-0.5 * (sides / soft) ** 2)))

    def weights(self, noise: Noise, miss: Array) -> Array:
        """The weight of each point's square in a step that lowers the cost."""
        surface, sides = np.split(miss, [len(self.surface)])
        soft = max(self.softness, noise.sigma)
        beside = self.doubt / soft**2 * np.exp(-0.5 * (sides / soft) ** 2) * (sides != 0)
        return np.concatenate([noise.weights(surface) / noise.sigma**2, beside])


@dataclass(frozen=True)
class Noise:
    """The surface points' standard deviation, the share of outliers, and the span of distance that one may be anywhere in."""

    sigma: float
    outliers: float
    span: float

    def weights(self, miss: Array) -> Array:
        """(N,) how likely each point is one of the surface."""
        near = self._near(miss)
        return near / (near + self.outliers / self.span)

    def cost(self, miss: Array) -> float:
        """The negative log-likelihood of the distances."""
        return -float(np.sum(np.log(self._near(miss) + self.outliers / self.span)))

    def updated(self, miss: Array, floor: float, most: float) -> Noise:
        """The mixture that explains the distances better, its deviation at least `floor`, its outliers at `most`."""
        w = self.weights(miss)
        total = float(np.sum(w))
        sigma = sqrt(float(np.sum(w * miss**2)) / max(total, 1e-9))
        outliers = 1 - total / len(miss)
        return Noise(max(sigma, floor), min(max(outliers, _FEWEST), most), self.span)

    def _near(self, miss: Array) -> Array:
        return (1 - self.outliers) / (sqrt(2 * pi) * self.sigma) * np.exp(-0.5 * (miss / self.sigma) ** 2)


@dataclass(frozen=True, eq=False)
class Solution:
    """Bodies with the noise they leave and what they cost: the negative log-likelihood, sides included."""

    bodies: Bodies
    noise: Noise
    cost: float

    def criterion(self, count: int, points: int) -> float:
        """Schwarz's information criterion (BIC), the smaller the better; the likelihood that of `points` out of `count`."""
        return 2 * self.cost * points / count + self.bodies.size * log(points)


def first_noise(evidence: Evidence, miss: Array, floor: float) -> Noise:
    """The mixture to begin with: as wide as most distances are, so that nothing is taken for an outlier too soon."""
    return Noise(max(float(np.quantile(np.abs(miss), 0.7)), _WIDE, floor), min(0.05, evidence.outliers), evidence.span)


def solved(
    bodies: Bodies,
    evidence: Evidence,
    floor: float,
    rounds: int,
    noise: Noise | None,
    pause: Callable[[], None],
    moving: NDArray[np.bool_] | None = None,
) -> Solution:
    """The bodies moved, by at most so many steps, to where the evidence is most likely.

    `floor` is the deviation below which nothing is to be gained. `pause` is called before each step; what it raises ends it all.
    Of the free numbers (`bodies.size`,) only those `moving` do, if it is told.
    """
    moving = np.ones(bodies.size, dtype=bool) if moving is None else moving
    count = len(evidence.surface)
    damping, still = _DAMPING, 0
    measured = evidence.measured(bodies)
    miss = evidence.misses(measured.distance)
    noise = first_noise(evidence, miss[:count], floor) if noise is None else noise
    for _ in range(rounds):
        pause()
        noise = noise.updated(miss[:count], floor, evidence.outliers)
        cost = evidence.cost(noise, miss)
        weights = evidence.weights(noise, miss)
        heavy = np.flatnonzero(weights)
        rows = measured.rows(heavy)[moving]
        weighted = rows * weights[heavy]
        square, push = weighted @ rows.T, weighted @ miss[heavy]
        for _ in range(_TRIALS):
            step = _step(bodies, moving, square, push, damping)
            some = step[moving]
            trial = bodies.moved(step)
            measured = evidence.measured(trial)
            ahead = evidence.misses(measured.distance)
            gain = cost - evidence.cost(noise, ahead)
            share = gain / max(-float(some @ push + 0.5 * some @ square @ some), 1e-300)
            damping *= 6.0 if share <= 0 else 2.0 if share < 0.25 else 1.0 if share < 0.75 else 0.2
            if gain > 0:
                break
        else:
            break
        bodies, miss, damping = trial, ahead, max(damping, 1e-9)
        still = still + 1 if gain < 1e-3 * count**0.5 else 0
        if still >= 2:
            break
    noise = noise.updated(miss[:count], floor, evidence.outliers)
    return Solution(bodies, noise, evidence.cost(noise, miss))


def _step(bodies: Bodies, moving: NDArray[np.bool_], square: Array, push: Array, damping: float) -> Array:
    """The damped step of all free numbers, 0 for those not `moving`; those that it would lead out of their range stay, too."""
    diagonal = np.diagonal(square)
    damped = square + np.diag(damping * diagonal + 1e-9 * np.max(diagonal) + 1e-12)
    step, free = np.zeros(bodies.size), np.flatnonzero(moving)
    for _ in range(_HELD):
        rows = np.flatnonzero(np.isin(np.flatnonzero(moving), free))
        step[free] = np.linalg.solve(damped[np.ix_(rows, rows)], -push[rows])
        held = bodies.held(step)
        if not held.any():
            break
        step[held] = 0.0
        free = free[~held[free]]
    return step
