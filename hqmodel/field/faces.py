"""The bounding planes as one sees and takes hold of them: where each is, and the polygon that a shape's others leave of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hqmodel.model import Scene, Shape

from .evaluate import term_weights
from .terms import Array, Terms, images, world_planes

# A polygon is cut out of a square this many times as large as the shape's polytope could be.
_AMPLE = 4.0


@dataclass(frozen=True, eq=False)
class Face:
    """One of a strip's two planes, h = 1 or h = -1, in world units.

    `normal` (3,) points out of the strip, `middle` (3,) is the polygon's centre. `polygon` (n, 3) is what the shape's other
    planes leave of the plane, corners in order; (0, 3) where they leave nothing. `thickness` is the distance of the two planes.
    """

    normal: Array
    middle: Array
    polygon: Array
    thickness: float


def face(shape: Shape, t: float, strip: int, side: int, image: ArrayLike = (1.0, 1.0, 1.0), flat: bool = False) -> Face:
    """A strip's plane h = side (1 or -1) at the slice t, in the mirror image of these signs (3,); when flat, at z = 0 alone.

    The polytope is |h_a| <= 1 for all strips that close the shape (eq. 13); the hyperbolic ones bound nothing.
    """
    normals, offsets = (np.clip(values, -1e100, 1e100) for values in world_planes(shape, t))
    length = float(np.linalg.norm(normals[strip]))
    out = side * normals[strip] / length
    distance = (1.0 - side * offsets[strip]) / length
    others = [a for a in range(len(shape.strips)) if a != strip and shape.strips[a].sign > 0]
    polygon = _square(out, distance, normals, offsets)
    for a in others:
        for sign in (1.0, -1.0):
            polygon = _clipped(polygon, sign * normals[a], 1.0 - sign * offsets[a])
    for z in (1.0, -1.0) if flat else ():
        polygon = _clipped(polygon, np.array([0.0, 0.0, z]), 0.0)
    middle = polygon.mean(axis=0) if len(polygon) else out * distance
    signs = np.asarray(image, dtype=float)
    return Face(out * signs, middle * signs, polygon * signs, 2.0 / length)


def image_at(shape: Shape, t: float, point: ArrayLike) -> Array:
    """The signs (3,) of the mirror image of the shape that a world point (3,) belongs to; all 1 for the shape itself."""
    every = list(images(shape))
    if len(every) == 1:
        return every[0]
    alone = Terms.of(_lone(shape, t))
    return every[int(np.argmax(term_weights(alone, point)))]


def _lone(shape: Shape, t: float) -> Scene:
    return Scene(shapes=(shape.changed(visible=True, coefficient=1.0),), slice=t)


def _square(out: Array, distance: float, normals: Array, offsets: Array) -> Array:
    """A square in the plane out . x = distance, large enough for any polytope of these planes to fit in, (4, 3)."""
    reach = _AMPLE * float(np.max((1.0 + np.abs(offsets)) / np.linalg.norm(normals, axis=1)))
    across = np.cross(out, np.eye(3)[np.argmin(np.abs(out))])
    across /= np.linalg.norm(across)
    up = np.cross(out, across)
    return out * distance + reach * np.array([across + up, up - across, -across - up, across - up])


def _clipped(polygon: Array, normal: Array, limit: float) -> Array:
    """The part of a convex polygon (n, 3) where normal . x <= limit (Sutherland and Hodgman 1974)."""
    beyond = polygon @ normal - limit
    corners = []
    for here, there, a, b in zip(polygon, np.roll(polygon, -1, axis=0), beyond, np.roll(beyond, -1), strict=True):
        if a <= 0:
            corners.append(here)
        if (a <= 0) != (b <= 0):
            corners.append(here + (there - here) * a / (a - b))
    return np.array(corners).reshape(-1, 3)
