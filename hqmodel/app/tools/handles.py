"""The handles on the selected strip: an arrow to push it, a ring to tilt it, a diamond for its exponent."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin
from typing import Literal

import numpy as np

from hqmodel.field import Face
from hqmodel.model import Scene, Vector, vector

from .aim import Aim, Array, Pixels
from .gesture import Gesture
from .grip import Grip
from .sculpting import Push, Soften, Tilt, Way

Part = Literal["push", "tilt", "exponent"]
# All in pixels of a screen of usual density: where the arrow begins and ends, the ring's radius, how near the pointer must be.
_ARROW, _RING, _NEAR = (16.0, 64.0), 44.0, 8.0
_CORNERS = 64


@dataclass(frozen=True, eq=False)
class Handles:
    """Where the handles are seen: pixels (n, 2), and the ring's points in the world too, relative to the face's middle.

    `scale`: how many pixels one of a screen of usual density is.
    """

    grip: Grip
    face: Face
    middle: Array
    arrow: Array
    ring: Array
    arms: Array
    scale: float = 1.0

    def at(self, pixel: Pixels) -> Part | None:
        """The handle under the pointer."""
        near = _NEAR * self.scale
        if _distance(self.middle, pixel) < 1.2 * near:
            return "exponent"
        if (
            min(_distance(self.arrow[0] + share * (self.arrow[1] - self.arrow[0]), pixel) for share in np.linspace(0, 1, 9))
            < near
        ):
            return "push"
        return "tilt" if self._nearest(pixel)[1] < near else None

    def taken(self, part: Part, scene: Scene, aim: Aim, pixel: Pixels, way: Way) -> Gesture:
        """What a drag of that handle is."""
        match part:
            case "push":
                return Push(scene, aim, self.grip, way)
            case "exponent":
                return Soften(scene, aim, self.grip.shape, self.grip.strip)
            case "tilt":
                return Tilt(scene, aim, self.grip, vector(self.face.middle), vector(self.arms[self._nearest(pixel)[0]]))

    def _nearest(self, pixel: Pixels) -> tuple[int, float]:
        distances = np.nan_to_num(np.hypot(*(self.ring - pixel).T), nan=np.inf)
        best = int(np.argmin(distances))
        return best, float(distances[best])


def handles(
    scene: Scene, shape: int, strip: int, aim: Aim, scale: float = 1.0, image: Vector = (1.0, 1.0, 1.0)
) -> Handles | None:
    """The handles of a strip, on that of its planes which faces the camera and bounds the shape; None behind the eye.

    In the shape's mirror image of these signs.
    """
    back = aim.camera.axes()[2]
    faces = {side: Grip(shape, strip, side, (0.0, 0.0, 0.0), image).face(scene) for side in (1, -1)}
    side = max(faces, key=lambda side: (len(faces[side].polygon) > 0, float(faces[side].normal @ back)))
    face = faces[side]
    grip = Grip(shape, strip, side, vector(face.middle), image)
    width = scale * aim.per_pixel(face.middle)
    across = np.cross(face.normal, np.eye(3)[int(np.argmin(np.abs(face.normal)))])
    across /= np.linalg.norm(across)
    up = np.cross(face.normal, across)
    turns = np.array([(cos(a), sin(a)) for a in np.arange(_CORNERS) * 2 * pi / _CORNERS])
    arms = _RING * width * turns @ np.array([across, up])
    seen = aim.pixel(np.vstack([face.middle, *(face.middle + face.normal * end * width for end in _ARROW), face.middle + arms]))
    if not np.all(np.isfinite(seen)):
        return None
    return Handles(grip, face, seen[0], seen[1:3], seen[3:], arms, scale)


def _distance(at: Array, pixel: Pixels) -> float:
    return hypot(at[0] - pixel[0], at[1] - pixel[1])
