"""Clay patted flatter and blocks chopped: strips added where a plane shall bite, their other planes out of the way.

"Patting a lump of clay" and cutting planes from a block are the tools that Hanson (1988, section 6) asks for.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import inf, log

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hqmodel.field import Terms, images, log_ratio, region, term_weights, value
from hqmodel.model import Scene, Shape, Strip

from .paths import EditError, get, put
from .planes import placed

# A new strip's other plane lies this many times as far off as the body's far side: |h|^gamma is next to nothing there.
CLEAR = 1.4
# The exponent that planes patted and cut are given, unless another is asked for.
PAT, CHOP = 16.0, 80.0
# A pat goes no deeper than to this share of the way to the new strip's other plane.
_DEEPEST = 0.99


def clay_at(scene: Scene, point: ArrayLike) -> tuple[int, NDArray[np.float64]]:
    """The shape that adds most to the body at a world point (3,), and the signs (3,) of its mirror image there.

    Raises EditError where nothing adds.
    """
    terms = Terms.of(scene)
    adding = terms.keep(terms.positive)
    if not len(adding):
        raise EditError("shapes: expected a visible shape that adds, got none")
    best = int(np.argmax(term_weights(adding, point)))
    shape = int(adding.term_source[best])
    first = int(np.flatnonzero(adding.term_source == shape)[0])
    return shape, list(images(scene.shapes[shape]))[best - first]


def pat(scene: Scene, shape: int, point: ArrayLike, normal: ArrayLike, depth: float, gamma: float = PAT) -> Scene:
    """The body pushed in at a surface point (3,) against its outward unit normal (3,), both in the world, so far and no further.

    A strip is added to the shape, one plane across the normal and the other beyond its far side. It stands so that the surface
    passes through the point moved in by `depth`: as depth grows from 0 it comes in from far away, and the surface follows.
    """
    at, out = np.asarray(point, dtype=float), np.asarray(normal, dtype=float)
    out = _flat(out) if scene.dimension == 2 else out / np.linalg.norm(out)
    length = CLEAR * _behind(scene.shapes[shape], scene, at, out)
    h = _room(scene, shape, at - depth * out) ** (1 / gamma)
    # h = 1 at near, -1 at -length, and this h at -depth
    near = (length * (1 - h) - 2 * depth) / (1 + h) if h < inf else -depth
    near = max(near, -length * _DEEPEST)
    start = float(out @ at)
    return _bounded(scene, shape, out, start + near, start - length, gamma)


def chop(scene: Scene, shapes: Iterable[int], point: ArrayLike, normal: ArrayLike, gamma: float = CHOP) -> Scene:
    """These shapes cut by the plane through a world point (3,): what lies on the side of the normal (3,) goes.

    A shape that the plane does not reach stays as it is.
    """
    at, out = np.asarray(point, dtype=float), np.asarray(normal, dtype=float)
    out = _flat(out) if scene.dimension == 2 else out / np.linalg.norm(out)
    start = float(out @ at)
    for index in shapes:
        shape: Shape = get(scene, ("shapes", index))
        low, high = _extent(shape, scene, out)
        if low < start < high:
            scene = _bounded(scene, index, out, start, start - CLEAR * (start - low), gamma)
    return scene


def _bounded(scene: Scene, shape: int, out: NDArray[np.float64], near: float, far: float, gamma: float) -> Scene:
    """The shape with a strip more, its planes at out . x = near and = far."""
    strip = Strip(normal=(0.0, 0.0, 1.0), gamma=gamma)
    planes = placed(strip, scene.shapes[shape], scene.slice, out, near, far)
    return put(scene, ("shapes", shape, "strips"), (*scene.shapes[shape].strips, strip.__dict__ | planes))


def _room(scene: Scene, shape: int, at: NDArray[np.float64]) -> float:
    """What H of the shape may grow by at a point (3,) until the surface passes there; inf where other shapes fill it.

    With T = ln c + beta (C - H) of the shape's own term, exp(T) must come down to -F of all the others.
    """
    terms = Terms.of(scene)
    own = terms.term_source == shape
    alone = replace(terms.keep(own), level=1.0)
    rest = -float(value(terms.keep(~own), at)) if not np.all(own) else terms.level
    if rest <= 0:
        return inf
    return max(0.0, (float(log_ratio(alone, at)) - log(rest)) / scene.shapes[shape].hardness)


def _behind(shape: Shape, scene: Scene, at: NDArray[np.float64], out: NDArray[np.float64]) -> float:
    """How far the shape reaches from a point against this direction."""
    low, high = _extent(shape, scene, out)
    return max(float(out @ at) - low, 0.05 * (high - low))


def _extent(shape: Shape, scene: Scene, out: NDArray[np.float64]) -> tuple[float, float]:
    """How far the shape, by itself and without its mirror images, reaches along a direction; its box's corners decide."""
    lone = shape.changed(visible=True, coefficient=abs(shape.coefficient), mirror=())
    box = region(scene.changed(shapes=(lone,)))
    if box.empty:
        box = region(scene)
    reach = float(np.abs(out) @ box.size) / 2
    middle = float(out @ box.centre)
    return middle - reach, middle + reach


def _flat(out: NDArray[np.float64]) -> NDArray[np.float64]:
    """The direction's part in the plane of a flat scene, of length 1."""
    out = out * (1.0, 1.0, 0.0)
    length = float(np.linalg.norm(out))
    if length < 1e-9:
        raise EditError("a flat scene is shaped at its outline: expected a point there")
    return out / length
