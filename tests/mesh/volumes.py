"""Random scenes and their volumes, worked out along lines by exact bounds: what meshes are held against.

``python -m tests.mesh.volumes 200 256`` looks at 200 of them, meshed with 256 cells.
"""

from __future__ import annotations

import sys

import numpy as np
from numpy.random import default_rng
from numpy.typing import NDArray

from hqmodel.field import Region, Terms, log_ratio, region, segment_bounds
from hqmodel.mesh import MeshError, polygonize, report, thin_parts
from hqmodel.model import Scene

from ..gpu.scenes import random_scene

ROUND, SHARP = (1.0, 1.3, 2.0, 4.0, 12.0, 60.0), (0.5, 0.8, 1.0, 2.0, 12.0)
# The points of the R2 sequence (M. Roberts 2018) fill the unit square evenly, in no rows: powers of the plastic number.
_PLASTIC = 1.32471795724474602596
_FINEST, _HALVINGS = 2**-11, 16
_FEW = 2000
Array = NDArray[np.float64]


def volume(scene: Scene, lines: int = 60_000) -> float:
    """Of the body, by so many lines through it, along the axis that most of them meet it by."""
    terms = Terms.of(scene)
    where = region(scene, terms)
    axis = max(range(3), key=lambda axis: np.count_nonzero(_lengths(terms, where, axis, _FEW)))
    return float(np.mean(_lengths(terms, where, axis, lines))) * float(np.prod(where.size))


def _lengths(terms: Terms, where: Region, axis: int, lines: int) -> Array:
    """How much of each line is inside, (lines,): halved until exact bounds tell its parts to be inside or outside."""
    across = (np.arange(1, lines + 1)[:, None] * [1 / _PLASTIC, 1 / _PLASTIC**2]) % 1.0
    every, low, high = np.arange(lines), np.zeros(lines), np.ones(lines)
    inside = np.zeros(lines)

    def at(share: Array) -> Array:
        return where.low + np.insert(across[every], axis, share, axis=1) * where.size

    while len(every) and high[0] - low[0] > _FINEST:
        middle = (low + high) / 2
        every, low, high = np.tile(every, 2), np.concatenate([low, middle]), np.concatenate([middle, high])
        least, most = segment_bounds(terms, at(low), at(high))
        np.add.at(inside, every[least > 0], (high - low)[least > 0])
        unclear = (least <= 0) & (most > 0)
        every, low, high = every[unclear], low[unclear], high[unclear]
    first = log_ratio(terms, at(low)) > 0
    start, end = low.copy(), high.copy()
    for _ in range(_HALVINGS):  # of what is left each part is taken to hold one root, or none
        middle = (low + high) / 2
        before = (log_ratio(terms, at(middle)) > 0) == first
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    np.add.at(inside, every, np.where(first, high - start, end - high))
    return inside


def scene_of(seed: int) -> Scene:
    """Every third with exponents below 1, some mirrored, all with an end."""
    rng = default_rng(5000 + seed)
    scene = random_scene(rng, shapes=1 + seed % 4, exponents=SHARP if seed % 3 == 0 else ROUND)
    if seed % 5 == 0:
        scene = scene.changed(shapes=tuple(shape.changed(mirror=("x", "y")) for shape in scene.shapes))
    if scene.bounds is None and not region(scene).bounded:
        scene = scene.changed(bounds=((-2.0, -2.0, -2.0), (2.0, 2.0, 2.0)))
    return scene


def error(scene: Scene, resolution: int, lines: int = 60_000) -> float | None:
    """By how much, as a share, the mesh's volume differs; None where there is no body. The mesh has to be sound."""
    try:
        measured = report(polygonize(scene, resolution, shading=False))
    except MeshError:
        return None
    assert measured["watertight"]
    return float(measured["volume"]) / volume(scene, lines) - 1


def main(count: int, resolution: int) -> None:
    """Print the largest differences of scenes whose exponents are 1 at least, and of the others."""
    found: dict[bool, list[tuple[float, int]]] = {True: [], False: []}
    for seed in range(count):
        scene = scene_of(seed)
        off = error(scene, resolution)
        if off is not None:
            found[seed % 3 == 0].append((abs(off), seed))
            print(seed, f"{off:.1e}", thin_parts(scene, resolution), flush=True)
    for sharp, errors in found.items():
        print("below 1" if sharp else "1 at least", len(errors), sorted(errors)[-8:])


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
