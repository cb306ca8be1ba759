"""How far points lie from the bodies' surface, and how that changes with every free number.

The distance is to first order, f / |grad f| with f = H^(1/gamma) - 1 of what shapes the surface there: nearly linear along a
normal however large the exponent.
"""

from __future__ import annotations

import numpy as np

from .bodies import FLIP, Array, Bodies, Indices

# |h| nearer to 0 than this is held there: an exponent below 1 has an infinite slope at 0.
_NEAR = 1e-7
# Steps to a foot after the first, and how short the last is to be: so much, or that share of the way if it is more.
_STEPS, _THERE, _NEARLY = 5, 1e-3, 0.05
# Points further than this outside several bodies are asked which of them is nearest.
_FAR = 0.005
# Newton's steps to the gauge, and how short the last is: its square, times an exponent, is what is still missing.
_ROUNDS, _SHORT = 8, 1e-5
# ln of the largest |h|^gamma.
_MOST = 300.0
# No point is further from the surface than the cloud is long.
FARTHEST = 1.0


class Measured:
    """The distances (N,) of points (N, 3) from the surface, positive outside, at most `FARTHEST`; on demand their derivatives.

    Newton's steps lead to each point's foot on the surface; one alone would take a point beyond a sharp edge for one of the face
    it is level with. How the distance changes is decided at the foot, -dL / |grad L| there: decided at the point itself, noise
    would push the shape, as a point further out has the longer lever. Of a point whose `side` (N,) is 1 or -1 it is enough to
    know whether it lies on that side, outside or inside.
    """

    def __init__(self, bodies: Bodies, points: Array, side: Array | None = None) -> None:
        self._bodies, every = bodies, bodies.images()
        look = _look(every, points)
        sense, step = np.sign(look.distance), look.steps()
        foot, last = points - step, np.linalg.norm(step, axis=1)
        there = np.maximum(_THERE, _NEARLY * last)
        if side is not None:
            last[side * sense > 0] = 0.0
        for _ in range(_STEPS):
            far = np.flatnonzero(last > there)
            if not len(far):
                break
            step = _look(every, foot[far]).steps()
            foot[far] -= step
            last[far] = np.linalg.norm(step, axis=1)
        self._foot = foot
        self.distance = np.minimum(np.linalg.norm(points - foot, axis=1), FARTHEST) * sense

    def rows(self, chosen: Indices | slice = slice(None)) -> Array:
        """The derivatives (`bodies.size`, N) by the numbers that `Bodies.moved` takes, of all or some of the points."""
        foot = self._foot[chosen]
        look = _look(self._bodies.images(), foot)
        rows = _folded(self._bodies, look.rows(foot, len(self._bodies) > 1))
        rows /= -look.length
        return self._bodies.reduced(rows)


def distances(bodies: Bodies, points: Array) -> Array:
    """The distance (N,) of points (N, 3), as `Measured` has it."""
    return Measured(bodies, points).distance


def gauge(body: Bodies, points: Array) -> Array:
    """How many times larger a lone body, grown about its middle, would have each of points (N, 3) on its surface: (N,)."""
    return np.exp(_Gauge(body, points).log_gauge)


def strengths(bodies: Bodies, points: Array) -> Array:
    """Each body's term T at points (N, 3), (K, N), the stronger of its images'; of bodies that carve -inf."""
    terms = np.where(bodies.images().sign[:, None] > 0, _Blend(bodies.images(), points).t, -np.inf)
    result = terms[: len(bodies)].copy()
    result[bodies.mirrored] = np.maximum(result[bodies.mirrored], terms[len(bodies) :])
    return result


def normals(bodies: Bodies, points: Array) -> Array:
    """The unit outward normals (N, 3) of the level sets through points (N, 3)."""
    return _look(bodies.images(), points).normal.T


def _look(bodies: Bodies, points: Array) -> _Gauge | _Blend:
    return _Gauge(bodies, points) if len(bodies) == 1 and not bodies.mirrored[0] else _Blend(bodies, points)


class _Gauge:
    """A lone body by its gauge G, at which sum |h/G|^gamma = 1: a norm of the strips' h, linear along every ray from h = 0.

    So G - 1 tells the distance well even far off and deep inside, where H itself does not. A group has the norm of its strips'
    h, with the inner exponent, for its h. `by_h` and so on are those of -ln G.
    """

    def __init__(self, bodies: Bodies, points: Array) -> None:
        self.bodies = bodies
        h = bodies.normal @ points.T + bodies.offset[:, None]
        size = np.maximum(np.abs(h), _NEAR)
        log_h = np.log(size)
        first = len(h) - bodies.grouped
        if bodies.grouped:
            log_norm, weight = _norm(log_h[first:], bodies.gamma[-1])
            stretch = np.sum(weight * (log_h[first:] - log_norm), axis=0)  # d ln norm by ln g
            log_h = np.concatenate([log_h[:first], log_norm[None]])
        gamma = bodies.gamma[: len(log_h), None]
        self.log_gauge = log_gauge = _log_gauge(log_h, gamma)
        pull = gamma * np.exp(gamma * (log_h - log_gauge))
        pull /= -np.sum(pull, axis=0)
        self.by_gamma = pull * (log_h - log_gauge)
        if bodies.grouped:
            self.by_gamma = np.concatenate([self.by_gamma, pull[first:] * stretch])
            pull = np.concatenate([pull[:first], pull[first] * weight])
        self.by_h = pull / size * np.sign(h)
        self.length, self.normal = _directed(bodies.normal.T @ self.by_h)
        self.distance = np.clip(-np.expm1(-log_gauge) / self.length, -FARTHEST, FARTHEST)

    def steps(self) -> Array:
        """How far (N, 3) the points are off the surface, to first order."""
        return (self.distance * self.normal).T

    def rows(self, points: Array, hardness: bool) -> Array:
        """-dln G by normals, offsets and ln gamma, one row each."""
        return _rows(self.by_h, self.by_gamma, points)


class _Blend:
    """The bodies as seen from points: T_k, L = ln P - ln N (see `hqmodel.field.log_ratio`), and its slopes."""

    def __init__(self, bodies: Bodies, points: Array) -> None:
        self.bodies = bodies
        h = bodies.normal @ points.T + bodies.offset[:, None]
        size = np.maximum(np.abs(h), _NEAR)
        self.log_h = np.log(size)
        self.power = np.exp(np.minimum(bodies.gamma[:, None] * self.log_h, _MOST))
        self.steep = bodies.gamma[:, None] * self.power / size * np.sign(h)  # d|h|^gamma by h
        self.total = bodies.summed @ self.power
        self.rate = (bodies.summed * bodies.gamma) @ self.power / np.maximum(self.total, 1e-300)
        self.t = bodies.hardness[:, None] * (1.0 - self.total)
        ratio = self._weigh()
        pull = self.share * bodies.hardness[:, None]
        self.by_power = -pull[bodies.owner]  # dL by |h|^gamma
        self.by_h = self.by_power * self.steep
        self.length, self.normal = _directed(bodies.normal.T @ self.by_h)
        self.distance = self._distance(ratio, np.abs(pull))

    def _weigh(self) -> Array:
        """L (N,), and in `share` its derivatives by T: each term's part of P, or less its part of N."""
        adds = self.bodies.sign > 0
        self.share = np.empty_like(self.t)
        sides = []
        for side, sense in ((adds, 1.0), (~adds, -1.0)):
            terms = self.t[side]
            top = np.max(terms, axis=0, initial=-np.inf if sense > 0 else 0.0)
            parts = np.exp(terms - top)
            whole = np.sum(parts, axis=0) + (0.0 if sense > 0 else np.exp(-top))
            self.share[side] = sense * parts / whole
            sides.append(top + np.log(whole))
        return sides[0] - sides[1]

    def _distance(self, ratio: Array, pull: Array) -> Array:
        """That of the H that L makes, 1 - L / beta; beta and gamma are of what adds, by its share."""
        adds = self.bodies.sign > 0
        hard = np.sum(pull[adds], axis=0)
        gamma = np.sum((pull * self.rate)[adds], axis=0) / hard
        return _away(1.0 - ratio / hard, gamma, self.length / hard)

    def steps(self) -> Array:
        """How far (N, 3) the points are off the surface, to first order.

        Where all bodies add, it is no further than the nearest of the surfaces they have alone, though where that body is the
        weaker the blend's slope leads to another.
        """
        result = (self.distance * self.normal).T
        if np.any(self.bodies.sign < 0):
            return result
        far = np.flatnonzero(self.distance > _FAR)
        steep = self.steep[:, far]
        slope = np.stack([self.bodies.summed @ (along[:, None] * steep) for along in self.bodies.normal.T], axis=2)
        length = np.maximum(np.linalg.norm(slope, axis=2), 1e-12)
        away = _away(self.total[:, far], self.rate[:, far], length)
        nearest = np.argmin(away, axis=0), np.arange(len(far))
        nearer = away[nearest] < self.distance[far]
        result[far[nearer]] = ((away / length)[nearest][:, None] * slope[nearest])[nearer]
        return result

    def rows(self, points: Array, hardness: bool) -> Array:
        """dL by normals, offsets, ln gamma (and ln hardness), one row each."""
        rows = _rows(self.by_h, self.by_power * self.bodies.gamma[:, None] * self.power * self.log_h, points)
        return np.concatenate([rows, self.share * self.t]) if hardness else rows


def _log_gauge(log_h: Array, gamma: Array) -> Array:
    """ln G (N,), at which the sum of (|h|/G)^gamma is 1, of ln |h| (S, N) and exponents (S, 1): Newton's on a convex function."""
    sums = np.hstack([np.ones_like(gamma), gamma]).T
    least = np.max(log_h, axis=0)
    result = np.where(least > -1.0, np.maximum(least, 0.0), least)  # most points lie near the surface
    left = np.arange(len(result))
    for _ in range(_ROUNDS):
        total, slope = sums @ np.exp(gamma * (log_h - result[left]))
        step = np.log(total) * total / slope
        result[left] = np.maximum(result[left] + step, least[left])
        far = np.abs(step) > _SHORT
        if not far.any():
            break
        left, log_h = left[far], log_h[:, far]
    return result


def _away(h_sum: Array, gamma: Array, slope: Array) -> Array:
    """How far it is to H = 1, (H - H^(1 - 1/gamma)) gamma / |grad H|."""
    h_sum = np.maximum(h_sum, 1e-9)
    with np.errstate(over="ignore"):
        return np.clip((h_sum - h_sum ** (1.0 - 1.0 / gamma)) * gamma / slope, -FARTHEST, FARTHEST)


def _norm(log_h: Array, inner: float) -> tuple[Array, Array]:
    """ln (sum |h|^g)^(1/g) (N,) of ln |h| (S, N), and its derivatives (S, N) by them."""
    top = np.max(log_h, axis=0)
    power = np.exp(inner * (log_h - top))
    total = np.sum(power, axis=0)
    return top + np.log(total) / inner, power / total


def _directed(slope: Array) -> tuple[Array, Array]:
    """The length (N,) of slopes (3, N), and the unit vectors (3, N) against them: outwards."""
    length = np.maximum(np.linalg.norm(slope, axis=0), 1e-12)
    return length, slope / -length


def _rows(by_h: Array, by_gamma: Array, points: Array) -> Array:
    """Derivatives by normals, offsets and ln gamma, one row each, of those by h, (S, N), and ln gamma."""
    count = len(by_h)
    result = np.empty((4 * count + len(by_gamma), len(points)))
    np.multiply(by_h[:, None], points.T, out=result[: 3 * count].reshape(count, 3, -1))
    result[3 * count : 4 * count] = by_h
    result[4 * count :] = by_gamma
    return result


def _folded(bodies: Bodies, rows: Array) -> Array:
    """The rows of mirror images added to those of the bodies they are images of."""
    if not bodies.mirrored.any():
        return rows
    count, more = len(bodies.owner), np.flatnonzero(bodies.mirrored[bodies.owner])
    every = count + len(more)
    normal, offset, gamma, hardness = np.split(rows, [3 * every, 4 * every, 5 * every])
    normal = normal.reshape(every, 3, -1)
    normal[more] += normal[count:] * FLIP[:, None]
    for part, whole, own in (
        (offset, count, more),
        (gamma, count, more),
        (hardness, len(bodies), np.flatnonzero(bodies.mirrored)),
    ):
        if len(part):
            part[own] += part[whole:]
    return np.concatenate([normal[:count].reshape(3 * count, -1), offset[:count], gamma[:count], hardness[: len(bodies)]])
