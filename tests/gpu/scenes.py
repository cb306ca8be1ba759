"""Random scenes for the GPU's tests: everything the format allows, the spicy ends included, from a seed."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from hqmodel.model import Group, Scene, Shape, Strip, Transform

Array = NDArray[np.float64]
Triple = tuple[float, float, float]
EXPONENTS = (0.05, 0.3, 0.6, 1.0, 1.5, 2.0, 4.0, 8.0, 40.0, 60.0, 400.0, 1000.0)
AXES = np.concatenate([np.eye(3), [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]])


def _triple(values: Array) -> Triple:
    x, y, z = (float(value) for value in values)
    return x, y, z


def random_shape(rng: Generator, exponents: tuple[float, ...] = EXPONENTS, signs: bool = True) -> Shape:
    """A shape about the origin; with `signs` it may be hyperbolic or carve."""
    count = int(rng.integers(3, 7))
    normals = np.concatenate([np.eye(3), AXES[rng.permutation(len(AXES))]])[:count] + 0.2 * rng.normal(size=(count, 3))
    grouped = int(rng.choice([0, 0, 2, 3]))
    inner = float(rng.choice(exponents))
    strips = tuple(
        Strip(
            normal=_triple(normals[i]),
            offset=float(0.2 * rng.normal()),
            half_width=float(rng.choice([0.02, 0.3, 0.6, 1.0])) if i < 1 else float(rng.uniform(0.4, 1.0)),
            gamma=inner if i < grouped else float(rng.choice(exponents)),
            sign=-1 if signs and i >= grouped and rng.random() < 0.12 else 1,
            group="g" if i < grouped else None,
        )
        for i in range(count)
    )
    turn = rng.normal(size=4)
    x, y, z, w = (float(part) for part in turn / np.linalg.norm(turn))
    return Shape(
        strips=strips,
        groups={"g": Group(gamma=float(rng.choice(exponents)), sign=-1 if signs and rng.random() < 0.1 else 1)}
        if grouped
        else {},
        coefficient=float(rng.choice([1.0, 1.0, 0.7, -1.5] if signs else [1.0, 0.7, 2.0])),
        hardness=float(rng.choice([0.5, 1.0, 4.0, 20.0])),
        constant=float(rng.choice([1.0, 1.0, 1.0, 0.0, -1.0])) if signs else 1.0,
        mirror=("x",) if rng.random() < 0.2 else (),
        transform=Transform(
            translation=_triple(0.7 * rng.normal(size=3)), rotation=(x, y, z, w), scale=_triple(rng.uniform(0.4, 1.2, size=3))
        ),
    )


def random_scene(rng: Generator, shapes: int, exponents: tuple[float, ...] = EXPONENTS, signs: bool = True) -> Scene:
    """A scene of so many shapes, cut by a box when signs make it likely to be without end."""
    parts = tuple(random_shape(rng, exponents, signs and index > 0) for index in range(shapes))
    bounds = ((-2.0, -2.0, -2.0), (2.0, 2.0, 2.0)) if signs and rng.random() < 0.5 else None
    return Scene(shapes=parts, level=float(rng.choice([1.0, 1.0, 0.4])), bounds=bounds)


def random_rays(rng: Generator, low: Array, high: Array, count: int) -> tuple[Array, Array]:
    """Origins on a sphere around the box from low to high, unit directions at points in it, (count, 3) each."""
    centre, radius = (low + high) / 2, float(np.linalg.norm(high - low))
    outwards = rng.normal(size=(count, 3))
    origins = centre + radius * outwards / np.linalg.norm(outwards, axis=1, keepdims=True)
    directions = rng.uniform(low, high, size=(count, 3)) - origins
    return origins, directions / np.linalg.norm(directions, axis=1, keepdims=True)


def ball(place: Triple = (0.0, 0.0, 0.0), radius: float = 1.0) -> Scene:
    """A sphere."""
    return solid(2.0, place, radius)


def solid(gamma: float, place: Triple = (0.0, 0.0, 0.0), size: float = 1.0) -> Scene:
    """The superquadric of one exponent: a sphere at 2, nearly a cube at 40."""
    strips = tuple(Strip(normal=normal, gamma=gamma) for normal in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    transform = Transform(translation=place, scale=(size, size, size))
    return Scene(shapes=(Shape(strips=strips, transform=transform),))
