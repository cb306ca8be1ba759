"""Shapes moved, turned, scaled, stretched, set about an axis and made to carve: pure functions from a scene to a new one.

Everything is in world coordinates. Each raises `EditError` with one line when an index is not there or the result would not be
a valid scene.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hqmodel.field import rotation_matrix
from hqmodel.model import Scene, Shape, Transform, vector

from .angles import Quaternion, about, composed
from .paths import get, put, put_fields
from .shapes import duplicate_shape, move_shape

Array = NDArray[np.float64]


def move_shapes(scene: Scene, indices: Iterable[int], by: ArrayLike) -> Scene:
    """The shapes shifted by a vector (3,); a flat scene's stay in their plane."""
    shift = np.asarray(by, dtype=float) * (1.0, 1.0, scene.dimension == 3)
    for index in indices:
        old = _transform(scene, index)
        scene = _put(scene, index, translation=vector(np.array(old.translation) + shift))
    return scene


def turn_shapes(scene: Scene, indices: Iterable[int], turn: Quaternion, pivot: ArrayLike) -> Scene:
    """The shapes turned about a point (3,) by a unit quaternion x, y, z, w."""
    centre, matrix = np.asarray(pivot, dtype=float), rotation_matrix(turn)
    for index in indices:
        old = _transform(scene, index)
        translation = centre + matrix @ (np.array(old.translation) - centre)
        scene = _put(scene, index, translation=vector(translation), rotation=composed(turn, old.rotation))
    return scene


def scale_shapes(scene: Scene, indices: Iterable[int], factor: float, pivot: ArrayLike) -> Scene:
    """The shapes made larger or smaller about a point (3,), the same in all directions."""
    centre = np.asarray(pivot, dtype=float)
    for index in indices:
        old = _transform(scene, index)
        translation = centre + factor * (np.array(old.translation) - centre)
        scene = _put(scene, index, translation=vector(translation), scale=vector(factor * np.array(old.scale)))
    return scene


def stretch_shapes(scene: Scene, indices: Iterable[int], axis: ArrayLike, factor: float, pivot: ArrayLike) -> Scene:
    """The shapes drawn out along a world axis (3,), each along that of its own axes that is nearest to it."""
    centre, along = np.asarray(pivot, dtype=float), np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    for index in indices:
        old = _transform(scene, index)
        shift = (factor - 1) * float(along @ (np.array(old.translation) - centre)) * along
        scale = np.array(old.scale)
        scale[int(np.argmax(np.abs(rotation_matrix(old.rotation).T @ along)))] *= factor
        scene = _put(scene, index, translation=vector(np.array(old.translation) + shift), scale=vector(scale))
    return scene


def repeat_around(scene: Scene, index: int, axis: Sequence[float], count: int, pivot: ArrayLike = (0.0, 0.0, 0.0)) -> Scene:
    """`count` - 1 copies of the shape after it, turned evenly about an axis (3,) through a point (3,)."""
    for number in range(1, count):
        scene = duplicate_shape(scene, index)
        scene = turn_shapes(scene, [index + 1], about(axis, 360 / count * number), pivot)
        scene = move_shape(scene, index + 1, index + number)
    return scene


def carve(scene: Scene, indices: Collection[int], carving: bool) -> Scene:
    """The shapes made to take clay away where they stood for clay, or the other way round."""
    for index in indices:
        coefficient = abs(get(scene, ("shapes", index, "coefficient")))
        scene = put(scene, ("shapes", index, "coefficient"), -coefficient if carving else coefficient)
    return scene


def _transform(scene: Scene, index: int) -> Transform:
    shape: Shape = get(scene, ("shapes", index))
    return shape.transform


def _put(scene: Scene, index: int, **changes: object) -> Scene:
    return put_fields(scene, ("shapes", index, "transform"), **changes)
