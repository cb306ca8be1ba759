"""Clouds with a known truth to fit: points of a scene's surface, clean, noisy, among outliers, or of one side only."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from hqmodel.field import Terms, first_hits, near_linear_gradient, region
from hqmodel.model import Group, Scene, Shape, Strip, vector

Array = NDArray[np.float64]
KINDS = ("clean", "noise", "outliers", "one side")
# Noise's deviation as a share of the diagonal, and the share of outliers, which lie anywhere in a box this much larger.
NOISE, OUTLIERS, ROOM = 0.01, 0.2, 0.1
# Median radial errors, as shares of the diagonal, that a fit is to stay under.
GOALS = {"clean": 0.001, "noise": 0.003, "outliers": 0.003, "one side": 0.005}

_REFERENCE = Path(__file__).parent.parent / "tests" / "reference"
# What the random shapes' exponents are of.
_GAMMAS = 1.3, 2.0, 3.0, 5.0, 9.0, 20.0, 60.0


def reference_convex() -> dict[str, Scene]:
    """The reference cases that are one convex body of at most 8 strips."""
    files = sorted(_REFERENCE.glob("*.json"))
    every = {file.stem: Scene.model_validate(json.loads(file.read_text())["preset"]) for file in files}
    return {name: scene for name, scene in every.items() if len(scene.shapes) == 1 and _convex(scene.shapes[0])}


def _convex(shape: Shape) -> bool:
    return len(shape.strips) <= 8 and all(strip.sign > 0 and strip.gamma >= 1 for strip in shape.strips)


def random_convex(seed: int) -> Scene:
    """A convex body of 3 to 8 strips at random."""
    rng = np.random.default_rng(seed)
    normals = _unit(rng.normal(size=(int(rng.integers(3, 9)), 3)))
    while np.linalg.svd(normals, compute_uv=False)[2] < 0.3:
        normals = _unit(rng.normal(size=normals.shape))
    strips = (
        Strip(
            normal=(n[0], n[1], n[2]), gamma=rng.choice(_GAMMAS), half_width=rng.uniform(0.6, 1.15), offset=rng.normal(scale=0.15)
        )
        for n in normals.tolist()
    )
    return Scene(shapes=(Shape(strips=tuple(strips)),))


def random_superquadric(seed: int) -> Scene:
    """Barr's superquadric, two strips of it a group, of convex exponents at random, in any position."""
    rng = np.random.default_rng(seed)
    inner, outer = 2 / rng.uniform(0.1, 1.9, size=2)
    axes, halves = Rotation.random(random_state=rng).as_matrix(), rng.uniform(0.5, 1.2, 3).tolist()
    strips = (
        Strip(normal=vector(normal), half_width=half, gamma=gamma, group=group, offset=rng.normal(scale=0.2))
        for normal, half, gamma, group in zip(axes, halves, (inner, inner, outer), ("rim", "rim", None), strict=True)
    )
    return Scene(shapes=(Shape(strips=tuple(strips), groups={"rim": Group(gamma=outer)}),))


def true_points(scene: Scene, count: int, rng: np.random.Generator) -> Array:
    """Points (count, 3) of the surface, on convex bodies uniform by area: where random lines first meet it."""
    terms = Terms.of(scene)
    where = region(scene, terms)
    radius = float(np.linalg.norm(where.size)) / 2
    found = np.empty((0, 3))
    while len(found) < count:
        along = _unit(rng.normal(size=(count, 3)))
        across = _unit(np.cross(along, rng.normal(size=(count, 3))))
        origins = where.centre - 2 * radius * along + radius * np.sqrt(rng.uniform(size=(count, 1))) * across
        distance = first_hits(terms, where, origins, along)
        found = np.concatenate([found, (origins + distance[:, None] * along)[np.isfinite(distance)]])
    return found[:count]


def cloud(scene: Scene, kind: str, count: int, seed: int) -> Array:
    """A cloud (count, 3) of one of the `KINDS`."""
    rng = np.random.default_rng(seed)
    points = true_points(scene, 4 * count if kind == "one side" else count, rng)
    low, high = points.min(axis=0), points.max(axis=0)
    if kind == "noise":
        points = points + rng.normal(scale=NOISE * np.linalg.norm(high - low), size=points.shape)
    elif kind == "outliers":
        strays, room = round(OUTLIERS * count), ROOM * (high - low)
        points[:strays] = rng.uniform(low - room, high + room, size=(strays, 3))
    elif kind == "one side":
        towards = _unit(rng.normal(size=(1, 3)))[0]
        points = points[near_linear_gradient(Terms.of(scene), points)[1] @ towards < 0][:count]
    return points


def radial_errors(fitted: Scene, truth: Scene, count: int = 2000) -> Array:
    """How far (count,) the fitted surface is from points of the true one, along rays to its middle, as shares of its diagonal."""
    points = true_points(truth, count, np.random.default_rng(count))
    return radial(fitted, points, (points.min(axis=0) + points.max(axis=0)) / 2)


def radial(fitted: Scene, points: Array, middle: Array) -> Array:
    """How far (N,) the surface is from points (N, 3) along rays to a middle, as shares of their diagonal.

    Infinite where a ray misses.
    """
    terms = Terms.of(fitted)
    diagonal = float(np.linalg.norm(np.ptp(points, axis=0)))
    reach = np.linalg.norm(points - middle, axis=1)
    out = (points - middle) / reach[:, None]
    distance = first_hits(terms, region(fitted, terms), middle + 4 * diagonal * out, -out)
    away = np.abs(4 * diagonal - distance - reach) / diagonal
    return np.where(np.isfinite(away), away, np.inf)


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))
