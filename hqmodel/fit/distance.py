"""How far points lie from the bodies' surface, and how that changes with every free number.

The distance is to first order, f / |grad f| with f = H^(1/gamma) - 1 of what shapes the surface there: nearly linear along a
normal however large the exponent.
"""

from __future__ import annotations

import numpy as np

from .bodies import FLIP, Array, Bodies, Indices

# |h| nearer to 0 than this is held there: an exponent below 1 has an infinite slope at 0.
_NEAR = 1e-7
# Steps to a foot after the first, and how short the last is to be.
_STEPS, _THERE = 5, 1e-3
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
        sense, step = np.sign(look.distance), (look.distance * look.normal).T
        foot, last = points - step, np.abs(look.distance)
        if side is not None:
            last[side * sense > 0] = 0.0
        for _ in range(_STEPS):
            far = np.flatnonzero(last > _THERE)
            if not len(far):
                break
            look = _look(every, foot[far])
            foot[far] -= (look.distance * look.normal).T
            last[far] = np.abs(look.distance)
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
        log_gauge = np.max(log_h, axis=0)
        for _ in range(_ROUNDS):  # Newton's steps on a convex function, from below
            power = np.exp(gamma * (log_h - log_gauge))
            total = np.sum(power, axis=0)
            step = np.log(total) * total / np.sum(gamma * power, axis=0)
            log_gauge += step
            if np.max(step) < _SHORT:
                break
        self.log_gauge = log_gauge
        pull = gamma * np.exp(gamma * (log_h - log_gauge))
        pull /= -np.sum(pull, axis=0)
        self.by_gamma = pull * (log_h - log_gauge)
        if bodies.grouped:
            self.by_gamma = np.concatenate([self.by_gamma, pull[first:] * stretch])
            pull = np.concatenate([pull[:first], pull[first] * weight])
        self.by_h = pull / size * np.sign(h)
        self.length, self.normal = _directed(bodies.normal.T @ self.by_h)
        self.distance = np.clip(-np.expm1(-log_gauge) / self.length, -FARTHEST, FARTHEST)

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
        total = bodies.summed @ self.power
        self.t = bodies.hardness[:, None] * (1.0 - total)
        ratio = self._weigh()
        pull = self.share * bodies.hardness[:, None]
        self.by_power = -pull[bodies.owner]  # dL by |h|^gamma
        self.by_h = self.by_power * bodies.gamma[:, None] * self.power / size * np.sign(h)
        self.length, self.normal = _directed(bodies.normal.T @ self.by_h)
        self.distance = self._distance(ratio, total, np.abs(pull))

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

    def _distance(self, ratio: Array, total: Array, pull: Array) -> Array:
        """(H - H^(1 - 1/gamma)) gamma beta / |grad L|, H = 1 - L / beta; beta and gamma of what adds, by its share."""
        bodies = self.bodies
        adds = bodies.sign > 0
        hard = np.sum(pull[adds], axis=0)
        rate = (bodies.summed * bodies.gamma) @ self.power / np.maximum(total, 1e-300)
        steep = np.sum((pull * rate)[adds], axis=0) / hard
        h_sum = np.maximum(1.0 - ratio / hard, 1e-9)
        with np.errstate(over="ignore"):
            away = (h_sum - h_sum ** (1.0 - 1.0 / steep)) * steep * hard / self.length
        return np.clip(away, -FARTHEST, FARTHEST)

    def rows(self, points: Array, hardness: bool) -> Array:
        """dL by normals, offsets, ln gamma (and ln hardness), one row each."""
        rows = _rows(self.by_h, self.by_power * self.bodies.gamma[:, None] * self.power * self.log_h, points)
        return np.concatenate([rows, self.share * self.t]) if hardness else rows


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
