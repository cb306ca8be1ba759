"""Shapes added, removed, copied, named and put in another order: pure functions from a scene to a new one.

Each raises `EditError` with one line when an index is not there or the result would not be a valid scene.
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import count

from hqmodel.model import Scene, Shape, unused_name

from .paths import get, put


def add_shape(scene: Scene, shape: Shape) -> Scene:
    """The shape appended, under a name that no other has."""
    return put(scene, ("shapes",), (*scene.shapes, _named(scene, shape)))


def remove_shapes(scene: Scene, indices: Collection[int]) -> Scene:
    """The scene without the shapes of these indices."""
    for index in indices:
        get(scene, ("shapes", index))
    return put(scene, ("shapes",), tuple(shape for i, shape in enumerate(scene.shapes) if i not in indices))


def duplicate_shape(scene: Scene, index: int) -> Scene:
    """A copy of the shape right after it, under a name of its own."""
    shape = get(scene, ("shapes", index))
    shapes = (*scene.shapes[: index + 1], _named(scene, shape), *scene.shapes[index + 1 :])
    return put(scene, ("shapes",), shapes)


def move_shape(scene: Scene, index: int, to: int) -> Scene:
    """The shape taken out and put in again so that its index is `to`."""
    shape = get(scene, ("shapes", index))
    get(scene, ("shapes", to))
    rest = [*scene.shapes[:index], *scene.shapes[index + 1 :]]
    return put(scene, ("shapes",), (*rest[:to], shape, *rest[to:]))


def rename_shapes(scene: Scene, indices: Collection[int], name: str) -> Scene:
    """The shapes called by the name and a number, in their order, passing over what others are called; one alone by the name."""
    for index in indices:
        get(scene, ("shapes", index))
    taken = {shape.name for index, shape in enumerate(scene.shapes) if index not in indices}
    free = (numbered for number in count(1) if (numbered := f"{name} {number}") not in taken)
    shapes = list(scene.shapes)
    for index in sorted(set(indices)):
        shapes[index] = shapes[index].changed(name=next(free) if name and len(indices) > 1 else name)
    return put(scene, ("shapes",), tuple(shapes))


def _named(scene: Scene, shape: Shape) -> Shape:
    name = unused_name(shape.name or "Shape", {other.name for other in scene.shapes})
    return shape.changed(name=name)
