"""One body: many cheap starts, the best refined, strips added where they are missed and dropped where they are not."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from .bodies import Array, Bodies
from .cloud import Cloud, beyond_hull, neighbours
from .distance import distances
from .solve import Evidence, Noise, Solution, solved
from .starts import starts
from .told import Told

# Points that starts are tried on, that strips are added by, and that the end is refined on.
COARSE, MIDDLE, FINE = 500, 1500, 6000
# A criterion lower by less than this speaks for nothing.
WORTH = 2.0
# How far off the surface the points are put that stand for normals.
_LIFT = 0.01
_HULL_POINTS = 300
# How far beyond the hull they lie, and how deep in the body one has to be to count, in the cloud's deviations.
_BEYOND, _SOFT = 0.1, 0.3
# Steps that all starts are tried by, and then the better third; starts that are refined, and those that strips are added to.
_FIRST, _SECOND, _BEST, _GROWN = 4, 10, 5, 3
# A deviation so many times the least, and so few outliers, are as good as it gets.
_FOUND, _FEW = 1.2, 0.01
# Strips that are tried each time.
_TRIED = 4
# Starts of three strips that are tried with groups; groups that are refined; and the sine of the angle that strips along an
# axis may be off it.
_SIMPLE, _GROUPS, _ALONG = 4, 2, 0.15
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
    return Evidence(*lifted(part), outside=hull, softness=_SOFT * thickness, span=cloud.span)


def lifted(cloud: Cloud) -> tuple[Array, Array]:
    """The points and how far from the surface they are to lie; outward normals are told by points a little outside."""
    away = np.zeros(len(cloud.points))
    if not cloud.oriented:
        return cloud.points, away
    return np.concatenate([cloud.points, cloud.points + _LIFT * cloud.normals]), np.concatenate([away, away + _LIFT])


@dataclass(frozen=True, eq=False)
class _Task:
    """What is fitted, on how many points, and the limits."""

    cloud: Cloud
    coarse: Evidence
    middle: Evidence
    strips: int
    floor: float
    rng: np.random.Generator
    tell: Told

    def found(self, solution: Solution) -> bool:
        """Whether it is as good as it gets."""
        return solution.noise.sigma < _FOUND * self.floor

    def solved(self, bodies: Bodies, evidence: Evidence, rounds: int, noise: Noise | None = None) -> Solution:
        """The bodies moved, telling at every step."""
        return solved(bodies, evidence, self.floor, rounds, noise, self.tell.again)


def lone_body(cloud: Cloud, strips: int, floor: float, rng: np.random.Generator, tell: Told) -> tuple[Solution, list[Step]]:
    """The hyperquadric of at most so many strips that fits the cloud best, and how it came about.

    A strip stays when it lowers Schwarz's criterion, n ln(likelihood) against 5 numbers more, on a sample of `MIDDLE` points;
    so does a group of strips, which has no more numbers than they have apart.
    """
    coarse, middle = (evidence_of(cloud, count, rng) for count in (COARSE, MIDDLE))
    task = _Task(cloud, coarse, middle, strips, floor, rng, tell)
    ends = list[_Grown]()
    begun = _best_starts(task)
    for number, start in enumerate(begun):
        tell(0.5 + 0.4 * number / len(begun), "Adding strips")
        if not any(task.found(end.best) and end.bodies.size <= start.bodies.size for end in ends):
            ends.append(_grown(task, start))
    tell(0.9, "Refining")
    grown = min(ends, key=lambda end: _criterion(end.best, middle))
    _tidy(task, grown)
    return task.solved(grown.bodies, evidence_of(cloud, FINE, rng), 40), grown.steps


def _best_starts(task: _Task) -> list[Solution]:
    """The few best of many starts, those of three strips tried with groups as well, refined."""
    known = task.cloud.part(2 * MIDDLE)
    begun = []
    every = starts(known.points[known.trusted], known.normals[known.trusted], task.strips, task.rng)
    for number, bodies in enumerate(every):
        task.tell(0.35 * number / len(every), "Trying starts")
        begun.append(task.solved(bodies, task.coarse, _FIRST))
    begun.sort(key=lambda solution: _criterion(solution, task.coarse))
    simple = [solution.bodies for solution in begun if len(solution.bodies.owner) == 3][:_SIMPLE]
    begun = [task.solved(start.bodies, task.coarse, _SECOND, start.noise) for start in begun[: len(begun) // 3]]
    task.tell(0.37, "Trying groups")
    pairs = [bodies for start in simple for bodies in groupings(start)]
    begun += [task.solved(bodies, task.coarse, _FIRST + _SECOND) for pair in pairs for bodies in (pair, pair.dual())]
    begun.sort(key=lambda solution: _criterion(solution, task.coarse))
    refined = []
    for number, solution in enumerate(begun[:_BEST]):
        task.tell(0.4 + 0.1 * number / _BEST, "Refining starts")
        refined.append(task.solved(solution.bodies, task.middle, 25))
    found = {round(_criterion(solution, task.middle)): solution for solution in refined}  # several come to the same
    return [found[criterion] for criterion in sorted(found)[:_GROWN]]


def _grown(task: _Task, start: Solution) -> _Grown:
    """With a group, and with strips added as long as they earn their place."""
    grown = _Grown(task, start, [Step(_told(start.bodies), 0.0)])
    grown.keeps(_with_best_group(task, start), "a group of strips")
    while (count := len(grown.bodies.owner)) < task.strips:
        if not grown.keeps(_with_best_strip(task, grown.best), f"strip {count + 1} added"):
            break
    return grown


def _tidy(task: _Task, grown: _Grown) -> None:
    """Without what can go."""
    count = len(grown.bodies.owner)
    for strip in reversed(range(count - grown.bodies.grouped)):
        if len(grown.bodies.owner) > 3:
            grown.keeps(grown.moved(grown.bodies.without_strip(strip)), "strip dropped")
    if len(grown.steps) > 1:
        grown.keeps(_with_best_group(task, grown.best), "a group of strips")
    if grown.bodies.grouped:
        grown.keeps(grown.moved(grown.bodies.without_group()), "the group dissolved", -WORTH)
    if len(grown.bodies.owner) == 3:
        grown.keeps(grown.moved(grown.bodies.squared()), "strips put at right angles")


@dataclass(eq=False)
class _Grown:
    """The best so far, and how it came about."""

    task: _Task
    best: Solution
    steps: list[Step]

    @property
    def bodies(self) -> Bodies:
        return self.best.bodies

    def moved(self, bodies: Bodies) -> Solution:
        """The best, changed a little, settled again."""
        return self.task.solved(bodies, self.task.middle, 15, self.best.noise)

    def keeps(self, trial: Solution | None, what: str, worth: float = WORTH) -> bool:
        """Whether a trial, if there is any, gains so much that it is the best from now on."""
        gain = -np.inf if trial is None else _criterion(self.best, self.task.middle) - _criterion(trial, self.task.middle)
        if trial is None or gain <= worth:
            return False
        self.best = trial
        self.steps.append(Step(what, gain))
        return True


def _told(bodies: Bodies) -> str:
    return f"{len(bodies.owner)} strips to begin with" + (f", {bodies.grouped} of them a group" if bodies.grouped else "")


def _with_best_group(task: _Task, best: Solution) -> Solution | None:
    """With the most promising of all groups, where there is none yet and anything is left to gain."""
    if best.bodies.grouped or (task.found(best) and best.noise.outliers < _FEW):
        return None
    tried = [task.solved(bodies, task.coarse, 2) for bodies in groupings(best.bodies)]
    tried.sort(key=lambda solution: _criterion(solution, task.coarse))
    refined = [task.solved(solution.bodies, task.middle, 25, solution.noise) for solution in tried[:_GROUPS]]
    return min(refined, key=lambda solution: _criterion(solution, task.middle))


def groupings(bodies: Bodies) -> list[Bodies]:
    """A lone body with a group: of every two of its strips, and of all that lie along one axis with those two."""
    normal = bodies.normal / np.linalg.norm(bodies.normal, axis=1, keepdims=True)
    number = np.arange(len(normal))
    ways = dict[bytes, Bodies]()
    for one, other in combinations(number, 2):
        axis = np.cross(normal[one], normal[other])
        pair = (number == one) | (number == other)
        along = pair | (np.abs(normal @ axis) < _ALONG * np.linalg.norm(axis))
        ways |= {way.tobytes(): bodies.with_group(way) for way in (pair, along) if not way.all()}
    return list(ways.values())


def _with_best_strip(task: _Task, best: Solution) -> Solution | None:
    """The best of several ways to add a strip, if there are any."""
    part = task.cloud.part(MIDDLE)
    tried = [task.solved(bodies, task.middle, 8) for bodies in with_one_more(part.only(part.trusted), best)]
    if not tried:
        return None
    trial = min(tried, key=lambda solution: _criterion(solution, task.middle))
    return task.solved(trial.bodies, task.middle, 25, trial.noise)


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
