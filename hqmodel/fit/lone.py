"""One body: many cheap starts, the best refined, strips added where they are missed and dropped where they are not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .bodies import Array, Bodies
from .cloud import Cloud, beyond_hull, neighbours
from .distance import distances
from .solve import Evidence, Solution, solved
from .starts import starts

Tell = Callable[[float, str], None]
# Points that starts are tried on, that strips are added by, and that the end is refined on.
COARSE, MIDDLE, FINE = 500, 1500, 6000
# How far off the surface the points are put that stand for normals.
_LIFT = 0.01
_HULL_POINTS = 300
# How far beyond the hull they lie, and how deep in the body one has to be to count, in the cloud's deviations.
_BEYOND, _SOFT = 0.1, 0.3
# Starts that are refined, and strips that are tried each time.
_BEST, _TRIED = 5, 4
# Normals with such a cosine between them are tried once.
_SAME = 0.9
# Exponents that a new strip begins with.
_NEW_GAMMAS = 3.0, 12.0


@dataclass(frozen=True)
class Step:
    """What was done to the fit, and by how much it lowered the information criterion."""

    what: str
    gain: float


def evidence_of(cloud: Cloud, count: int, rng: np.random.Generator) -> Evidence:
    """What so many of the cloud's points tell: the surface, and that the body ends where they do, unless they say otherwise.

    The hull's say is weak: it holds the side of a body that no point was seen of.
    """
    part = cloud.part(count)
    known = cloud.part(4 * MIDDLE)
    hull, thickness = beyond_hull(known.points[known.trusted], _BEYOND, _HULL_POINTS, rng)
    return Evidence(*lifted(part), outside=hull, softness=_SOFT * thickness)


def lifted(cloud: Cloud) -> tuple[Array, Array]:
    """The points and how far from the surface they are to lie; outward normals are told by points a little outside."""
    away = np.zeros(len(cloud.points))
    if not cloud.oriented:
        return cloud.points, away
    return np.concatenate([cloud.points, cloud.points + _LIFT * cloud.normals]), np.concatenate([away, away + _LIFT])


def lone_body(cloud: Cloud, strips: int, floor: float, rng: np.random.Generator, tell: Tell) -> tuple[Solution, list[Step]]:
    """The hyperquadric of at most so many strips that fits the cloud best, and how it came about.

    A strip stays when it lowers Schwarz's criterion, n ln(likelihood) against 5 numbers more, on a sample of `MIDDLE` points.
    """
    coarse, middle = (evidence_of(cloud, count, rng) for count in (COARSE, MIDDLE))
    best = _best_start(cloud, coarse, middle, strips, floor, rng, tell)
    steps = [Step(f"{len(best.bodies.owner)} strips to begin with", 0.0)]
    best = _grown(cloud, middle, best, strips, floor, steps, tell)
    best = _pruned(middle, best, floor, steps, tell)
    tell(0.9, "Refining")
    return solved(best.bodies, evidence_of(cloud, FINE, rng), floor, 40), steps


def _best_start(
    cloud: Cloud, coarse: Evidence, middle: Evidence, strips: int, floor: float, rng: np.random.Generator, tell: Tell
) -> Solution:
    known = cloud.part(2 * MIDDLE)
    begun = []
    every = starts(known.points[known.trusted], known.normals[known.trusted], strips, rng)
    for number, bodies in enumerate(every):
        tell(0.4 * number / len(every), "Trying starts")
        begun.append(solved(bodies, coarse, floor, 12))
    begun.sort(key=lambda solution: _criterion(solution, coarse))
    refined = []
    for number, solution in enumerate(begun[:_BEST]):
        tell(0.4 + 0.1 * number / _BEST, "Refining starts")
        refined.append(solved(solution.bodies, middle, floor, 25))
    return min(refined, key=lambda solution: _criterion(solution, middle))


def _grown(cloud: Cloud, middle: Evidence, best: Solution, strips: int, floor: float, steps: list[Step], tell: Tell) -> Solution:
    """With strips added as long as they earn their place."""
    part = cloud.part(MIDDLE)
    while (count := len(best.bodies.owner)) < strips:
        tell(0.5 + 0.3 * count / strips, "Adding strips")
        tried = [solved(bodies, middle, floor, 12) for bodies in with_one_more(part.only(part.trusted), best)]
        if not tried:
            break
        trial = min(tried, key=lambda solution: _criterion(solution, middle))
        trial = solved(trial.bodies, middle, floor, 25, trial.noise)
        gain = _criterion(best, middle) - _criterion(trial, middle)
        if gain <= 0:
            break
        best = trial
        steps.append(Step(f"strip {count + 1} added", gain))
    return best


def _pruned(middle: Evidence, best: Solution, floor: float, steps: list[Step], tell: Tell) -> Solution:
    """Without strips that can go."""
    strip = len(best.bodies.owner) - 1
    while strip >= 0 and len(best.bodies.owner) > 3:
        tell(0.85, "Dropping strips")
        trial = solved(best.bodies.without_strip(strip), middle, floor, 15, best.noise)
        gain = _criterion(best, middle) - _criterion(trial, middle)
        if gain > 0:
            best = trial
            steps.append(Step("strip dropped", gain))
        strip -= 1
    return best


def with_one_more(cloud: Cloud, solution: Solution, body: int = 0) -> list[Bodies]:
    """A body with a strip more, in several ways: a plane laid against its points, the cloud, where the distances are worst."""
    reach = max(4 * solution.noise.sigma, 0.02)
    miss = np.clip(distances(solution.bodies, cloud.points), -reach, reach)
    worst = np.abs(np.mean(miss[neighbours(cloud.points)[1]], axis=1))
    ways = []
    for _ in range(_TRIED):
        if not worst.any():
            break
        at = int(np.argmax(worst))
        normal = cloud.normals[at]
        ways += [_with_plane(solution.bodies, body, cloud.points, at, normal, gamma) for gamma in _NEW_GAMMAS]
        worst[np.abs(cloud.normals @ normal) > _SAME] = 0.0
    return ways


def _with_plane(bodies: Bodies, body: int, points: Array, at: int, normal: Array, gamma: float) -> Bodies:
    """With a strip that has one plane at a point and the other behind all points."""
    along = points @ normal
    low, high = np.quantile(along, (0.01, 0.99))
    far = float(low if high - along[at] < along[at] - low else high)
    half = max(abs(along[at] - far) / 2, 1e-2)
    return bodies.with_strip(body, normal / half, -(along[at] + far) / 2 / half, gamma)


def _criterion(solution: Solution, evidence: Evidence) -> float:
    return solution.criterion(len(evidence.surface), min(MIDDLE, len(evidence.surface)))
