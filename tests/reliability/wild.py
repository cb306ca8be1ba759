"""Random scenes over all that the format permits: numbers stay numbers, bounds contain, and there is a mesh or a MeshError.

Run as `python -m tests.reliability.wild COUNT SEED PICTURES`: so many scenes, the first so many drawn too; prints what came of
them and ends with an error at the first fault, which names the scene's seed.
"""

from __future__ import annotations

import json
import sys
import warnings
from collections import Counter
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from hqmodel.field import Region, Terms, box_bounds, gradient, log_ratio, region, value
from hqmodel.mesh import MeshError, polygonize
from hqmodel.model import Scene

Array = NDArray[np.float64]
CELLS = 16
BOXES, POINTS = 60, 5
SIDE = 32
# What rounding may move L, of its own size.
_ROUNDING = 1e-9


def scene_of(seed: int) -> Scene:
    """The scene of that seed: one to four shapes, of any size from 1e-6 to 1e6 and of any exponents, hyperbolic ones too."""
    chance = np.random.default_rng(seed)
    size = _magnitude(chance, -6, 6)
    flat = chance.random() < 0.15
    tree: dict[str, Any] = {"format": "hqmodel", "version": 1, "dimension": 2 if flat else 3}
    tree["level"] = _mostly(chance, 1, 0, _magnitude(chance, -6, 6))
    tree["slice"] = _mostly(chance, 0, size * chance.normal(), chance.normal() * _magnitude(chance, -6, 6))
    tree["shapes"] = [_shape(chance, size, flat) for _ in range(chance.integers(1, 5))]
    if chance.random() < 0.3:
        low = size * chance.normal(size=3)
        tree["bounds"] = [low.tolist(), (low + size * 10 ** chance.uniform(-2, 2, 3)).tolist()]
    return Scene.model_validate(tree)


def _magnitude(chance: Generator, low: float, high: float) -> float:
    """Any power of ten between these two."""
    return float(10 ** chance.uniform(low, high))


def _mostly(chance: Generator, usual: float, *others: float) -> float:
    """The usual value, four times of five."""
    return float(usual if chance.random() < 0.8 else chance.choice(others))


def _gamma(chance: Generator) -> float:
    return float(np.clip(_magnitude(chance, np.log10(0.05), 3), 0.05, 1000))


def _shape(chance: Generator, size: float, flat: bool) -> dict[str, Any]:
    hyperbolic = 0.3 if chance.random() < 0.3 else 0.0
    strips = [_strip(chance, size, flat, number, hyperbolic) for number in range(chance.integers(2 if flat else 3, 8))]
    groups = {}
    if chance.random() < 0.3:
        groups["rim"] = {"gamma": _gamma(chance), "sign": 1}
        for strip in strips[:2]:
            strip.update(group="rim", gamma=strips[0]["gamma"], sign=1)
    turned = chance.normal(size=4) * (0 if flat else 1) + [0, 0, 0, 1e-3]
    place = size * chance.normal(size=3) * [1, 1, 0 if flat else 1]
    return {
        "coefficient": _mostly(chance, 1, -1, _magnitude(chance, -6, 6)),
        "hardness": _mostly(chance, 4, _magnitude(chance, -3, 3)),
        "constant": _mostly(chance, 1, 0, -1, _magnitude(chance, -3, 3)),
        "mirror": [axis for axis in "xyz" if chance.random() < 0.1 and not flat],
        "transform": {
            "translation": place.tolist(),
            "rotation": (turned / np.linalg.norm(turned)).tolist(),
            "scale": chance.choice([np.ones(3), 10 ** chance.uniform(-1, 1, 3)]).tolist(),
        },
        "groups": groups,
        "strips": strips,
    }


def _strip(chance: Generator, size: float, flat: bool, number: int, hyperbolic: float) -> dict[str, Any]:
    normal = np.eye(3)[number] if number < 3 and chance.random() < 0.6 else chance.normal(size=3)
    if flat:
        normal = normal * [1, 1, 0] + [1e-9, 0, 0]
    return {
        "normal": (normal * _mostly(chance, 1, _magnitude(chance, -3, 3))).tolist(),
        "slice": float(chance.normal()),
        "offset": _mostly(chance, 0, 0.3 * size * chance.normal()),
        "half_width": _mostly(
            chance, size * _magnitude(chance, -0.5, 0.5), size * _magnitude(chance, -2, 2), _magnitude(chance, -6, 6)
        ),
        "gamma": _gamma(chance),
        "sign": -1 if chance.random() < hyperbolic else 1,
    }


def points_of(chance: Generator, where: Region) -> Array:
    """Points (n, 3) in the body's box, around it as far as a thousand times its size, and anywhere."""
    inside = where.low + where.size * chance.random((150, 3))
    around = where.centre + where.size * chance.normal(size=(60, 3)) * 10 ** chance.uniform(-3, 3, (60, 1))
    anywhere = chance.normal(size=(30, 3)) * 10 ** chance.uniform(-6, 6, (30, 1))
    return np.concatenate([inside, around, anywhere, np.zeros((1, 3))])


def check(seed: int) -> str:
    """What came of the scene as a mesh: "a mesh", or the error's beginning. Raises AssertionError, or a warning, at a fault."""
    scene, chance = scene_of(seed), np.random.default_rng([seed, 1])
    terms = Terms.of(scene)
    where = region(scene, terms)
    assert np.all(np.isfinite([where.low, where.high])) and np.all(where.low <= where.high), "the region is a box"
    points = points_of(chance, where)
    values = value(terms, points)
    assert not np.any(np.isnan(values)), "the field is a number"
    assert not np.any(np.isnan(gradient(terms, points))), "its gradient is one"
    _check_region(scene, where, points, values)
    _check_bounds(terms, chance, points[:BOXES], where)
    try:
        body = polygonize(scene, CELLS)
    except MeshError as error:
        return str(error).partition(":")[0].partition(", got")[0]
    assert len(body.faces) and np.all(np.isfinite(body.vertices)), "the mesh has faces at places that are numbers"
    assert body.normals is not None and np.all(np.isfinite(body.normals)), "and directions too"
    return "a mesh"


def _check_region(scene: Scene, where: Region, points: Array, values: Array) -> None:
    """What is body lies in the box, unless that cuts it."""
    if scene.bounds is None and where.bounded:
        axes = slice(0, scene.dimension)
        beyond = np.any((points < where.low)[:, axes] | (points > where.high)[:, axes], axis=1)
        assert not np.any(beyond & (values > _ROUNDING * scene.level)), "the region holds the body"


def _check_bounds(terms: Terms, chance: Generator, middles: Array, where: Region) -> None:
    """L at random points of random boxes lies within the bounds that hold for the box."""
    half = where.size * 10 ** chance.uniform(-4, 1, (len(middles), 1))
    low, high = middles - half, middles + half
    least, most = box_bounds(terms, low, high)
    for _ in range(POINTS):
        ratio = log_ratio(terms, low + (high - low) * chance.random(low.shape))
        slack = _ROUNDING * np.where(np.isfinite(ratio), np.abs(ratio), 0.0)
        assert np.all((least - slack <= ratio) & (ratio <= most + slack)), "the bounds of a box hold in it"


def drawn(seed: int, ctx: Any) -> None:
    """A small picture of the scene, all of it drawn, without an error of OpenGL."""
    from hqmodel.gpu import render

    pixels = render(scene_of(seed), size=(SIDE, SIDE), samples=1, ctx=ctx)
    assert pixels.shape == (SIDE, SIDE, 4) and np.all(pixels[..., 3] == 255), "every pixel is drawn"
    assert np.all(np.any(pixels[..., :3] > 0, axis=-1)), "none is black, as what is no number is"
    assert ctx.error == "GL_NO_ERROR", ctx.error


def main(count: int, seed: int, pictures: int) -> dict[str, int]:
    """Checks so many scenes; how many meshes and how many of each MeshError there were."""
    from hqmodel.gpu import offscreen

    warnings.simplefilter("error")
    ctx = offscreen() if pictures else None
    told: Counter[str] = Counter()
    for number in range(seed, seed + count):
        try:
            told[check(number)] += 1
            if number < seed + pictures:
                drawn(number, ctx)
        except BaseException as error:
            error.add_note(f"the scene of seed {number}")
            raise
    return dict(told)


if __name__ == "__main__":
    print(json.dumps(main(*map(int, sys.argv[1:4]))))
