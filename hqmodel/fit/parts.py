"""Several bodies: the worst one is split, or one is added, or one carves, whichever gains most; then all are refined together."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans2
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .bodies import FLIP, Array, Bodies, joined
from .cloud import Cloud
from .distance import distances, strengths
from .lone import MIDDLE, WORTH, Step, lifted, with_one_more
from .occupancy import sides
from .solve import Evidence, Noise, Solution, solved
from .starts import held, principal_axes
from .told import Told

# Surface points that parts are tried on and refined on, and points on either side of it.
_TRIED, _REFINED, _SIDES = 1500, 4000, 1500
# How far on its wrong side a point must be to count, and what it costs then.
_SOFT, _DOUBT = 0.005, 2.0
# Points without company being left out, few outliers are left: the rest has to be explained.
_OUTLIERS = 0.03
# What new bodies begin with.
_HARDNESS, _GAMMA = 5.0, 2.5
# How far a body may grow in width.
_ROOM = 1.5
# Bodies that are tried to be split each time, and the fewest points that make a body.
_SPLIT, _FEWEST = 3, 12
# Partitions that are tried at first.
_BEGINNINGS = 8
# Points this many times further apart than neighbours are no longer of one group.
_GROUPED = 4.0


@dataclass(frozen=True, eq=False)
class _Task:
    """What is fitted: the cloud, the points beside its surface, and the limits."""

    cloud: Cloud
    outside: Array
    inside: Array
    symmetric: bool
    strips: int
    floor: float
    tell: Told

    def solved(self, bodies: Bodies, evidence: Evidence, rounds: int, noise: Noise | None = None) -> Solution:
        """The bodies moved, telling at every step."""
        return solved(bodies, evidence, self.floor, rounds, noise, self.tell.again)

    def sample(self, count: int) -> Cloud:
        """Some of the cloud's trusted points; of a symmetric one every other is the image of the one before."""
        if not self.symmetric:
            return self.cloud.part(count)
        half = self.cloud.part(count // 2)
        points, normals = (np.concatenate([values, values * FLIP]) for values in (half.points, half.normals))
        return replace(half, points=points, normals=normals)

    def evidence(self, count: int) -> Evidence:
        """What so many of the points tell, and the points beside the surface."""
        sample = self.sample(count)
        flips = (self.outside * FLIP, self.inside * FLIP) if self.symmetric else (self.outside[:0], self.inside[:0])
        outside, inside = (np.concatenate(pair) for pair in zip((self.outside, self.inside), flips, strict=True))
        surface, away = lifted(sample)
        return Evidence(surface, away, outside, inside, _SOFT, _DOUBT, _OUTLIERS, self.cloud.span)


def several_bodies(
    cloud: Cloud, parts: int, strips: int, floor: float, rng: np.random.Generator, tell: Told, symmetric: bool
) -> tuple[Solution, list[Step]]:
    """At most so many hyperquadrics, of at most so many strips each, that together fit the cloud; and how they came about.

    A part or a strip stays when it lowers Schwarz's criterion on a sample of the points. If `symmetric`, the cloud is so in
    x = 0, and bodies beside that plane come in pairs.
    """
    cloud = cloud.only(cloud.trusted)
    outside, inside = sides(cloud.points, _SIDES // (2 if symmetric else 1), rng)
    task = _Task(cloud, outside, inside, symmetric, strips, floor, tell)
    small = task.evidence(_TRIED)
    best = _begun(task, small, parts, rng)
    steps = [Step(f"{_count(best.bodies)} parts to begin with", 0.0)]
    best = _with_strips(task, small, _changed(task, small, best, parts, steps), steps)
    tell(0.9, "Refining")
    return task.solved(best.bodies, task.evidence(_REFINED), 30, best.noise), steps


def _changed(task: _Task, small: Evidence, best: Solution, parts: int, steps: list[Step]) -> Solution:
    """With parts split, added and dropped as long as it gains anything."""
    for turn in range(2 * parts):
        task.tell(0.2 + 0.22 * turn / parts, f"{_count(best.bodies)} parts")
        trial, what = _best_way(task, small, best, parts)
        gain = _criterion(best, small) - _criterion(trial, small)
        if gain <= WORTH:
            break
        best = trial
        steps.append(Step(what, gain))
    return best


def _begun(task: _Task, small: Evidence, parts: int, rng: np.random.Generator) -> Solution:
    """The best of several ways to part the points into compact groups, each a body."""
    points = _folded(task, task.sample(_TRIED).points)
    inside = _folded(task, task.inside)
    found = [task.solved(_body(task, points), small, 20)]
    for turn in range(_BEGINNINGS):
        task.tell(0.02 + 0.18 * turn / _BEGINNINGS, "Trying partitions")
        within = inside if turn % 2 else inside[:0]
        groups = max(2, round(parts * (0.65 if task.symmetric else 1.0) * (1.0, 0.75, 0.5)[turn % 3]))
        label = kmeans2(np.concatenate([points, within]), groups, minit="++", rng=rng)[1][: len(points)]
        bodies = [_body(task, points[label == group]) for group in range(groups) if np.sum(label == group) >= _FEWEST]
        together = joined(bodies)
        if _count(together) <= parts:
            found.append(task.solved(together, small, 20))
    return min(found, key=lambda solution: _criterion(solution, small))


def _best_way(task: _Task, small: Evidence, best: Solution, parts: int) -> tuple[Solution, str]:
    """The best of the changes that leave no more than so many parts; where there are as many, the least one is given up first."""
    base, before = best, ""
    if _count(best.bodies) >= parts:
        points = task.sample(_TRIED).points
        least = int(np.argmin(np.bincount(np.argmax(strengths(best.bodies, points), axis=0), minlength=len(best.bodies))))
        base, before = task.solved(joined(best.bodies.others(least)), small, 8), f"part {least + 1} dropped, "
    ways = [(bodies, before + what) for what, bodies in _ways(task, base) if _count(bodies) <= parts]
    tried = [(task.solved(bodies, small, 8), what) for bodies, what in ways] + [(base, before)]
    tried.sort(key=lambda pair: _criterion(pair[0], small))
    refined = [(task.solved(solution.bodies, small, 20, solution.noise), what) for solution, what in tried[:2]]
    return min(refined, key=lambda pair: _criterion(pair[0], small))


def _count(bodies: Bodies) -> int:
    """How many bodies there are to see."""
    return len(bodies) + int(bodies.mirrored.sum())


def _criterion(solution: Solution, evidence: Evidence) -> float:
    return solution.criterion(len(evidence.surface), MIDDLE)


def _ways(task: _Task, best: Solution) -> list[tuple[str, Bodies]]:
    """The bodies changed in several ways: the worst of them split, one added, one carving."""
    points = task.sample(_TRIED).points
    miss = distances(best.bodies, points)
    owner = np.argmax(strengths(best.bodies, points), axis=0)
    cost = np.minimum(np.abs(miss), 0.05)
    ways = []
    for body in np.argsort(-np.bincount(owner, cost, len(best.bodies)))[:_SPLIT]:
        own = owner == body
        for halves in _halves(task, points[own], miss[own]):
            fresh = [_body(task, half) for half in halves]
            ways.append((f"part {body + 1} split", joined([*best.bodies.others(body), *fresh])))
    for sign, what in ((1.0, "a part added"), (-1.0, "a carving part added")):
        group = _group(task, points, sign * miss, best.noise.sigma)
        if len(group) >= _FEWEST:
            ways.append((what, joined([best.bodies, _body(task, group, sign)])))
    return ways


def _halves(task: _Task, points: Array, miss: Array) -> list[list[Array]]:
    """Points (N, 3) of a body parted in two, in several ways; of a symmetric cloud both halves are, too."""
    folded = _folded(task, points)
    if len(points) < 2 * _FEWEST:
        return []
    along = (folded - folded.mean(axis=0)) @ principal_axes(folded).T
    badly = np.abs(miss) > np.quantile(np.abs(miss), 0.75)
    ways = {_settled(folded, first).tobytes() for first in (along[:, 0] > 0, along[:, 1] > 0, badly)}
    labels = [np.frombuffer(way, dtype=bool) for way in sorted(ways)]
    return [[folded[way], folded[~way]] for way in labels if _FEWEST <= np.count_nonzero(way) <= len(way) - _FEWEST]


def _folded(task: _Task, points: Array) -> Array:
    """Points (N, 3), of a symmetric cloud on one side of its plane."""
    return points * np.where(points[:, :1] < 0, FLIP, 1.0) if task.symmetric else points


def _settled(points: Array, label: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Two groups made compact: each point goes to the nearer centre (Lloyd)."""
    for _ in range(10):
        if label.all() or not label.any():
            break
        one, other = points[label].mean(axis=0), points[~label].mean(axis=0)
        label = np.linalg.norm(points - one, axis=1) < np.linalg.norm(points - other, axis=1)
    return label if label[0] else ~label


def _group(task: _Task, points: Array, away: Array, sigma: float) -> Array:
    """The largest group of connected points (n, 3) that lie too far out."""
    far = points[away > max(3 * sigma, 0.004)]
    if task.symmetric:
        far = far[far[:, 0] >= 0]
    if len(far) < _FEWEST:
        return far
    reach = _GROUPED * np.median(cKDTree(points).query(points, 2)[0][:, 1])
    label = connected_components(cKDTree(far).sparse_distance_matrix(cKDTree(far), reach))[1]
    return np.asarray(far[label == np.argmax(np.bincount(label))])


def _body(task: _Task, points: Array, sign: float = 1.0) -> Bodies:
    """A round box about points (N, 3), one side's where the cloud is symmetric: in the middle if they reach it, else a pair."""
    mirrored = False
    if task.symmetric:
        near, far = np.quantile(np.abs(points[:, 0]), (0.03, 0.97))
        mirrored = bool(near > 0.15 * far)
        points = _folded(task, points)
        points = points if mirrored else np.concatenate([points, points * FLIP])
    body = held(points, principal_axes(points), _GAMMA)
    widest = _ROOM / np.linalg.norm(body.normal, axis=1)[None]
    chosen = np.array([_HARDNESS]), np.array([sign]), np.array([mirrored])
    return replace(body, hardness=chosen[0], sign=chosen[1], mirrored=chosen[2], widest=widest)


def _with_strips(task: _Task, small: Evidence, best: Solution, steps: list[Step]) -> Solution:
    """With strips added to the worst bodies as long as they earn their place."""
    sample = task.sample(_TRIED)
    given_up = np.zeros(len(best.bodies), dtype=bool)
    while not given_up.all():
        owner = np.argmax(strengths(best.bodies, sample.points), axis=0)
        cost = np.bincount(owner, np.minimum(np.abs(distances(best.bodies, sample.points)), 0.05), len(given_up))
        body = int(np.argmax(np.where(given_up, -1.0, cost)))
        count = int(np.sum(best.bodies.owner == body))
        own = _own_side(sample, owner == body, bool(best.bodies.mirrored[body]))
        given_up[body] = True
        if count >= task.strips or len(own.points) < _FEWEST:
            continue
        task.tell(0.65 + 0.25 * given_up.mean(), "Adding strips")
        tried = [task.solved(bodies, small, 8, best.noise) for bodies in with_one_more(own, best, body)]
        trial = min(tried, key=lambda solution: _criterion(solution, small))
        gain = _criterion(best, small) - _criterion(trial, small)
        if gain > WORTH:
            best = trial
            given_up[body] = False
            steps.append(Step(f"part {body + 1} with {count + 1} strips", gain))
    return best


def _own_side(sample: Cloud, own: NDArray[np.bool_], mirrored: bool) -> Cloud:
    return sample.only(own & (sample.points[:, 0] >= 0) if mirrored else own)
