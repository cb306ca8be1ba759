"""Several bodies: one is split, or one is added, or one carves, whichever gains most; then all are refined together."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .bodies import FLIP, Array, Bodies, joined
from .candidates import FEWEST, folded, round_box, ways
from .cloud import Cloud
from .distance import strengths
from .lone import WORTH, Step, lifted, with_one_more
from .occupancy import sides
from .solve import Evidence, Noise, Solution, solved
from .told import Told

# Surface points that parts are tried on and refined on, and points on either side of it.
_TRIED, _REFINED, _SIDES = 2000, 6000, 1000
# How far on its wrong side a point must be to count, and what it costs then.
_SOFT, _DOUBT = 0.005, 2.0
# Points without company being left out, few outliers are left: the rest has to be explained.
_OUTLIERS = 0.01
# Steps of changed bodies alone, the changes that are tried on with all bodies then, steps of these, and of what is kept.
_ALONE, _BEST, _TOGETHER, _SETTLED = 10, 3, 6, 20
# How far around its points a changed body is looked at: so many times as far as they reach, and a little.
_AROUND, _BESIDE = 1.3, 0.03
# Numbers of parts that are made as good as they get before there are more: so with more none is worse.
_STAGES = 8, 16, 32
# Ways that a strip is tried in.
_STRIPS = 4
# Exchanging parts goes on while it lowers the criterion by so much.
_EXCHANGED = 20.0


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

    @cached_property
    def small(self) -> Evidence:
        """What parts are tried on."""
        return self.evidence(_TRIED)

    def solved(self, bodies: Bodies, evidence: Evidence, rounds: int, noise: Noise | None = None) -> Solution:
        """The bodies moved, telling at every step."""
        return solved(bodies, evidence, self.floor, rounds, noise, self.tell.again)

    def settled(self, best: Solution, bodies: Bodies, moving: NDArray[np.bool_], points: Array) -> Solution:
        """Bodies, some (K,) of them moved by what is known around points (N, 3), and what they cost by all that is."""
        middle = points.mean(axis=0)
        reach = float(np.linalg.norm(points - middle, axis=1).max())
        near = self.small.near(middle, _AROUND * reach + _BESIDE)
        bodies = solved(bodies, near, best.noise.sigma, _ALONE, None, self.tell.again, bodies.numbers(moving)).bodies
        miss = self.small.misses(self.small.measured(bodies).distance)
        return Solution(bodies, best.noise, self.small.cost(best.noise, miss))

    def together(self, best: Solution, rounds: int) -> Solution:
        """All bodies moved."""
        return self.solved(best.bodies, self.small, rounds, best.noise)

    def criterion(self, solution: Solution) -> float:
        return solution.criterion(len(self.small.surface), _TRIED)

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
    x = 0, and bodies beside that plane come in pairs, each of which counts as one.
    """
    cloud = cloud.only(cloud.trusted)
    outside, inside = sides(cloud.points, _SIDES // (2 if symmetric else 1), rng)
    task = _Task(cloud, outside, inside, symmetric, strips, floor, tell)
    steps = [Step("1 part to begin with", 0.0)]
    best = task.solved(round_box(folded(task.sample(_TRIED).points, symmetric), symmetric), task.small, 20)
    done = 0.0
    for most in (*(count for count in _STAGES if count < parts), parts):
        before, done = done, 0.9 * (most / parts) ** 1.5
        stage = replace(task, tell=tell.within(before, done))
        best = _with_strips(stage, _exchanged(stage, _grown(stage, best, most, steps), steps), steps)
    tell(0.9, "Refining")
    return task.solved(best.bodies, task.evidence(_REFINED), 30, best.noise), steps


def _grown(task: _Task, best: Solution, parts: int, steps: list[Step]) -> Solution:
    """With parts split and added, as many as are wanted or gain anything."""
    for count in range(len(best.bodies), parts):
        task.tell(0.5 * (count / parts) ** 2, f"{count} {'part' if count == 1 else 'parts'}")
        trial, what = _with_one_part_more(task, best)
        gain = task.criterion(best) - task.criterion(trial)
        if gain <= WORTH:
            break
        best = trial
        steps.append(Step(what, gain))
    return best


def _exchanged(task: _Task, best: Solution, steps: list[Step]) -> Solution:
    """With the least part given up for another elsewhere, as long as that gains much."""
    count = len(best.bodies)
    for turn in range(count if count > 1 else 0):
        task.tell(0.5 + 0.2 * turn / count, "Exchanging parts")
        rest, before = _with_least_dropped(task, best)
        trial, what = _with_one_part_more(task, rest)
        gain = task.criterion(best) - task.criterion(trial)
        if gain <= _EXCHANGED:
            break
        best = trial
        steps.append(Step(f"{before}, {what}", gain))
    return best


def _with_one_part_more(task: _Task, best: Solution) -> tuple[Solution, str]:
    """The best of the ways to have one body more: the new ones are tried alone first, the best of them with all others."""
    tried = []
    for way in ways(best, task.sample(_TRIED).points, task.symmetric):
        bodies = joined([*way.kept, *way.fresh])
        fresh = np.arange(len(bodies)) >= len(way.kept)
        tried.append((task.settled(best, bodies, fresh, way.points), way.what))
    tried.sort(key=lambda pair: task.criterion(pair[0]))
    begun = [(task.together(solution, _TOGETHER), what) for solution, what in tried[:_BEST]]
    trial, what = min(begun, key=lambda pair: task.criterion(pair[0]), default=(best, "nothing changed"))
    return task.together(trial, _SETTLED), what


def _with_least_dropped(task: _Task, best: Solution) -> tuple[Solution, str]:
    """Without the body whose place the others take best: those next to it move."""
    points = task.sample(_TRIED).points
    strength = strengths(best.bodies, points)
    owner = np.argmax(strength, axis=0)
    tried = []
    for body in range(len(best.bodies)):
        own = owner == body if np.any(owner == body) else np.ones(len(owner), dtype=bool)
        heirs = np.argmax(np.delete(strength[:, own], body, axis=0), axis=0)
        rest = joined(best.bodies.others(body))
        tried.append(task.settled(best, rest, np.isin(np.arange(len(rest)), heirs), folded(points[own], task.symmetric)))
    least = int(np.argmin([solution.cost for solution in tried]))
    return task.together(tried[least], _TOGETHER), f"part {least + 1} dropped"


def _with_strips(task: _Task, best: Solution, steps: list[Step]) -> Solution:
    """With strips added to all bodies in turn, as long as they earn their place."""
    sample = task.sample(_TRIED)
    growing = list(range(len(best.bodies)))
    while growing:
        task.tell(1.0 - 0.3 * len(growing) / len(best.bodies), "Adding strips")
        owner = np.argmax(strengths(best.bodies, sample.points), axis=0)
        for body in growing.copy():
            own = _own_side(sample, owner == body, bool(best.bodies.mirrored[body]))
            trial = _with_one_strip_more(task, best, body, own)
            gain = task.criterion(best) - task.criterion(trial)
            if gain > WORTH:
                best = trial
                steps.append(Step(f"part {body + 1} with {int(np.sum(best.bodies.owner == body))} strips", gain))
            else:
                growing.remove(body)
        best = task.together(best, _TOGETHER)
    return best


def _with_one_strip_more(task: _Task, best: Solution, body: int, own: Cloud) -> Solution:
    """The best of several ways to add a strip to a body with these points, which is moved alone; if there is room for one."""
    if np.sum(best.bodies.owner == body) >= task.strips or len(own.points) < FEWEST:
        return best
    moving = np.arange(len(best.bodies)) == body
    tried = [task.settled(best, bodies, moving, own.points) for bodies in with_one_more(own, best, body)[:_STRIPS]]
    return min(tried, key=lambda solution: solution.cost, default=best)


def _own_side(sample: Cloud, own: NDArray[np.bool_], mirrored: bool) -> Cloud:
    return sample.only(own & (sample.points[:, 0] >= 0) if mirrored else own)
