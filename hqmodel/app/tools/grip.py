"""What is under the pointer as something to take hold of: one bounding plane of one strip, at one point of the surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hqmodel.field import Face, Terms, face, image_at, log_gradient, shaping_strip, world_planes
from hqmodel.model import Scene, Vector, vector

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Grip:
    """Side 1 or -1 of a shape's strip, held at a world point, in the mirror image of these signs."""

    shape: int
    strip: int
    side: int
    point: Vector
    image: Vector = (1.0, 1.0, 1.0)

    def face(self, scene: Scene) -> Face:
        """The plane that is held."""
        return face(scene.shapes[self.shape], scene.slice, self.strip, self.side, self.image, scene.dimension == 2)


def grip_at(scene: Scene, point: ArrayLike, shape: int | None = None, strip: int | None = None) -> Grip | None:
    """The plane that shapes the surface at a world point (3,), or the nearer one of a given strip; None where there is no shape.

    In a flat scene the point is one of the outline's plane.
    """
    at = np.asarray(point, dtype=float) * (1.0, 1.0, scene.dimension == 3)
    if shape is None or strip is None:
        terms = Terms.of(scene)
        if not len(terms):
            return None
        shape, strip = (int(index) for index in terms.strip_source[int(shaping_strip(terms, at))])
    image = image_at(scene.shapes[shape], scene.slice, at)
    normals, offsets = world_planes(scene.shapes[shape], scene.slice)
    side = 1 if normals[strip] @ (at * image) + offsets[strip] >= 0 else -1
    return Grip(shape, strip, side, vector(at), vector(image))


def outward(scene: Scene, point: ArrayLike) -> Array:
    """The surface's outward unit normal at a world point (3,); up where there is none."""
    slope = -log_gradient(Terms.of(scene), point)[1]
    length = float(np.linalg.norm(slope))
    return slope / length if length > 0 else np.array([0.0, 0.0, 1.0])
