"""Ways to have one body more: one is split, one is added, or one carves."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from .bodies import FLIP, Array, Bodies
from .distance import distances, strengths
from .solve import Solution
from .starts import held, principal_axes

# What new bodies begin with.
_HARDNESS, _GAMMA = 5.0, 2.5
# How far a body may grow in width.
_ROOM = 1.5
# Bodies that are tried to be split each time, groups of points that are tried to be added, and the fewest that make a body.
_SPLIT, _ADDED, FEWEST = 8, 3, 10
# Points this many times further apart than neighbours are no longer of one group; how far out they all are, in the deviation's
# multiples and in any case; and the least share of all points that is carved for: smaller dents are left to the bodies that add.
_GROUPED, _LEVELS, _OUT, _HOLLOW = 4.0, (1.0, 2.0, 4.0), 0.004, 0.05


@dataclass(frozen=True, eq=False)
class Way:
    """Bodies changed: some new ones, made of points (N, 3), take the place of others."""

    what: str
    kept: list[Bodies]
    fresh: list[Bodies]
    points: Array


def ways(best: Solution, points: Array, symmetric: bool) -> list[Way]:
    """The ways to have one body more than these, by points (N, 3): the worst of them split, one added, one carving.

    If `symmetric`, new bodies are so in x = 0, or come in pairs.
    """
    miss = distances(best.bodies, points)
    owner = np.argmax(strengths(best.bodies, points), axis=0)
    cost = np.minimum(np.abs(miss), 0.05)
    found = []
    for body in np.argsort(-np.bincount(owner, cost, len(best.bodies)))[:_SPLIT]:
        own = owner == body
        for halves in _halves(points[own], miss[own], symmetric):
            fresh = [round_box(half, symmetric) for half in halves]
            found.append(Way(f"part {body + 1} split", best.bodies.others(body), fresh, np.concatenate(halves)))
    for sign, what, fewest in ((1.0, "a part added", FEWEST), (-1.0, "a carving part added", _HOLLOW * len(points))):
        groups = [group for level in _LEVELS for group in _groups(points, sign * miss, level * best.noise.sigma, symmetric)]
        groups = list({group.tobytes(): group for group in groups if len(group) >= fewest}.values())
        found += [Way(what, best.bodies.others(-1), [round_box(group, symmetric, sign)], group) for group in groups]
    return found


def _halves(points: Array, miss: Array, symmetric: bool) -> list[list[Array]]:
    """Points (N, 3) of a body parted in two, in several ways; of a symmetric cloud both halves are, too."""
    one_side = folded(points, symmetric)
    if len(points) < 2 * FEWEST:
        return []
    along = (one_side - one_side.mean(axis=0)) @ principal_axes(one_side).T
    badly = np.abs(miss) > np.quantile(np.abs(miss), 0.75)
    ways = {_compact(one_side, first).tobytes() for first in (*(along > 0).T, badly)}
    labels = [np.frombuffer(way, dtype=bool) for way in sorted(ways)]
    return [[one_side[way], one_side[~way]] for way in labels if FEWEST <= np.count_nonzero(way) <= len(way) - FEWEST]


def folded(points: Array, symmetric: bool) -> Array:
    """Points (N, 3), of a symmetric cloud on one side of its plane."""
    return points * np.where(points[:, :1] < 0, FLIP, 1.0) if symmetric else points


def _compact(points: Array, label: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Two groups made compact: each point goes to the nearer centre (Lloyd)."""
    for _ in range(10):
        if label.all() or not label.any():
            break
        one, other = points[label].mean(axis=0), points[~label].mean(axis=0)
        label = np.linalg.norm(points - one, axis=1) < np.linalg.norm(points - other, axis=1)
    return label if label[0] else ~label


def _groups(points: Array, away: Array, least: float, symmetric: bool) -> list[Array]:
    """The groups of connected points (n, 3) that lie too far out, those furthest in all first."""
    far = away > max(least, _OUT)
    if symmetric:
        far &= points[:, 0] >= 0
    if np.count_nonzero(far) < FEWEST:
        return []
    reach = _GROUPED * np.median(cKDTree(points).query(points, 2)[0][:, 1])
    points, away, tree = points[far], away[far], cKDTree(points[far])
    label = connected_components(tree.sparse_distance_matrix(tree, reach))[1]
    return [points[label == group] for group in np.argsort(-np.bincount(label, away))[:_ADDED]]


def round_box(points: Array, symmetric: bool, sign: float = 1.0) -> Bodies:
    """A round box about points (N, 3), one side's where the cloud is symmetric: in the middle if they reach it, else a pair."""
    mirrored = False
    if symmetric:
        near, far = np.quantile(np.abs(points[:, 0]), (0.03, 0.97))
        mirrored = bool(near > 0.15 * far)
        points = folded(points, symmetric)
        points = points if mirrored else np.concatenate([points, points * FLIP])
    body = held(points, principal_axes(points), _GAMMA)
    widest = _ROOM / np.linalg.norm(body.normal, axis=1)[None]
    chosen = np.array([_HARDNESS]), np.array([sign]), np.array([mirrored])
    return replace(body, hardness=chosen[0], sign=chosen[1], mirrored=chosen[2], widest=widest)
