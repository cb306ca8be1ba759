"""Robust least squares: Levenberg-Marquardt steps on the likelihood of a mixture of surface points and outliers.

A point's distance is normal about 0, or the point has nothing to do with the surface and lies anywhere; how wide and how many is
estimated along the way (as in Liu et al., CVPR 2022, and as usual with mixtures: the expectation step weighs the points).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import log, pi, sqrt

import numpy as np

from .bodies import Array, Bodies
from .distance import Measured, distances

# One outlier's share of a unit of distance: outliers fill the cloud's box, volume against area of what fits in it.
_SPAN = 0.1
_FEWEST, _MOST = 1e-3, 0.6
# The deviation to begin with, at least.
_WIDE = 2e-3
_NONE = np.empty((0, 3))


@dataclass(frozen=True, eq=False)
class Evidence:
    """What is known: points (N, 3) of the surface, and points that lie outside (M, 3) and inside (L, 3) of the body.

    `away` (N,) is where a surface point should lie instead of at distance 0. A point on the wrong side by more than about the
    `softness` costs the likelihood exp(-doubt), and no more however deep it lies.
    """

    surface: Array
    away: Array
    outside: Array = field(default_factory=lambda: _NONE)
    inside: Array = field(default_factory=lambda: _NONE)
    softness: float = 0.02
    doubt: float = 0.1

    @property
    def points(self) -> Array:
        """All of them."""
        return np.concatenate([self.surface, self.outside, self.inside])

    def misses(self, distance: Array) -> Array:
        """How far each of `points` is from where it should be: those on the right side are."""
        n, m = len(self.surface), len(self.outside)
        surface, outside, inside = np.split(distance, [n, n + m])
        return np.concatenate([surface - self.away, np.minimum(outside, 0.0), np.maximum(inside, 0.0)])

    def side_cost(self, miss: Array) -> float:
        """The negative log-likelihood of how far points are on their wrong side."""
        return -self.doubt * float(np.sum(np.expm1(-0.5 * (miss / self.softness) ** 2)))

    def side_weights(self, miss: Array) -> Array:
        """The weight of each of their squares."""
        return np.where(miss != 0, self.doubt / self.softness**2 * np.exp(-0.5 * (miss / self.softness) ** 2), 0.0)


@dataclass(frozen=True)
class Noise:
    """The surface points' standard deviation, and the share of outliers."""

    sigma: float
    outliers: float = 0.05

    def weights(self, miss: Array) -> Array:
        """(N,) how likely each point is one of the surface."""
        near = self._near(miss)
        return near / (near + self.outliers / _SPAN)

    def cost(self, miss: Array) -> float:
        """The negative log-likelihood of the distances."""
        return -float(np.sum(np.log(self._near(miss) + self.outliers / _SPAN)))

    def updated(self, miss: Array, floor: float) -> Noise:
        """The mixture that explains the distances better, its deviation at least `floor`."""
        w = self.weights(miss)
        total = float(np.sum(w))
        sigma = sqrt(float(np.sum(w * miss**2)) / max(total, 1e-9))
        outliers = 1 - total / len(miss)
        return Noise(max(sigma, floor), min(max(outliers, _FEWEST), _MOST))

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


def first_noise(bodies: Bodies, evidence: Evidence, floor: float) -> Noise:
    """The mixture to begin with: as wide as most distances are, so that nothing is taken for an outlier too soon."""
    miss = np.abs(distances(bodies, evidence.surface) - evidence.away)
    return Noise(max(float(np.quantile(miss, 0.7)), _WIDE, floor))


def solved(bodies: Bodies, evidence: Evidence, floor: float, rounds: int, noise: Noise | None = None) -> Solution:
    """The bodies moved, by at most so many steps, to where the evidence is most likely.

    `floor` is the deviation below which nothing is to be gained.
    """
    noise = first_noise(bodies, evidence, floor) if noise is None else noise
    points, count = evidence.points, len(evidence.surface)
    damping, still = 1e-2, 0
    measured = Measured(bodies, points)
    miss = evidence.misses(measured.distance)
    for _ in range(rounds):
        noise = noise.updated(miss[:count], floor)
        cost = noise.cost(miss[:count]) + evidence.side_cost(miss[count:])
        weight = np.concatenate([noise.weights(miss[:count]) / noise.sigma**2, evidence.side_weights(miss[count:])])
        rows = measured.rows()
        weighted = rows * weight
        square, push = weighted @ rows.T, weighted @ miss
        for _ in range(6):
            trial = bodies.moved(_step(square, push, damping))
            measured = Measured(trial, points)
            ahead = evidence.misses(measured.distance)
            gain = cost - noise.cost(ahead[:count]) - evidence.side_cost(ahead[count:])
            if gain > 0:
                break
            damping *= 5
        else:
            break
        damping = max(damping / 6, 1e-9)
        bodies, miss = trial, ahead
        still = still + 1 if gain < 1e-4 * count**0.5 else 0
        if still >= 3:
            break
    noise = noise.updated(miss[:count], floor)
    return Solution(bodies, noise, noise.cost(miss[:count]) + evidence.side_cost(miss[count:]))


def _step(square: Array, push: Array, damping: float) -> Array:
    """The damped step of all free numbers."""
    diagonal = np.diagonal(square)
    damped = square + np.diag(damping * diagonal + 1e-9 * np.max(diagonal) + 1e-12)
    return np.asarray(np.linalg.solve(damped, -push))
